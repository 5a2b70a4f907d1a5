// SPDX-License-Identifier: BSD-3-Clause
// What the program promises of mazes that are made, reduced and forgotten tile by tile: the answers of walls that are
// held, the same bytes for any threads, and a little memory.
#include <algorithm>
#include <bit>
#include <cstring>

#include "scenes/mazes/maze_generator.hpp"
#include "tests/scenes/mazes/mazes.hpp"
#include "tests/tools/grid_worlds.hpp"

namespace warren::test {
namespace {

Json streamed(const std::string& world, const std::vector<std::string>& more = {}, int code = 0) {
  return answered(joined({"solve", world, "--pipeline", "streamed"}, more), code);
}

/// What is left when all that may differ from run to run is taken out.
Json timeless(Json answer) {
  for (const char* key : {"stages_s", "solve_s", "peak_memory_bytes", "threads"}) answer.erase(key);
  return answer;
}

TEST(Streamed, AnswersAsWallsThatAreHeld) {
  for (const char* world : {"maze:1x1,algorithm=mst", "maze:1x300,algorithm=mst", "maze:70x90,algorithm=mst,seed=3",
                            "maze:300x270,algorithm=mst,seed=4,loops=0.1", "maze:40x600,algorithm=mst,loops=1"}) {
    for (const char* body : {"point", "disc 0.2"}) {
      SCOPED_TRACE(std::string(world) + " " + body);
      const Json found = streamed(world, {"--robot", body});
      EXPECT_EQ(found["pipeline"], "streamed");
      EXPECT_EQ(found["verified"], true);
      for (const char* pipeline : {"plain", "tiled"}) {
        const Json held = answered({"solve", world, "--pipeline", pipeline, "--robot", body});
        EXPECT_NEAR(found["length"].get<double>(), held["length"].get<double>(), 1e-12 * held["length"].get<double>());
        EXPECT_EQ(found["min_clearance"], held["min_clearance"]);
        EXPECT_EQ(found["roadmap"], held["roadmap"]);
        EXPECT_EQ(found["world"]["walls"], held["world"]["walls"]);
        EXPECT_EQ(found["path"].size(), held["path"].size());
      }
    }
  }
}

TEST(Streamed, LengthsAreThoseOfABreadthFirstSearch) {
  const Json answer = streamed("maze:400x400,algorithm=mst,seed=8,loops=0.02");
  const MazeCells cells = mazes::maze(400, 400, 8, MazeAlgorithm::mst, 0.02);
  EXPECT_EQ(answer["length"].get<double>(), mazes::distances_from(cells, {0, 0}).back() + 1.0);
}

TEST(Streamed, GivesTheSameBytesForAnyThreads) {
  const std::string world = "maze:700x900,algorithm=mst,seed=2,loops=0.05";
  const Json expected = timeless(streamed(world, {"--threads", "1"}));
  for (const char* threads : {"2", "3", "8"}) EXPECT_EQ(timeless(streamed(world, {"--threads", threads})), expected);
}

TEST(Streamed, WallsThatAreHeldAreStreamedToo) {
  const Json held = answered({"solve", "maze:150x140,loops=0.1", "--pipeline", "tiled"});
  const Json found = streamed("maze:150x140,loops=0.1");
  EXPECT_EQ(found["pipeline"], "streamed");
  EXPECT_EQ(found["path"], held["path"]);
}

TEST(Streamed, AnswersAreVerifiedAmongWallsThatAreHeld) {
  const Folder folder;
  const std::string world = "maze:60x80,algorithm=mst,seed=5";
  Json answer = streamed(world);
  EXPECT_EQ(answered({"verify", world, folder.write("a.json", answer.dump())})["verified"], true);
  answer["path"][3][0] = answer["path"][3][0].get<double>() + 0.45;
  check({{"verify", world, folder.write("b.json", answer.dump())}, 1, ""});
  check({{"verify", "maze:60x80,algorithm=mst,seed=6", folder.path("a.json")}, 65, "another world"});
}

TEST(Streamed, WithoutItsPointsAnAnswerSaysTheirNumberAndHash) {
  const Folder folder;
  const std::string world = "maze:200x200,algorithm=mst,seed=7";
  const Json whole = streamed(world);
  const Json brief = streamed(world, {"--no-path", "--path", folder.path("path.npy")});
  EXPECT_EQ(brief["path"].size(), 0U);
  EXPECT_EQ(brief["path_points"], whole["path"].size());
  EXPECT_EQ(brief["length"], whole["length"]);
  const std::string file = folder.read("path.npy");
  std::uint64_t hash = 0xcbf29ce484222325U;
  std::string bytes;
  for (const Json& point : whole["path"]) {
    for (const Json& number : point) {
      const auto bits = std::bit_cast<std::uint64_t>(number.get<double>());
      for (unsigned shift = 0; shift < 64; shift += 8) {
        const std::uint64_t byte = bits >> shift & 0xffU;
        bytes += static_cast<char>(byte);
        hash = (hash ^ byte) * 0x100000001b3U;
      }
    }
  }
  EXPECT_EQ(std::stoull(brief["path_hash"].get<std::string>(), nullptr, 16), hash);
  EXPECT_NE(file.find("'shape': (" + std::to_string(whole["path"].size()) + ", 2)"), std::string::npos);
  EXPECT_TRUE(file.ends_with(bytes));
}

TEST(Streamed, MazesThatTheMemoryDoesNotHoldAreStreamed) {
  const Json answer = answered({"solve", "maze:2000x2000,algorithm=mst", "--memory", "95MiB", "--no-path"});
  EXPECT_EQ(answer["pipeline"], "streamed");
  EXPECT_EQ(answer["verified"], true);
  EXPECT_LT(answer["peak_memory_bytes"].get<double>(), 95e6);
}

TEST(Streamed, TenBillionCellsStopWhereTheyAreToldTo) {
  const std::string world = "maze:100000x100000,algorithm=mst";
  const Json late = answered({"solve", world, "--budget", "300ms"}, 124);
  EXPECT_EQ(late["stopped_by"], "budget");
  EXPECT_EQ(late["world"]["kind"], "maze");
  EXPECT_EQ(late["world"]["walls"], 99999LL * 99999LL + 4);
  EXPECT_EQ(answered({"solve", world, "--memory", "100MiB"}, 124)["stopped_by"], "memory");
}

TEST(Streamed, RefusesWhatItWouldIgnore) {
  const std::string world = "maze:9x9,algorithm=mst";
  const auto refused = [&](const std::vector<std::string>& more, std::string_view said) {
    check({joined({"solve", world, "--pipeline", "streamed"}, more), 2, said});
  };
  refused({"--clearance", "0.5"}, "--clearance: with the body's radius it must be below half a cell");
  refused({"--robot", "disc 0.45"}, "--clearance: with the body's radius it must be below half a cell");
  refused({"--optimise"}, "--optimise: pulls no path taut");
  refused({"--planner", "visibility"}, "--pipeline: visibility would ignore it");
  refused({"--planner", "prm", "--samples", "100"}, "--pipeline: streamed takes the lattice");
  refused({"--robot", "polygon -.1 -.1 .1 -.1 0 .1"}, "a polygon takes a smaller maze");
  check({{"solve", "maze:100000x100000"}, 2, "of the algorithm mst it may be more"});
  check({{"solve", "maze:100000x100000,algorithm=mst", "--planner", "visibility"},
         2,
         "--planner: visibility does not solve a point or disc in a maze made tile by tile"});
  check({{"solve", "maze:9x9", "--planner", "lazy-prm", "--pipeline", "streamed"}, 2, "the planner prm takes"});
}

}  // namespace
}  // namespace warren::test
