// SPDX-License-Identifier: BSD-3-Clause
// A run that ended goes on: its answer is that of a run that never did, whatever was kept and however many threads go
// on. A file of another run, and one with a bit flipped anywhere, is refused; one that ends anywhere is not.
#include "solve/streamed/resume_file_io.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core/base/error.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/streamed/solve_streamed.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/answer_bytes.hpp"
#include "tests/tools/process.hpp"

namespace warren {
namespace {

using test::bytes_of;

struct Asked {
  MazeOptions maze{.rows = 300, .cols = 280, .seed = 3, .algorithm = MazeAlgorithm::mst, .loops = 0.05};
  Question question = {};
};

std::string solved(const Asked& asked, KeptParts* kept, unsigned threads = 1) {
  const Scene scene = unmade_maze_scene(asked.maze);
  SolveOptions options;
  options.roadmap.pipeline = PipelineKind::streamed;
  return bytes_of(solve_streamed_within(scene, asked.question, options, {.threads = threads}, {.kept = kept}));
}

/// Ends a run when so many parts have been kept.
class EndingAfter : public KeptParts {
 public:
  EndingAfter(KeptParts& parts, int count) : parts_(parts), left_(count) {}
  void begin(std::string_view work) override { parts_.begin(work); }
  std::optional<Bytes> find(PartKind kind, std::uint64_t number) override { return parts_.find(kind, number); }
  void keep(PartKind kind, std::uint64_t number, std::span<const std::byte> bytes) override {
    counting_([&] {
      if (left_-- <= 0) throw Stopped(StopReason::time);
      return 0;
    });
    parts_.keep(kind, number, bytes);
  }

 private:
  KeptParts& parts_;
  int left_;
  OneAtATime counting_;
};

TEST(ResumeFile, ARunGoesOnFromWhereverItEndedToTheSameBytes) {
  const Asked asked{{.rows = 2100, .cols = 2200, .seed = 5, .algorithm = MazeAlgorithm::mst, .loops = 0.01}};
  const std::string expected = solved(asked, nullptr);
  for (const std::uint64_t end : test::seeds(5, 2, 0)) {
    const int parts = std::array{0, 2, 4, 5, 11}[end];  // four groups of the maze, then eleven of tiles
    SCOPED_TRACE(parts);
    const test::Folder folder;
    const auto threads = static_cast<unsigned>(end % 3 + 1);
    {
      ResumeFile file(folder.path("resume"), {});
      EndingAfter ending(file, parts);
      EXPECT_FALSE(solved(asked, &ending, 4 - threads) == expected);
    }
    ResumeFile file(folder.path("resume"), {});
    EXPECT_TRUE(solved(asked, &file, threads) == expected);
    EXPECT_EQ(file.found_count(), static_cast<std::size_t>(parts));
  }
}

TEST(ResumeFile, AFileThatEndsAnywhereIsGoneOnFrom) {
  const test::Folder folder;
  const std::string expected = solved({}, nullptr);
  {
    ResumeFile file(folder.path("whole"), {});
    EXPECT_TRUE(solved({}, &file) == expected);
  }
  const std::string whole = folder.read("whole");
  for (std::size_t part = 0; part < 40; ++part) {
    SCOPED_TRACE(part);
    const std::size_t size = part < 20 ? part * 11 : whole.size() * part / 40 + 1;
    const std::string name = folder.write("cut", std::string_view(whole).substr(0, size));
    ResumeFile file(name, {});
    EXPECT_TRUE(solved({}, &file) == expected);
    EXPECT_EQ(folder.read("cut").size(), whole.size());
  }
}

TEST(ResumeFile, AnyFlippedBitIsRefused) {
  const test::Folder folder;
  {
    ResumeFile file(folder.path("whole"), {});
    solved({}, &file);
  }
  const std::string whole = folder.read("whole");
  for (std::size_t i = 0; i < 400; ++i) {
    const std::size_t at = i < 260 ? i : whole.size() * i / 400;
    SCOPED_TRACE(at);
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (i % 8)));
    ResumeFile file(folder.write("flipped", flipped), {});
    EXPECT_THROW(solved({}, &file), InputError);
  }
}

TEST(ResumeFile, APartOfAnotherRunIsRefused) {
  const test::Folder folder;
  {
    ResumeFile file(folder.path("resume"), {});
    solved({}, &file);
  }
  const std::string whole = folder.read("resume");
  std::vector<Asked> others(7);
  others[0].maze.seed = 4;
  others[1].maze.loops = 0.06;
  others[2].maze.rows = 301;
  others[3].question.start = {3, 3};
  others[4].question.goal = {3, 3};
  others[5].question.clearance = 0.2;
  others[6].question.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.1};
  for (std::size_t i = 0; i < others.size(); ++i) {
    SCOPED_TRACE(i);
    const std::string said = test::refusal<InputError>([&] {
      ResumeFile file(folder.path("resume"), {});
      solved(others[i], &file);
    });
    EXPECT_NE(said.find("was begun by another run"), std::string::npos) << said;
    EXPECT_EQ(folder.read("resume"), whole);
  }
}

TEST(ResumeFile, OtherFilesAreLeftAlone) {
  const test::Folder folder;
  for (const char* text : {"x", "maze 3 3\nwall 1 1 2 2\n"}) {
    ResumeFile file(folder.write("notes", text), {});
    EXPECT_THROW(solved({}, &file), InputError);
    EXPECT_EQ(folder.read("notes"), text);
  }
  EXPECT_THROW(ResumeFile("/dev/null", {}), WriteError);
  EXPECT_THROW(ResumeFile(folder.path("no/folder"), {}), WriteError);
}

TEST(ResumeFile, OneRunAtATimeHasIt) {
  const test::Folder folder;
  const ResumeFile first(folder.path("resume"), {});
  EXPECT_THROW(ResumeFile(folder.path("resume"), {}), WriteError);
}

}  // namespace
}  // namespace warren
