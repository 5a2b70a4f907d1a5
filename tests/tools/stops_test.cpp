// SPDX-License-Identifier: BSD-3-Clause
// What a stopped program leaves behind. tests/acceptance/stops.py asks all verbs, at random moments.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

/// For processes begun while it lives: no file may grow beyond so many bytes.
class FileSizeLimit : NotCopied {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

const std::vector<std::string> long_run{"solve", "maze:20000x20000", "--json", "-", "--memory", "64GiB"};

void wait_until_it_works(const Process& process) { process.wait_until_it_works_for(std::chrono::milliseconds(250)); }

TEST(Stops, SignalsEndItWithTheirCodeAndPartialFigures) {
  struct Stop {
    int number;
    int code;
    std::string_view name;
  };
  for (const auto& [number, code, name] :
       {Stop{SIGHUP, 129, "SIGHUP"}, Stop{SIGINT, 130, "SIGINT"}, Stop{SIGTERM, 143, "SIGTERM"}}) {
    SCOPED_TRACE(name);
    const auto before = std::signal(number, SIG_DFL);  // where the tests run under nohup, ignored
    Process process(long_run);
    std::signal(number, before);
    wait_until_it_works(process);
    process.send(number);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.code, code) << outcome.err;
    const auto answer = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(answer["status"], "stopped");
    EXPECT_EQ(answer["stopped_by"], name);
  }
}

TEST(Stops, QuietStudiesSayInOneLineThatASignalCame) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"compare", "maze:3000x3000", "--planners", "prm", "--trials", "1000"},
        {"largest", "--budget", "1h", "--start-size", "4000"},
        {"scale", "--sizes", "3000", "--repeats", "1000"}}) {
    SCOPED_TRACE(words.front());
    std::vector<std::string> quiet = words;
    quiet.emplace_back("--quiet");
    Process process(quiet);
    wait_until_it_works(process);
    process.send(SIGTERM);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.code, 143) << outcome.err;
    EXPECT_EQ(outcome.err, "warren: stopped: terminated\n");
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(Stops, AKeyPressedTwiceEndsItInOrderToo) {
  Process process(long_run);
  wait_until_it_works(process);
  for (int i = 0; i < 3; ++i) process.send(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["status"], "stopped");
}

TEST(Stops, AHangUpThatIsIgnoredStaysIgnored) {
  const auto before = std::signal(SIGHUP, SIG_IGN);  // as under nohup
  Process process(long_run);
  std::signal(SIGHUP, before);
  wait_until_it_works(process);
  process.send(SIGHUP);
  wait_until_it_works(process);
  process.send(SIGTERM);
  EXPECT_EQ(process.wait().code, 143);
}

TEST(Stops, AFileBeyondItsLimitIsAnOutputThatCantBeWritten) {
  const Folder folder;
  Outcome outcome;
  {
    const FileSizeLimit limit(10'000);
    outcome = run({"generate", "maze", "200x200", "-o", folder.path("maze.walls")});
  }
  EXPECT_EQ(outcome.code, 73);
  EXPECT_NE(outcome.err.find("maze.walls"), std::string::npos) << outcome.err;
  EXPECT_TRUE(folder.is_empty());
}

TEST(Stops, AreToldEvenWhereNothingElseIs) {
  const std::vector<std::string> quiet{"solve", "maze:20000x20000", "--budget", "50ms", "--memory", "64GiB", "--quiet"};
  const Outcome outcome = run(quiet);
  EXPECT_EQ(outcome.code, 124);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "warren: stopped: the time budget ended\n");
}

TEST(Stops, APictureThatIsNotFinishedTakesItsAnswerBack) {
  const Folder folder;
  const std::string pipe = folder.path("picture");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);  // that nobody reads: drawing never ends
  const std::string json = folder.write("answer", "old");
  const std::vector<std::string> words{"solve", "maze:5x5", "--svg", pipe, "--budget", "2s", "--json"};
  for (const std::string& to : {json, std::string("-")}) {
    SCOPED_TRACE(to);
    std::vector<std::string> arguments = words;
    arguments.push_back(to);
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 124) << outcome.err;
    const nlohmann::json answer = nlohmann::json::parse(to == "-" ? outcome.out : folder.read("answer"));
    EXPECT_EQ(answer["status"], "stopped");
    EXPECT_EQ(answer["verified"], false);
    EXPECT_TRUE(answer["length"].is_null());
    EXPECT_TRUE(answer["path"].empty());
  }
}

}  // namespace
}  // namespace warren::test
