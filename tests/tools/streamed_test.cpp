// SPDX-License-Identifier: BSD-3-Clause
// What the program promises of mazes that are made, reduced and forgotten tile by tile: the answers of walls that are
// held, the same bytes for any threads, and a little memory.
#include <signal.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "scenes/mazes/maze_generator.hpp"
#include "tests/scenes/mazes/mazes.hpp"
#include "tests/seeds.hpp"
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
  if (!test::memory_is_ours()) GTEST_SKIP() << "a sanitizer holds more";
  const Json answer = answered({"solve", "maze:2000x2000,algorithm=mst", "--memory", "95MiB", "--no-path"});
  EXPECT_EQ(answer["pipeline"], "streamed");
  EXPECT_EQ(answer["verified"], true);
  EXPECT_LT(answer["peak_memory_bytes"].get<double>(), 95e6);
}

TEST(Streamed, ThePeakOfMemoryIsNotThatOfWhoStartedTheProgram) {
  if (!test::memory_is_ours()) GTEST_SKIP() << "a sanitizer holds more";
  const std::string held(200'000'000, 'x');
  const Json answer = answered({"solve", "maze:41x41", "--no-path"});
  EXPECT_LT(answer["peak_memory_bytes"].get<double>(), 0.5 * static_cast<double>(held.size()));
  EXPECT_GT(answer["peak_memory_bytes"].get<double>(), 1e6);
}

TEST(Streamed, PathsThatAreNotHeldAreTheSame) {
  const Folder folder;
  for (const char* world : {"maze:200x300,algorithm=mst,seed=3", "maze:300x300,algorithm=mst,loops=0.1"}) {
    SCOPED_TRACE(world);
    const Json held = streamed(world, {"--path", folder.path("held.npy")});
    const Json handed = streamed(world, {"--no-path", "--path", folder.path("handed.npy")});
    const Json brief = streamed(world, {"--no-path"});
    EXPECT_EQ(folder.read("handed.npy"), folder.read("held.npy"));
    EXPECT_EQ(handed["path_points"], held["path"].size());
    EXPECT_EQ(timeless(handed), timeless(brief));
    EXPECT_EQ(handed["length"], held["length"]);
  }
}

TEST(Streamed, AStopLeavesNoHalfOfAPath) {
  const Folder folder;
  for (const char* limit : {"--budget", "--memory"}) {
    const std::string value = limit == std::string("--budget") ? "60ms" : "20MiB";
    const Json answer =
        streamed("maze:3000x3000,algorithm=mst", {"--no-path", "--path", folder.path("path.npy"), limit, value}, 124);
    EXPECT_EQ(answer["verified"], false);
    EXPECT_FALSE(answer.contains("path_points"));
    EXPECT_TRUE(folder.is_empty());
  }
}

/// All cells in one way: along the first row, back along the second.
std::string serpentine(const Folder& folder, std::uint32_t rows, std::uint32_t cols) {
  std::string scene = "maze " + std::to_string(rows) + " " + std::to_string(cols) + "\n";
  const auto wall = [&](double x1, double y1, double x2, double y2) {
    for (const double number : {x1, y1, x2, y2}) scene += std::to_string(number) + " ";
    scene += "\n";
  };
  const double right = cols + 0.5;
  const double top = rows + 0.5;
  wall(0.5, 0.5, right, 0.5);
  wall(0.5, top, right, top);
  wall(0.5, 1.5, 0.5, top);
  wall(right, 0.5, right, top - 1);
  for (std::uint32_t row = 1; row < rows; ++row) {
    const bool is_open_right = row % 2 == 1;
    wall(is_open_right ? 0.5 : 1.5, row + 0.5, is_open_right ? right - 1 : right, row + 0.5);
  }
  const std::string file = folder.path("serpentine.maze");
  EXPECT_EQ(run({"convert", folder.write("serpentine.walls", scene), "-o", file}).code, 0);
  return file;
}

TEST(Streamed, APathLongerThanTheMemoryIsWrittenAndJudged) {
  const Folder folder;
  const std::string file = serpentine(folder, 1501, 3000);
  const char* limit = test::memory_is_ours() ? "70MiB" : "1GiB";
  const Json answer = streamed(file, {"--no-path", "--path", folder.path("path.npy"), "--memory", limit});
  EXPECT_EQ(answer["path_points"], 1501 * 3000 + 2);
  EXPECT_EQ(answer["length"], 1501 * 3000);
  if (test::memory_is_ours()) {
    EXPECT_LT(answer["peak_memory_bytes"].get<double>(), 72e6);  // the points alone have 72 MB
  }
  EXPECT_EQ(folder.read("path.npy").size(), 128 + 16 * (1501 * 3000 + 2));
}

