// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/output_file_io.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

TEST(OutputFile, AppearsWholeUnderItsNameAndNothingElseStays) {
  const TemporaryDirectory directory;
  const std::string large(3'000'000, 'x');
  OutputFile file(directory.file("a.txt"), {});
  file.write("one ");
  file.write(large);
  file.write(" two");
  EXPECT_FALSE(std::filesystem::exists(directory.file("a.txt")));
  file.commit();
  EXPECT_EQ(directory.read("a.txt"), "one " + large + " two");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFile, LeavesTheOldFileUntilCommit) {
  const TemporaryDirectory directory;
  directory.write("a.txt", "old");
  {
    OutputFile file(directory.file("a.txt"), {});
    file.write(std::string(2'000'000, 'x'));
  }
  EXPECT_EQ(directory.read("a.txt"), "old");
  EXPECT_EQ(directory.entries(), 1U);
  write_file(directory.file("a.txt"), "new", {});
  EXPECT_EQ(directory.read("a.txt"), "new");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFile, CompleteFilesWaitForCommit) {
  const TemporaryDirectory directory;
  {
    OutputFile given_up(directory.file("a.txt"), {});
    given_up.write("never");
    given_up.complete();
  }
  EXPECT_EQ(directory.entries(), 0U);
  OutputFile file(directory.file("a.txt"), {});
  file.write("whole");
  file.complete();
  EXPECT_FALSE(std::filesystem::exists(directory.file("a.txt")));
  file.commit();
  EXPECT_EQ(directory.read("a.txt"), "whole");
  OutputFile full("/dev/full", {});
  full.write("no room");
  EXPECT_THROW(full.complete(), WriteError);
}

TEST(OutputFile, FollowsLinksAndKeepsPermissions) {
  const TemporaryDirectory directory;
  directory.write("real.txt", "old");
  ::chmod(directory.file("real.txt").c_str(), 0600);
  std::filesystem::create_symlink("real.txt", directory.file("link.txt"));
  write_file(directory.file("link.txt"), "new", {});
  EXPECT_TRUE(std::filesystem::is_symlink(directory.file("link.txt")));
  EXPECT_EQ(directory.read("real.txt"), "new");
  EXPECT_EQ(std::filesystem::status(directory.file("real.txt")).permissions(), std::filesystem::perms(0600));
}

TEST(OutputFile, FollowsLinksToWhereNothingIsYet) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("inner"));
  std::filesystem::create_symlink("inner/second", directory.file("first"));
  std::filesystem::create_symlink("../made.txt", directory.file("inner/second"));
  write_file(directory.file("first"), "new", {});
  EXPECT_EQ(directory.read("made.txt"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(directory.file("first")));
  EXPECT_EQ(directory.entries(), 3U);
}

TEST(OutputFile, TakesNamesOfAnyLegalLength) {
  const TemporaryDirectory directory;
  for (const std::size_t size : {1U, 120U, 128U, 129U, 240U, 250U, 255U}) {
    std::string name(size, 'n');
    if (size > 200) name.replace(2 * (size / 2) - 40, 40, "ääääääääääääääääääää");  // 20 characters of two bytes
    write_file(directory.file(name), name, {});
    EXPECT_EQ(directory.read(name), name) << size;
  }
  EXPECT_EQ(directory.entries(), 7U);
}

/// Begins to write a file and dies without a word.
void die_while_writing(const std::string& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    OutputFile file(path, {});
    file.write(std::string(3'000'000, 'x'));
    ::_exit(0);  // no destructor
  }
  ASSERT_GT(child, 0);
  ::waitpid(child, nullptr, 0);
}

TEST(OutputFile, TheNextRunRemovesWhatAKilledOneLeft) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.txt");
  die_while_writing(path);
  {
    const OutputFile other(path, {});  // holds the first name while another one dies
    EXPECT_EQ(directory.entries(), 1U);
    die_while_writing(path);
    EXPECT_EQ(directory.entries(), 2U);
  }
  EXPECT_EQ(directory.entries(), 1U) << "the second one's rest";
  write_file(path, "new", {});
  EXPECT_EQ(directory.read("a.txt"), "new");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFile, RunsThatWriteTheSameFileLeaveEachOthersPartsAlone) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.txt");
  OutputFile first(path, {});
  OutputFile second(path, {});
  first.write(std::string(2'000'000, '1'));
  second.write(std::string(2'000'000, '2'));
  EXPECT_EQ(directory.entries(), 2U);
  second.commit();
  EXPECT_EQ(directory.read("a.txt"), std::string(2'000'000, '2'));
  first.commit();
  EXPECT_EQ(directory.read("a.txt"), std::string(2'000'000, '1'));
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFile, ANameOfAnOpenDescriptorGoesOnWhereThatIs) {
  const TemporaryDirectory directory;
  const int file = ::open(directory.file("a.txt").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_GE(file, 0);
  ASSERT_EQ(::write(file, "one ", 4), 4);
  write_file("/dev/fd/" + std::to_string(file), "two ", {});
  ASSERT_EQ(::write(file, "three", 5), 5);
  ::close(file);
  EXPECT_EQ(directory.read("a.txt"), "one two three");
}

TEST(OutputFile, RefusesWhatCannotBeWrittenAndNamesIt) {
  const TemporaryDirectory directory;
  directory.write("plain", "");
  for (const std::string& path : {directory.path(), directory.file("no/such/place.txt"), directory.file("plain/a.txt"),
                                  std::string(), std::string("/dev/full"), std::string("/proc/nothing.txt")}) {
    const std::string said = test::refusal<WriteError>([&] { write_file(path, "x", {}); });
    EXPECT_EQ(said.find(path + ": can't be written: "), 0U) << path << ' ' << said;
  }
  EXPECT_EQ(directory.entries(), 1U);
}

/// Whoever puts files into their places together asks this.
TEST(OutputFile, WhatIsWrittenStraightIsNoRegularFileWhereverThatLies) {
  const TemporaryDirectory directory;
  directory.write("a.txt", "old");
  for (const char* path : {"-", "/dev/null", "/dev/stdout", "/proc/self/fd/1"})
    EXPECT_TRUE(is_written_straight(path)) << path;
  EXPECT_FALSE(is_written_straight(directory.file("a.txt")));
  EXPECT_FALSE(is_written_straight(directory.file("new.txt")));
  EXPECT_FALSE(is_written_straight("/dev/shm/no_such_file_of_warren"));
}

TEST(OutputFile, WritesDevicesStraight) {
  write_file("/dev/null", std::string(3'000'000, 'x'), {});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, AClosedPipeIsAnErrorAndNotASignal) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  OutputFile file("/dev/fd/" + std::to_string(ends[1]), {});
  ::close(ends[0]);
  file.write("nobody reads this");
  EXPECT_THROW(file.commit(), WriteError);
  ::close(ends[1]);
}

TEST(OutputFile, WaitingForASlowReaderPollsTheDeadline) {
  const TemporaryDirectory directory;
  const Deadline soon(0.02);
  const Execution execution{.deadline = &soon};
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const auto fill = [&] {
    OutputFile file("/dev/fd/" + std::to_string(ends[1]), execution);
    file.write(std::string(3'000'000, 'x'));
    file.commit();
  };
  EXPECT_THROW(fill(), Stopped);
  ::close(ends[0]);
  ::close(ends[1]);
  ASSERT_EQ(::mkfifo(directory.file("pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_file(directory.file("pipe"), "x", execution), Stopped);  // no reader at all
}

}  // namespace
}  // namespace warren
