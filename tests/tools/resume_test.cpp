// SPDX-License-Identifier: BSD-3-Clause
// What the program promises of --resume: a run that was killed, interrupted or out of time goes on to the same answer.
#include <signal.h>

#include <chrono>
#include <string>

#include "tests/tools/grid_worlds.hpp"

namespace warren::test {
namespace {

const std::string world = "maze:4200x2100,algorithm=mst,seed=2,loops=0.02";

Json timeless(Json answer) {
  for (const char* key : {"stages_s", "solve_s", "peak_memory_bytes", "threads"}) answer.erase(key);
  return answer;
}

std::vector<std::string> resumed(const Folder& folder, const char* threads) {
  return {"solve",     world,   "--pipeline", "streamed", "--no-path", "--resume", folder.path("resume"),
          "--threads", threads, "--quiet"};
}

TEST(Resume, RunsThatWereKilledOrStoppedAnywhereGoOnToTheSameAnswer) {
  const Json expected = timeless(answered({"solve", world, "--pipeline", "streamed", "--no-path"}));
  int at = 0;
  for (const int signal : {SIGKILL, SIGINT, SIGKILL, SIGTERM, SIGKILL}) {
    const Folder folder;
    for (int round = 0; round < 2; ++round) {
      SCOPED_TRACE(at);
      at += 170;
      Process process(resumed(folder, "2"));
      process.wait_until_it_computed_for(std::chrono::milliseconds(at));
      process.send(signal);
      process.wait();
    }
    EXPECT_EQ(timeless(answered(resumed(folder, at % 3 == 0 ? "1" : "3"))), expected);
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
