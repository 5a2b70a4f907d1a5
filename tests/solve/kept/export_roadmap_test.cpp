// SPDX-License-Identifier: BSD-3-Clause
// The bytes of each format, of small roadmaps that can be written down; what other programs read of larger ones is
// tests/exports/read_exports.py's to say.
#include "solve/kept/export_roadmap.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <limits>
#include <string>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/files/npy_io.hpp"
#include "solve/kept/roadmap_formats_io.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/kept/listed_roadmap.hpp"

namespace warren {
namespace {

constexpr EdgeState unchecked = EdgeState::unchecked;
constexpr EdgeState blocked = EdgeState::blocked;

/// Four vertices, a path of three free edges' places: one free edge of 5, one unchecked, one blocked.
ListedRoadmap square() { return {2, false, {0, 0, 3, 4, 0.1, -2, 7, 7}, {{0, 1}, {1, 2, unchecked}, {2, 3, blocked}}}; }

struct Exported {
  std::string text;
  std::string second;
  ExportAccount account;
};

Exported exported(const ListedRoadmap& roadmap, const std::string& ending, const ExportOptions& options = {},
                  const Execution& execution = {}) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("r" + ending);
  Exported result;
  result.account = export_roadmap(path, roadmap.parts(), roadmap.length(), options, execution);
  const std::vector<std::string> files = files_of_export(path);
  EXPECT_EQ(directory.entries(), files.size());
  result.text = directory.read("r" + ending);
  if (files.size() == 2) result.second = directory.read(std::filesystem::path(files.back()).filename().string());
  return result;
}

TEST(ExportRoadmap, TablesHoldFreeEdgesOnce) {
  const Exported csv = exported(square(), ".csv");
  EXPECT_EQ(csv.text, "id,x,y,component\n0,0,0,0\n1,3,4,0\n2,0.1,-2,2\n3,7,7,3\n");
  EXPECT_EQ(csv.second, "from,to,length,state\n0,1,5,free\n");
  EXPECT_EQ(csv.account, (ExportAccount{4, 1, 1, 1}));
}

TEST(ExportRoadmap, UncheckedEdgesAreWrittenWhereTheyAreAskedFor) {
  const ListedRoadmap roadmap(2, false, {0, 0, 3, 4, 3, 6}, {{0, 1}, {1, 2, unchecked}, {0, 2, blocked}});
  const Exported csv = exported(roadmap, ".csv", {.with_unchecked = true});
  EXPECT_EQ(csv.second, "from,to,length,state\n0,1,5,free\n1,2,2,unchecked\n");
  EXPECT_EQ(csv.account, (ExportAccount{3, 2, 0, 1}));
  EXPECT_EQ(exported(roadmap, ".gr", {.with_unchecked = true}).account, csv.account);
}

TEST(ExportRoadmap, DirectedEdgesAreWrittenAsTheyAre) {
  const ListedRoadmap roadmap(3, true, {0, 0, 0, 3, 4, 0, 3, 4, 1.5}, {{1, 0}, {0, 1}, {2, 1}, {1, 2, blocked}});
  const Exported csv = exported(roadmap, ".csv");
  EXPECT_EQ(csv.text, "id,x,y,theta,component\n0,0,0,0,0\n1,3,4,0,0\n2,3,4,1.5,0\n");
  EXPECT_EQ(csv.second, "from,to,length,state\n0,1,5,free\n1,0,5,free\n2,1,1.5,free\n");
  EXPECT_EQ(csv.account, (ExportAccount{3, 3, 0, 1}));
  EXPECT_EQ(exported(roadmap, ".gr").text,
            "c weights are lengths in units of 2^-28\np sp 3 3\na 1 2 1342177280\na 2 1 1342177280\na 3 2 402653184\n");
  EXPECT_EQ(exported(roadmap, ".gr").second,
            "c coordinates are in units of 2^-28\np aux sp co 3\nv 1 0 0\nv 2 805306368 1073741824\n"
            "v 3 805306368 1073741824\n");
}

TEST(ExportRoadmap, GraphmlTellsKeysThenNodesThenEdges) {
  const std::string head =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  const std::string common =
      "<key id=\"component\" for=\"node\" attr.name=\"component\" attr.type=\"long\"/>\n"
      "<key id=\"length\" for=\"edge\" attr.name=\"length\" attr.type=\"double\"/>\n"
      "<key id=\"state\" for=\"edge\" attr.name=\"state\" attr.type=\"string\"/>\n";
  const ListedRoadmap roadmap(2, false, {0, 0, 3, 4}, {{0, 1, unchecked}});
  EXPECT_EQ(
      exported(roadmap, ".graphml", {.with_unchecked = true}).text,
      head +
          "<key id=\"x\" for=\"node\" attr.name=\"x\" attr.type=\"double\"/>\n"
          "<key id=\"y\" for=\"node\" attr.name=\"y\" attr.type=\"double\"/>\n" +
          common +
          "<graph edgedefault=\"undirected\">\n"
          "<node id=\"0\"><data key=\"x\">0</data><data key=\"y\">0</data><data key=\"component\">0</data></node>\n"
          "<node id=\"1\"><data key=\"x\">3</data><data key=\"y\">4</data><data key=\"component\">1</data></node>\n"
          "<edge source=\"0\" target=\"1\"><data key=\"length\">5</data><data key=\"state\">unchecked</data></edge>\n"
          "</graph>\n</graphml>\n");
  const std::string directed = exported(ListedRoadmap(6, true, {1, 2, 3, 4, 5, 6}, {}), ".graphml").text;
  EXPECT_NE(directed.find("<graph edgedefault=\"directed\">"), std::string::npos);
  EXPECT_NE(directed.find("<node id=\"0\"><data key=\"q1\">1</data><data key=\"q2\">2</data><data key=\"q3\">3</data>"
                          "<data key=\"q4\">4</data><data key=\"q5\">5</data><data key=\"q6\">6</data>"),
            std::string::npos);
}

TEST(ExportRoadmap, DimacsHasTwoArcsAnEdgeAndWholeNumbers) {
  const Exported dimacs = exported(square(), ".gr");
  EXPECT_EQ(dimacs.text, "c weights are lengths in units of 2^-28\np sp 4 2\na 1 2 1342177280\na 2 1 1342177280\n");
  EXPECT_EQ(dimacs.second,
            "c coordinates are in units of 2^-28\np aux sp co 4\nv 1 0 0\nv 2 805306368 1073741824\n"
            "v 3 26843546 -536870912\nv 4 1879048192 1879048192\n");
  EXPECT_EQ(dimacs.account, (ExportAccount{4, 1, 1, 1}));
}

TEST(ExportRoadmap, UndirectedEdgesAreAsLongBothWays) {
  const TemporaryDirectory directory;
  const auto rounded_otherwise = [](VertexId v, VertexId w) { return v < w ? 3.0 : 4.0; };
  const ListedRoadmap pair(2, false, {0, 0, 3, 4}, {{0, 1}});
  export_roadmap(directory.file("r.gr"), pair.parts(), VertexDistance(rounded_otherwise), {}, {});
  EXPECT_EQ(directory.read("r.gr"),
            "c weights are lengths in units of 2^-29\np sp 2 2\na 1 2 1610612736\na 2 1 1610612736\n");
}

TEST(ExportRoadmap, AnArmsCoordinatesAreAllItsJoints) {
  const ListedRoadmap arm(6, false, {1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 7}, {{0, 1}});
  EXPECT_EQ(exported(arm, ".gr").second,
            "c coordinates are in units of 2^-28\np aux sp co 2\n"
            "v 1 268435456 536870912 805306368 1073741824 1342177280 1610612736\n"
            "v 2 268435456 536870912 805306368 1073741824 1342177280 1879048192\n");
  EXPECT_EQ(exported(arm, ".csv").text, "id,q1,q2,q3,q4,q5,q6,component\n0,1,2,3,4,5,6,0\n1,1,2,3,4,5,7,0\n");
}

TEST(ExportRoadmap, RouteGraphsHaveIdsThatNodesAndEdgesShare) {
  const std::string point = "{\"type\":\"Feature\",\"properties\":{\"id\":";
  EXPECT_EQ(exported(ListedRoadmap(2, false, {0, 0, 3, 4}, {{0, 1}}), ".geojson").text,
            "{\"type\":\"FeatureCollection\",\"name\":\"graph\",\"features\":[\n" + point +
                "0,\"frame\":\"map\"},\"geometry\":{\"type\":\"Point\",\"coordinates\":[0,0]}},\n" + point +
                "1,\"frame\":\"map\"},\"geometry\":{\"type\":\"Point\",\"coordinates\":[3,4]}},\n" + point +
                "2,\"startid\":0,\"endid\":1,\"cost\":5},"
                "\"geometry\":{\"type\":\"MultiLineString\",\"coordinates\":[[[0,0],[3,4]]]}},\n" +
                point +
                "3,\"startid\":1,\"endid\":0,\"cost\":5},"
                "\"geometry\":{\"type\":\"MultiLineString\",\"coordinates\":[[[3,4],[0,0]]]}}\n]}\n");
  const ListedRoadmap car(3, true, {0, 0, 2, 3, 4, 2}, {{0, 1, unchecked}});
  EXPECT_EQ(exported(car, ".geojson", {.with_unchecked = true, .frame = "od\"om"}).text,
            "{\"type\":\"FeatureCollection\",\"name\":\"graph\",\"features\":[\n" + point +
                "0,\"frame\":\"od\\\"om\",\"metadata\":{\"theta\":2.0}},\"geometry\":{\"type\":\"Point\","
                "\"coordinates\":[0,0]}},\n" +
                point +
                "1,\"frame\":\"od\\\"om\",\"metadata\":{\"theta\":2.0}},\"geometry\":{\"type\":\"Point\","
                "\"coordinates\":[3,4]}},\n" +
                point +
                "2,\"startid\":0,\"endid\":1,\"cost\":5,\"metadata\":{\"state\":\"unchecked\"}},"
                "\"geometry\":{\"type\":\"MultiLineString\",\"coordinates\":[[[0,0],[3,4]]]}}\n]}\n");
}

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

/// Does the archive hold that array? Names and bytes of members are told apart by nothing else here.
bool holds(const std::string& archive, const std::string& name, std::string_view type, std::vector<std::uint64_t> shape,
           const std::string& bytes) {
  return archive.find(name + ".npy" + npy_header(type, shape) + bytes + "PK") != std::string::npos;
}

TEST(ExportRoadmap, ArchivesHoldTheMatrixOfLengthsAndTheStates) {
  const ListedRoadmap roadmap(2, false, {0, 0, 3, 4, 3, 6}, {{0, 1}, {1, 2, unchecked}, {0, 2, blocked}});
  const std::string free = exported(roadmap, ".npz").text;
  EXPECT_TRUE(holds(free, "indices", "<i4", {2}, bytes_of<std::int32_t>({1, 0})));
  EXPECT_TRUE(holds(free, "indptr", "<i4", {4}, bytes_of<std::int32_t>({0, 1, 2, 2})));
  EXPECT_TRUE(holds(free, "format", "|S3", {}, "csr"));
  EXPECT_TRUE(holds(free, "shape", "<i8", {2}, bytes_of<std::int64_t>({3, 3})));
  EXPECT_TRUE(holds(free, "data", "<f8", {2}, bytes_of<double>({5, 5})));
  EXPECT_TRUE(holds(free, "states", "<f8", {3, 2}, bytes_of<double>({0, 0, 3, 4, 3, 6})));
  EXPECT_TRUE(holds(free, "component", "<u4", {3}, bytes_of<VertexId>({0, 0, 2})));
  EXPECT_EQ(free.find("edge_states"), std::string::npos);
  const std::string all = exported(roadmap, ".npz", {.with_unchecked = true}).text;
  EXPECT_TRUE(holds(all, "indptr", "<i4", {4}, bytes_of<std::int32_t>({0, 1, 3, 4})));
  EXPECT_TRUE(holds(all, "edge_states", "|u1", {4}, bytes_of<std::uint8_t>({1, 1, 0, 0})));
}

std::string usage_error(const ListedRoadmap& roadmap, const std::string& ending) {
  return test::refusal<UsageError>([&] { exported(roadmap, ending); });
}

TEST(ExportRoadmap, WhatNav2WouldNotLoadIsRefused) {
  const auto says = [](const ListedRoadmap& roadmap, const std::string& text) {
    return usage_error(roadmap, ".geojson").find(text) != std::string::npos;
  };
  EXPECT_TRUE(
      says({2, false, {}, {}}, "r.geojson: Nav2 loads no route graph without edges, and this roadmap has none"));
  EXPECT_TRUE(says({2, false, {0, 0, 1, 1}, {{0, 1, blocked}}}, "without edges, and this roadmap has none"));
  EXPECT_TRUE(says({2, false, {0, 0, 1, 1}, {{0, 1, unchecked}}}, "ask for with_unchecked"));
  EXPECT_TRUE(says({6, false, std::vector<double>(12), {{0, 1}}}, "these states are an arm's"));
}

TEST(ExportRoadmap, GraphvizGetsPlacesAndLengthsInQuotes) {
  EXPECT_EQ(exported(ListedRoadmap(2, false, {0, 0, 3, 4}, {{0, 1}}), ".dot").text,
            "graph roadmap {\nnode [shape=point];\n0 [component=0, pos=\"0,0!\"];\n1 [component=0, pos=\"3,4!\"];\n"
            "0 -- 1 [len=\"5\"];\n}\n");
  EXPECT_EQ(
      exported(ListedRoadmap(3, true, {0, 0, 2, 3, 4, 2}, {{1, 0, unchecked}}), ".dot", {.with_unchecked = true}).text,
      "digraph roadmap {\nnode [shape=point];\n0 [component=0, pos=\"0,0!\", theta=\"2\"];\n"
      "1 [component=1, pos=\"3,4!\", theta=\"2\"];\n1 -> 0 [len=\"5\", style=dashed];\n}\n");
  EXPECT_EQ(exported(ListedRoadmap(6, false, {1, 2, 3, 4, 5, 6}, {}), ".dot").text,
            "graph roadmap {\nnode [shape=point];\n0 [component=0, q1=\"1\", q2=\"2\", q3=\"3\", q4=\"4\", q5=\"5\", "
            "q6=\"6\"];\n}\n");
}

TEST(ExportRoadmap, AnEmptyRoadmapIsHeadsAlone) {
  const ListedRoadmap empty(2, false, {}, {});
  EXPECT_EQ(exported(empty, ".csv").text, "id,x,y,component\n");
  EXPECT_EQ(exported(empty, ".csv").second, "from,to,length,state\n");
  EXPECT_EQ(exported(empty, ".gr").text, "c weights are lengths in units of 2^0\np sp 0 0\n");
  EXPECT_EQ(exported(empty, ".gr").second, "c coordinates are in units of 2^0\np aux sp co 0\n");
  EXPECT_EQ(exported(empty, ".dot").text, "graph roadmap {\nnode [shape=point];\n}\n");
  EXPECT_NE(exported(empty, ".graphml").text.find("<graph edgedefault=\"undirected\">\n</graph>"), std::string::npos);
  EXPECT_NE(exported(empty, ".npz").text.find("'shape': (1,)"), std::string::npos);
  EXPECT_EQ(exported(empty, ".npz").account, ExportAccount{});
}

TEST(ExportRoadmap, ExtremeNumbersReadBackAsTheyWere) {
  const ListedRoadmap roadmap(2, false, {1e-300, -1e300, 1e-300, -1e300, 0.1, 5e-324}, {{0, 1}});
  const Exported csv = exported(roadmap, ".csv");
  EXPECT_EQ(csv.text, "id,x,y,component\n0,1e-300,-1e+300,0\n1,1e-300,-1e+300,0\n2,0.1,5e-324,2\n");
  EXPECT_EQ(csv.second, "from,to,length,state\n0,1,0,free\n");
  EXPECT_EQ(exported(roadmap, ".gr").second,
            "c coordinates are in units of 2^966\np aux sp co 3\nv 1 0 -1603334688\nv 2 0 -1603334688\nv 3 0 0\n");
}

TEST(ExportRoadmap, LengthsThatAreNoNumbersAreRefused) {
  const ListedRoadmap far_apart(2, false, {0, 0, 1e300, 0, 5, 5}, {{0, 1}, {0, 2}});
  for (const std::string ending : {".csv", ".gr", ".geojson", ".graphml", ".npz", ".dot"}) {
    SCOPED_TRACE(ending);
    const TemporaryDirectory directory;
    const std::string path = directory.file("r" + ending);
    EXPECT_EQ(test::refusal<InputError>([&] { export_roadmap(path, far_apart.parts(), far_apart.length(), {}, {}); }),
              "edge 0 -> 1 of the roadmap: the length of an edge that is exported must be a finite number, zero or "
              "more (found: inf)");
    EXPECT_EQ(directory.entries(), 0U);
  }
}

TEST(ExportRoadmap, OtherEndingsAreRefusedByName) {
  for (const std::string path : {"a.svg", "a.co", "a", "", "a.CSV", "-"}) {
    EXPECT_EQ(test::refusal<UsageError>([&] { files_of_export(path); }),
              path +
                  ": a roadmap is exported to a file that ends in one of .geojson .graphml .gr .csv"
                  " .npz .dot, and drawn by .svg .png .pdf .html");
  }
}

TEST(ExportRoadmap, SaysWhichFilesItWrites) {
  using Files = std::vector<std::string>;
  EXPECT_EQ(files_of_export("d/a.gr"), (Files{"d/a.gr", "d/a.co"}));
  EXPECT_EQ(files_of_export("d/a.csv"), (Files{"d/a.csv", "d/a.edges.csv"}));
  EXPECT_EQ(files_of_export("d/a.npz"), Files{"d/a.npz"});
}

TEST(ExportRoadmap, NeitherFileIsPutInPlaceWhereTheSecondCantBeWritten) {
  for (const auto& [ending, second] : {std::pair{".csv", "r.edges.csv"}, std::pair{".gr", "r.co"}}) {
    const TemporaryDirectory directory;
    std::filesystem::create_symlink("/dev/full", directory.file(second));
    directory.write(std::string("r") + ending, "old");
    const ListedRoadmap roadmap = square();
    EXPECT_THROW(export_roadmap(directory.file(std::string("r") + ending), roadmap.parts(), roadmap.length(), {}, {}),
                 WriteError);
    EXPECT_EQ(directory.read(std::string("r") + ending), "old");
    EXPECT_EQ(directory.entries(), 2U);
  }
}

/// Many blocks of ends and pieces of vertices: a few vertices of many edges, many of none.
ListedRoadmap uneven() {
  constexpr VertexId vertices = 30'000;
  std::vector<double> states;
  std::vector<ListedEdge> edges;
  for (std::uint64_t i = 0; i < 2 * vertices; ++i) states.push_back(uniform(1, i, 0) * 100);
  for (const VertexId hub : {VertexId{0}, VertexId{5}, VertexId{9'000}, VertexId{29'998}}) {
    for (VertexId v = hub + 1; v < vertices; v += 1 + v % 7) {
      edges.push_back({hub, v, static_cast<EdgeState>(uniform(2, v, hub) * 3)});
    }
  }
  return {2, false, std::move(states), std::move(edges)};
}

TEST(ExportRoadmap, BytesDoNotDependOnThreads) {
  const ListedRoadmap roadmap = uneven();
  for (const std::string ending : {".csv", ".gr", ".geojson", ".graphml", ".npz", ".dot"}) {
    const Exported one = exported(roadmap, ending, {}, {.threads = 1});
    for (const std::uint64_t i : test::seeds(3, 1, 0)) {
      const unsigned threads = std::array{2U, 3U, 8U}[i];
      const Exported many = exported(roadmap, ending, {}, {.threads = threads});
      EXPECT_EQ(many.text == one.text && many.second == one.second, true) << ending << " on " << threads;
      EXPECT_EQ(many.account, one.account);
    }
  }
}

TEST(ExportRoadmap, RowsOfTheMatrixBeginWhereTheirFirstFreeEdgeStands) {
  const ListedRoadmap roadmap = uneven();
  const RoadmapParts parts = roadmap.parts();
  std::vector<std::int32_t> rows{0};
  std::vector<std::int32_t> targets;
  for (VertexId v = 0; v < parts.vertex_count(); ++v) {
    for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
      if (parts.state_of_end(end) == EdgeState::free) targets.push_back(static_cast<std::int32_t>(parts.to[end]));
    }
    rows.push_back(static_cast<std::int32_t>(targets.size()));
  }
  const std::string archive = exported(roadmap, ".npz").text;
  ASSERT_GT(parts.to.size(), 4 * edge_ends_a_block);
  EXPECT_TRUE(holds(archive, "indptr", "<i4", {rows.size()}, bytes_of(rows)));
  EXPECT_TRUE(holds(archive, "indices", "<i4", {targets.size()}, bytes_of(targets)));
}

