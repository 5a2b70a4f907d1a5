// SPDX-License-Identifier: BSD-3-Clause
// What shells are told to complete, asked of the program, and of a real bash that has read its script.
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Words = std::vector<std::string>;

/// The candidates alone, blank-separated, and the last line.
struct Told {
  std::string words;
  std::string last;
};

Told told(const Words& typed) {
  const Outcome outcome = run(joined({"complete"}, typed));
  EXPECT_EQ(outcome.code, 0) << shown(typed);
  std::istringstream lines(outcome.out);
  Told all;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(':')) {
      all.last = line.substr(1);
    } else {
      all.words += (all.words.empty() ? "" : " ") + line.substr(0, line.find('\t'));
    }
  }
  return all;
}

TEST(Completion, VerbsOptionsAndValues) {
  EXPECT_EQ(told({"so"}).words, "solve");
  EXPECT_EQ(told({"--v"}).words, "--version");
  EXPECT_EQ(told({"nonsense", ""}).words, "");
  EXPECT_EQ(told({"solve", "maze:5x7", "--op"}).words, "--optimise");
  EXPECT_EQ(told({"solve", "maze:5x7", "--optimise", "--op"}).words, "");  // given once
  EXPECT_EQ(told({"solve", "--queue", ""}).words, "heap lazy-heap sorted-array resorted-array");
  EXPECT_EQ(told({"solve", "--queue=so"}).words, "--queue=sorted-array");
  EXPECT_EQ(told({"solve", "--neighbours", ""}).words, "auto star");
  EXPECT_EQ(told({"solve", "--neighbours=s"}).words, "--neighbours=star");
  EXPECT_EQ(told({"solve", "--lazy", "e"}).words, "expansion");
  EXPECT_EQ(told({"build", "x.scene", "--planner", "r"}).words, "");  // trees are not kept
  EXPECT_EQ(told({"solve", "x.scene", "--", "--op"}).words, "");
}

TEST(Completion, ListsGoOnWithWhatTheyLack) {
  EXPECT_EQ(told({"compare", "w.scene", "--searches", "astar,d"}).words, "astar,dijkstra astar,dfs");
  EXPECT_EQ(told({"compare", "w.scene", "--searches=astar,dfs,"}).words,
            "--searches=astar,dfs,dijkstra --searches=astar,dfs,bfs");
  EXPECT_EQ(told({"compare", "w.scene", "--doors", "midpoint,"}).words, "midpoint,funnel");
  EXPECT_EQ(told({"solve", "w.scene", "--doors", "midpoint,"}).words, "");  // takes one alone
}

TEST(Completion, WorldsAndFiles) {
  const Told world = told({"solve", ""});
  EXPECT_EQ(world.words, "maze:");
  EXPECT_EQ(world.last, "f ");
  EXPECT_EQ(told({"solve", "maze:5x7,a"}).words, "maze:5x7,algorithm=");
  EXPECT_EQ(told({"solve", "maze:5x7,a"}).last, "n ");
  EXPECT_EQ(told({"solve", "maze:5x7,seed=3,"}).words, "maze:5x7,seed=3,algorithm= maze:5x7,seed=3,loops=");
  EXPECT_EQ(told({"solve", "maze:5x7,algorithm=w"}).words, "maze:5x7,algorithm=wilson");
  EXPECT_EQ(told({"query", "r.roadmap", "--world", "ma"}).words, "maze:");
  EXPECT_EQ(told({"solve", "w.scene", "--json", "ou"}).last, "f ");
  EXPECT_EQ(told({"solve", "w.scene", "--json=ou"}).last, "f --json=");
  EXPECT_EQ(told({"compare", "w.scene", "--pictures", ""}).last, "d ");
  EXPECT_EQ(told({"query", "r.roadmap", "--matrix", "a.csv", ""}).last, "f ");
  EXPECT_EQ(told({"query", "r.roadmap", "--matrix", "a.csv", "b.csv", "--cs"}).words, "--csv");
  EXPECT_EQ(told({"verify", "w.scene", ""}).last, "f ");
  EXPECT_EQ(told({"example", "parking-"}).words, "parking-lot");
  EXPECT_EQ(told({"generate", ""}).words, "maze polygons");
  EXPECT_EQ(told({"help", "que"}).words, "query");
  EXPECT_EQ(told({"completion", "z"}).words, "zsh");
}