TEST(Streamed, MazeFilesAnswerAsTheirMazes) {
  const Folder folder;
  const std::string file = folder.path("a.maze");
  ASSERT_EQ(
      run({"generate", "maze", "300x270", "--algorithm", "mst", "--seed", "4", "--loops", "0.1", "-o", file}).code, 0);
  const Json formula = streamed("maze:300x270,algorithm=mst,seed=4,loops=0.1");
  const Json found = streamed(file);
  EXPECT_EQ(found["path"], formula["path"]);
  EXPECT_EQ(found["roadmap"], formula["roadmap"]);
  EXPECT_EQ(found["world"]["walls"], formula["world"]["walls"]);
  const Json held = answered({"solve", file});
  EXPECT_EQ(held["world"]["hash"], answered({"solve", "maze:300x270,algorithm=mst,seed=4,loops=0.1"})["world"]["hash"]);
  EXPECT_EQ(held["length"], found["length"]);
  EXPECT_EQ(answered({"verify", file, folder.write("a.json", found.dump())})["verified"], true);
  EXPECT_EQ(answered({"verify", file, folder.write("a.json", held.dump())})["verified"], true);
  ASSERT_EQ(run({"generate", "maze", "300x270", "--algorithm", "mst", "--seed", "5", "-o", file}).code, 0);
  check({{"verify", file, folder.path("a.json")}, 65, "another world"});
}

TEST(Streamed, MazeFilesGoThroughOtherFormats) {
  const Folder folder;
  const std::string file = folder.path("a.maze");
  ASSERT_EQ(run({"generate", "maze", "41x60", "--loops", "0.2", "-o", file}).code, 0);
  for (const char* other : {"b.npy", "b.walls", "b.scene"}) {
    SCOPED_TRACE(other);
    ASSERT_EQ(run({"convert", file, "-o", folder.path(other)}).code, 0);
    ASSERT_EQ(run({"convert", folder.path(other), "-o", folder.path("c.maze")}).code, 0);
    EXPECT_EQ(folder.read("c.maze"), folder.read("a.maze"));
  }
  const Json held = answered({"info", file});
  EXPECT_EQ(held["maze"], Json({41, 60}));
  ASSERT_EQ(run({"generate", "maze", "1500x1600", "--loops", "0.2", "-o", file}).code, 0);
  const Json packed = answered({"info", file, "--memory", test::memory_is_ours() ? "40MiB" : "1GiB"});
  EXPECT_EQ(packed["maze"], Json({1500, 1600}));
  EXPECT_EQ(packed["walls"], answered({"info", file})["walls"]);
  check({{"convert", world_file("walls.scene"), "-o", folder.path("c.maze")}, 65, "a .maze file holds a maze alone"});
}

TEST(Streamed, ArraysLargerThanTheMemoryAreWrittenWhileTheyAreMade) {
  const Folder folder;
  std::vector<std::string> words = {"generate", "maze", "1500x1600", "--algorithm", "mst", "--loops", "0.05"};
  ASSERT_EQ(run(joined(words, {"-o", folder.path("a.maze")})).code, 0);
  ASSERT_EQ(run({"convert", folder.path("a.maze"), "-o", folder.path("units.npy")}).code, 0);
  const char* limit = test::memory_is_ours() ? "32MiB" : "1GiB";  // the walls have 33 MB, merged 20
  words = joined(words, {"--memory", limit, "-o", folder.path("a.npy")});
  ASSERT_EQ(run(joined(words, {"--unit-walls"})).code, 0);
  EXPECT_TRUE(folder.read("a.npy") == folder.read("units.npy"));
  ASSERT_EQ(run(words).code, 0);
  EXPECT_LT(folder.read("a.npy").size(), folder.read("units.npy").size());
  EXPECT_EQ(streamed(folder.path("a.npy"), {"--no-path"})["roadmap"],
            streamed(folder.path("a.maze"), {"--no-path"})["roadmap"]);
}

TEST(Streamed, AnArrayThatIsNotWrittenToItsEndIsNone) {
  const Folder folder;  // a maze of so many cells takes long on any machine
  const auto words = [&](const std::string& file) {
    return std::vector<std::string>{"generate", "maze", "10000x10000", "--algorithm", "mst", "-o", file};
  };
  const auto brief = [](const std::string& file) {
    return std::vector<std::string>{"generate", "maze", "2000x2000", "--algorithm", "mst", "-o", file};
  };
  for (const char* budget : {"20ms", "300ms", "600ms"}) {
    check({joined(words(folder.path("a.npy")), {"--budget", budget}), 124, "budget"});
    EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
  }
  for (const int at : {100, 600}) {
    Process process(words(folder.path("a.npy")));
    process.wait_until_it_works_for(std::chrono::milliseconds(at));
    process.send(SIGINT);
    EXPECT_EQ(process.wait().code, 130);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path("")));
  }
  std::filesystem::create_symlink("/dev/full", folder.path("full.npy"));
  check({brief(folder.path("full.npy")), 73, "full.npy"});
  check({joined(brief(folder.path("a.npy")), {"--memory", "4MiB"}), 124, "memory"});
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.npy")));
}