/// Edges of some far vertices have infinite lengths.
TEST(ExportRoadmap, TheFirstWrongLengthIsToldForAnyNumberOfThreads) {
  constexpr VertexId vertices = 60'000;
  std::vector<double> states(2 * vertices, 1);
  std::vector<ListedEdge> edges;
  for (VertexId v = 0; v + 1 < vertices; ++v) edges.push_back({v, v + 1});
  for (VertexId v = 20'001; v < vertices; v += 1'500) states[2 * v] = 1e300;
  const ListedRoadmap roadmap(2, false, std::move(states), std::move(edges));
  for (const std::string ending : {".csv", ".gr"}) {
    for (const std::uint64_t i : test::seeds(3, 1, 0)) {
      const unsigned threads = std::array{1U, 2U, 8U}[i];
      const std::string said = test::refusal<InputError>([&] { exported(roadmap, ending, {}, {.threads = threads}); });
      EXPECT_EQ(said.substr(0, 23), "edge 20000 -> 20001 of ") << ending;
    }
  }
}

TEST(ExportRoadmap, ARoadmapWithoutArraysIsEmpty) {
  const TemporaryDirectory directory;
  const ListedRoadmap none(2, false, {}, {});
  for (const std::string ending : {".csv", ".gr", ".graphml", ".npz", ".dot"}) {
    const std::string name = "r" + ending;
    EXPECT_EQ(export_roadmap(directory.file(name), RoadmapParts{}, none.length(), {}, {}), ExportAccount{});
    EXPECT_EQ(directory.read(name), exported(none, ending).text);
  }
}

TEST(ExportRoadmap, StopsAtTheDeadlineAndLeavesNothing) {
  const ListedRoadmap roadmap = uneven();
  const SignalFlag signal{2};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  for (const std::string ending : {".csv", ".gr", ".geojson", ".graphml", ".npz", ".dot"}) {
    const TemporaryDirectory directory;
    EXPECT_THROW(
        export_roadmap(directory.file("r" + ending), roadmap.parts(), roadmap.length(), {}, {.deadline = &deadline}),
        Stopped);
    EXPECT_EQ(directory.entries(), 0U);
  }
}

}  // namespace
}  // namespace warren