/// What a real bash makes of the words as it splits them: at "=" and ":" too.
std::string in_bash(const Folder& folder, const std::string& line, const std::string& words) {
  folder.write("ask.sh", "cd \"$1\"; . ./warren.bash\nCOMP_WORDS=(" + words +
                             ")\nCOMP_CWORD=$(( ${#COMP_WORDS[@]} - 1 )) COMP_LINE='" + line +
                             "'\nCOMP_POINT=${#COMP_LINE}\n_warren\necho \"${COMPREPLY[*]}\"\n");
  folder.write("warren.bash", run({"completion", "bash"}).out);
  const std::string out = folder.path("said");
  EXPECT_EQ(std::system(("bash " + folder.path("ask.sh") + " " + folder.path("") + " > " + out + " 2>&1").c_str()), 0);
  return folder.read("said");
}

TEST(Completion, BashGetsWhatItReplaces) {
  const Folder folder;
  folder.write("a world.scene", "");
  const std::string me = program();
  EXPECT_EQ(in_bash(folder, me + " so", me + " so"), "solve\n");
  EXPECT_EQ(in_bash(folder, me + " solve maze:5x7,al", me + " solve maze : 5x7,al"), "5x7,algorithm=\n");
  EXPECT_EQ(in_bash(folder, me + " solve maze:5x7,algorithm=w", me + " solve maze : 5x7,algorithm = w"), "wilson\n");
  EXPECT_EQ(in_bash(folder, me + " solve --queue=so", me + " solve --queue = so"), "sorted-array\n");
  EXPECT_EQ(in_bash(folder, me + " solve --queue=", me + " solve --queue ="),
            "heap lazy-heap sorted-array resorted-array\n");
  EXPECT_EQ(in_bash(folder, me + " solve --queue so", me + " solve --queue so"), "sorted-array\n");
  EXPECT_EQ(in_bash(folder, me + " solve a", me + " solve a"), "ask.sh a world.scene\n");
  EXPECT_EQ(in_bash(folder, me + " solve x --json=as", me + " solve x --json = as"), "ask.sh\n");
  EXPECT_EQ(in_bash(folder, me + " compare x --doors=midpoint,", me + " compare x --doors = midpoint,"),
            "midpoint,funnel\n");
}

/// Shells that are not here are not asked.
TEST(Completion, EveryShellCanReadItsScript) {
  const Folder folder;
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    folder.write("script", run({"completion", shell}).out);
    if (std::system(("command -v " + shell + " > /dev/null").c_str()) != 0) continue;
    EXPECT_EQ(std::system((shell + " -n " + folder.path("script")).c_str()), 0) << shell;
  }
}

TEST(Completion, FishAsksTheProgram) {
  if (std::system("command -v fish > /dev/null") != 0) GTEST_SKIP() << "no fish here";
  const Folder folder;
  folder.write("warren.fish", run({"completion", "fish"}).out);
  const std::string bin = std::filesystem::path(program()).parent_path().string();
  folder.write("ask.fish", "set -x PATH " + bin + " $PATH\nsource " + folder.path("warren.fish") +
                               "\ncomplete -C 'warren solve maze:5x7,al'\ncomplete -C 'warren solve --queue so'\n");
  EXPECT_EQ(std::system(
                ("HOME=" + folder.path("") + " fish " + folder.path("ask.fish") + " > " + folder.path("said")).c_str()),
            0);
  EXPECT_EQ(folder.read("said"), "maze:5x7,algorithm=\nsorted-array\n");
}

}  // namespace
}  // namespace warren::test