TEST(Streamed, ArraysLargerThanTheMemoryAreReadInWindows) {
  if (!test::memory_is_ours()) GTEST_SKIP() << "a sanitizer holds more";
  const Folder folder;
  ASSERT_EQ(run({"generate", "maze", "2000x2000", "--loops", "0.05", "-o", folder.path("a.maze")}).code, 0);
  const Json packed = streamed(folder.path("a.maze"), {"--no-path"});
  const std::string array = folder.path("a.npy");
  for (const bool merged : {false, true}) {
    SCOPED_TRACE(merged);
    ASSERT_EQ(run(joined({"generate", "maze", "2000x2000", "--loops", "0.05", "-o", array},
                         merged ? std::vector<std::string>{} : std::vector<std::string>{"--unit-walls"}))
                  .code,
              0);
    const Json found = answered({"solve", array, "--memory", "48MiB"});
    EXPECT_EQ(found["pipeline"], "streamed");
    EXPECT_EQ(found["length"], packed["length"]);
    EXPECT_EQ(found["roadmap"], packed["roadmap"]);
    EXPECT_LT(found["peak_memory_bytes"].get<double>(), 50.4e6);
    const Json info = answered({"info", array});
    EXPECT_EQ(found["world"]["hash"], info["hash"]);
    EXPECT_EQ(found["world"]["walls"], info["walls"]);
    const std::string answer = folder.write("a.json", found.dump());
    EXPECT_EQ(answered({"verify", array, answer})["verified"], true);
    EXPECT_EQ(answered({"verify", array, answer, "--memory", "64MiB"})["verified"], true);
    Json touching = found;
    touching["contact"] = "allowed";
    touching["clearance"] = 0.0;
    EXPECT_EQ(answered({"verify", array, folder.write("b.json", touching.dump()), "--memory", "64MiB"})["verified"],
              true);
    touching["path"][3] = {touching["path"][3][0].get<double>() - 0.5, touching["path"][3][1]};
    check({{"verify", array, folder.write("b.json", touching.dump()), "--memory", "64MiB"},
           65,
           "contact: is not judged where walls are made tile by tile"});
  }
}

TEST(Streamed, ArraysOfOtherWallsAreRefusedWhereTheMemoryDoesNotHoldThem) {
  if (!test::memory_is_ours()) GTEST_SKIP() << "a sanitizer holds more";
  const Folder folder;
  const std::string array = folder.path("a.npy");
  ASSERT_EQ(run({"generate", "maze", "1500x1500", "--unit-walls", "-o", array}).code, 0);
  const std::string good = folder.read("a.npy");
  const auto with_row = [&](std::size_t row, std::array<float, 4> wall) {
    std::string bytes = good;
    std::memcpy(bytes.data() + 128 + 16 * row, wall.data(), sizeof wall);
    return folder.write("b.npy", bytes);
  };
  const auto refused = [&](const std::string& file, int code, std::string_view said) {
    check({{"solve", file, "--memory", "32MiB"}, code, said});
  };
  refused(with_row(10, {3.5F, 3.5F, 3.7F, 3.5F}), 65, "b.npy: row 10: is no wall on the unit grid");
  refused(with_row(11, {3.5F, 3.5F, 4.5F, 4.5F}), 65, "b.npy: row 11: is no wall on the unit grid");
  refused(with_row(12, {1500.5F, 3.5F, 1501.5F, 3.5F}), 65, "b.npy: row 12: is no wall on the unit grid");
  refused(with_row(13, {0.5F, 0.5F, 0.5F, 1.5F}), 65, "b.npy: row 13: closes a door");
  check({{"solve", with_row(2, {0.5F, 2.5F, 0.5F, 1500.5F}), "--memory", "20MiB"}, 124, ""});
  const std::string slit = with_row(10, {3.5F, 3.5F, 3.7F, 3.5F});
  const Json held = answered({"solve", slit, "--no-path", "--start", "0.5,1", "--goal", "1500.5,1500"});
  EXPECT_EQ(held["verified"], true);
}

/// Walls as long as the maze is wide, one on top of the other: units are polled, not walls, or it took hours.
TEST(Streamed, AnArrayOfLongWallsStopsWhereItIsToldTo) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "maze", "2x1000000", "--algorithm", "mst", "-o", folder.path("a.npy")}).code, 0);
  std::string bytes = folder.read("a.npy");
  constexpr std::size_t head = 128;
  constexpr std::array<float, 4> wall{0.5F, 1.5F, 1000000.5F, 1.5F};
  for (std::size_t at = head + 4 * sizeof wall; at < bytes.size(); at += sizeof wall)
    std::memcpy(&bytes[at], wall.data(), sizeof wall);
  const Json late =
      answered({"solve", folder.write("b.npy", bytes), "--pipeline", "streamed", "--budget", "300ms"}, 124);
  EXPECT_EQ(late["stopped_by"], "budget");
}

TEST(Streamed, TenBillionCellsStopWhereTheyAreToldTo) {
  const std::string world = "maze:100000x100000,algorithm=mst";
  const Json late = answered({"solve", world, "--budget", "1s"}, 124);
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
