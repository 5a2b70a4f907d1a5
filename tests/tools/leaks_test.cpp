// SPDX-License-Identifier: BSD-3-Clause
// No verb leaves memory behind. The other tests start the program without that question (tests/CMakeLists.txt), which
// makes half of such a short run under sanitizers; here each verb is asked once, and some refusals.
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/seeds.hpp"
#include "tests/tools/process.hpp"
#include "tools/words/command.hpp"

namespace warren::test {
namespace {

/// What the programs that are started while it lives ask of the sanitizer.
class AskedForLeaks : NotCopied {
 public:
  AskedForLeaks() {
    if (const char* const before = std::getenv("ASAN_OPTIONS")) before_ = before;
    ::setenv("ASAN_OPTIONS", (before_ + ":detect_leaks=1").c_str(), 1);
  }
  ~AskedForLeaks() { ::setenv("ASAN_OPTIONS", before_.c_str(), 1); }

 private:
  std::string before_;
};

TEST(Leaks, NoVerbLeavesMemoryBehind) {
  if (memory_is_ours()) GTEST_SKIP() << "nobody looks for leaks in this build";
  const Folder folder;
  const auto file = [&](const char* name) { return folder.path(name); };
  const std::string bad = folder.write("bad.scene", "warren-scene 1\nbounds 0 0 nowhere 1\n");
  folder.write("m.map", "type octile\nheight 2\nwidth 2\nmap\n..\n..\n");
  folder.write("m.scen", "version 1\n0\tm.map\t2\t2\t0\t0\t1\t1\t1.41421356\n");
  const AskedForLeaks asked;
  const std::vector<Case> cases{
      {{"example", "walls", "-o", folder.path("")}, 0, ""},
      {{"generate", "maze", "9x9", "-o", file("m.npy")}, 0, ""},
      {{"generate", "maze", "40x40", "--algorithm", "mst", "-o", file("m.maze")}, 0, ""},
      {{"generate", "polygons", "4", "-o", file("p.geojson")}, 0, ""},
      {{"convert", file("m.npy"), "-o", file("m.scene")}, 0, ""},
      {{"info", file("walls.scene")}, 0, ""},
      {{"solve", file("walls.scene"), "--json", file("a.json"), "--svg", file("a.svg"), "--quiet"}, 0, ""},
      {{"solve", file("m.maze"), "--pipeline", "streamed", "--no-path", "--quiet"}, 0, ""},
      {{"solve", file("m.npy"), "--planner", "lazy-prm", "--threads", "2", "--quiet"}, 0, ""},
      {{"solve", world_file("parking-lot.scene"), "--explain", "--quiet", "--json", file("car.json")}, 0, ""},
      {{"solve", world_file("puma.scene"), "--quiet", "--budget", "1us"}, 124, ""},
      {{"solve", bad}, 65, "bad.scene"},
      {{"solve", "maze:5x7", "--sampels", "5"}, 2, "--samples"},
      {{"verify", file("walls.scene"), file("a.json")}, 0, ""},
      {{"render", file("walls.scene"), "-o", file("w.png")}, 0, ""},
      {{"build", file("walls.scene"), "--samples", "600", "-o", file("r.roadmap"), "--quiet"}, 0, ""},
      {{"query", file("r.roadmap"), "--json", file("q.json"), "--quiet"}, 0, ""},
      {{"update", file("r.roadmap"), file("walls.scene"), "-o", file("u.roadmap")}, 0, ""},
      {{"export", file("u.roadmap"), "-o", file("x.graphml")}, 0, ""},
      {{"compare", file("m.npy"), "--planners", "prm,lazy-prm", "--seeds", "1", "--quiet"}, 0, ""},
      {{"scale", "--sizes", "5", "--repeats", "1", "--threads", "1", "--quiet", "--html", file("s.html")}, 0, ""},
      {{"bench-scen", file("m.scen")}, 0, ""},
      {{"largest", "--budget", "60s", "--max-size", "16", "--start-size", "8", "--quiet"}, 0, ""},
      {{"profile", file("m.npy"), "--runs", "1"}, 0, ""},
      {{"help", "solve"}, 0, ""},
      {{"man"}, 0, ""},
      {{"completion", "bash"}, 0, ""},
  };
  std::set<std::string_view> asked_of{"serve"};
  for (const Case& c : cases) {
    check(c);
    asked_of.insert(c.arguments.front());
  }
  for (const tools::Command& command : tools::command_table())
    EXPECT_TRUE(asked_of.contains(command.name)) << command.name;
  Process server({"serve", file("walls.scene"), "--port", "0"}, "/dev/null", file("said"));
  for (int tries = 0; tries < 60'000 && folder.read("said").find("listening") == std::string::npos; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.send(SIGTERM);
  const Outcome ended = server.wait();
  EXPECT_EQ(ended.code, 0) << ended.err;
}

}  // namespace
}  // namespace warren::test
