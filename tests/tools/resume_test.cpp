// SPDX-License-Identifier: BSD-3-Clause
// What the program promises of --resume: a run that was killed, interrupted or out of time goes on to the same answer.
#include <signal.h>

#include <chrono>
#include <string>

#include "tests/seeds.hpp"
#include "tests/tools/grid_worlds.hpp"

namespace warren::test {
namespace {

const std::string formula = "maze:4200x2100,algorithm=mst,seed=2,loops=0.02";

Json free_of_times(Json answer) {
  for (const char* key : {"stages_s", "solve_s", "peak_memory_bytes", "threads"}) answer.erase(key);
  return answer;
}

std::vector<std::string> asked(const std::string& world) {
  std::vector<std::string> words = {"solve", world, "--pipeline", "streamed", "--no-path"};
  if (world.ends_with(".npy")) words = joined(words, {"--memory", "80MiB"});  // which does not hold its walls
  return words;
}

std::vector<std::string> resumed(const std::string& world, const Folder& folder, const char* threads) {
  return joined(asked(world), {"--resume", folder.path("resume"), "--threads", threads, "--quiet"});
}

/// Two runs that end by that signal, at moments from `at` ms of computing on, and one that does not.
void check_goes_on(const std::string& world, const Json& expected, int signal, int at) {
  SCOPED_TRACE(at);
  const Folder folder;
  for (const int more : {0, 170}) {
    Process process(resumed(world, folder, "2"));
    process.wait_until_it_computed_for(std::chrono::milliseconds(at + more));
    process.send(signal);
    process.wait();
  }
  EXPECT_EQ(free_of_times(answered(resumed(world, folder, at % 3 == 0 ? "1" : "3"))), expected);
}

Json expected_of(const std::string& world) { return free_of_times(answered(asked(world))); }

TEST(Resume, RunsThatWereKilledOrStoppedAnywhereGoOnToTheSameAnswer) {
  const Json expected = expected_of(formula);
  int at = 0;
  for (const int signal : {SIGKILL, SIGINT, SIGKILL, SIGTERM, SIGKILL}) {
    check_goes_on(formula, expected, signal, at);
    at += 340;
  }
}

TEST(Resume, RunsOverFilesGoOnToTheSameAnswerAndNotOverOtherFiles) {
  const Folder worlds;
  for (const char* name : {"a.maze", "a.npy"}) {
    SCOPED_TRACE(name);
    if (name == std::string("a.npy") && !memory_is_ours()) continue;
    const std::string world = worlds.path(name);
    const auto make = [&](const char* seed) {
      const std::vector<std::string> words = {"generate", "maze", "2100x2100", "--algorithm", "mst", "--loops", "0.02"};
      ASSERT_EQ(run(joined(words, {"--seed", seed, "-o", world})).code, 0);
    };
    make("2");
    const Json expected = expected_of(world);
    int at = 60;
    for (const int signal : {SIGKILL, SIGINT, SIGKILL}) {
      check_goes_on(world, expected, signal, at);
      at += 200;
    }
    const Folder folder;
    ASSERT_EQ(run(resumed(world, folder, "1")).code, 0);
    EXPECT_EQ(free_of_times(answered(resumed(world, folder, "2"))), expected);
    make("3");
    check({resumed(world, folder, "1"), 65, "another run"});
  }
}

TEST(Resume, WhatCannotGoOnIsRefusedInOneLine) {
  const Folder folder;
  const std::string small = "maze:90x80,algorithm=mst";
  check({{"solve", small, "--resume", folder.path("a")}, 2, "--resume: keeps tiles of mazes"});
  check({{"solve", small, "--pipeline", "streamed", "--resume", folder.path("a")}, 0, ""});
  check({{"solve", small + ",seed=2", "--pipeline", "streamed", "--resume", folder.path("a")}, 65, "another run"});
  check({{"solve", small, "--pipeline", "streamed", "--resume", folder.path("a"), "--json", folder.path("a")},
         2,
         "would both write"});
  check({{"solve", small, "--pipeline", "streamed", "--resume", folder.write("b", "mine")}, 65, "would be lost"});
  EXPECT_EQ(folder.read("b"), "mine");
}

}  // namespace
}  // namespace warren::test
