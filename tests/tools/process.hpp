// SPDX-License-Identifier: BSD-3-Clause
// Runs the built program as a process, as a user would: arguments, standard input, files of its own; exit code and
// both outputs back. A run that does not end is killed and reported as code -1.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/base/types.hpp"
#include "tests/paths.hpp"

namespace warren::test {

/// A folder that lives as long as the test.
class Folder : NotCopied {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "warren_test_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }
  bool is_empty() const { return std::filesystem::is_empty(path_); }

 private:
  std::filesystem::path path_;
};

/// A world of examples/worlds/.
inline std::string world_file(const std::string& name) { return source_dir() + "/examples/worlds/" + name; }

inline std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct Outcome {
  int code = -1;  ///< 128 + n if signal n killed it
  std::string out;
  std::string err;
};

/// One process, running from construction on.
class Process {
 public:
  explicit Process(const std::vector<std::string>& arguments, const std::string& input = "/dev/null",
                   const std::string& output = {}) {
    const std::string out = output.empty() ? folder_.path("out") : output;
    const std::string err = folder_.path("err");
    std::vector<std::string> words{program()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    child_ = ::fork();
    if (child_ != 0) return;
    redirect(input, O_RDONLY, STDIN_FILENO);
    redirect(out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    ::execv(pointers[0], pointers.data());
    ::_exit(127);
  }
  void send(int signal) const { ::kill(child_, signal); }

  /// Waits until it has computed for so long, or has ended: on a busy machine a sleep says nothing about that.
  void wait_until_it_computed_for(std::chrono::milliseconds time) const {
    clockid_t clock{};
    timespec used{};
    while (::clock_getcpuclockid(child_, &clock) == 0 && ::clock_gettime(clock, &used) == 0 &&
           std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec) < time && !has_ended()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  /// Waits until it takes SIGTERM its own way, and then until it has computed for so long more, or has ended.
  void wait_until_it_works_for(std::chrono::milliseconds time) const {
    while (!catches(SIGTERM) && !has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    clockid_t clock{};
    timespec used{};
    if (::clock_getcpuclockid(child_, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return;
    const auto before = std::chrono::seconds(used.tv_sec) + std::chrono::milliseconds(used.tv_nsec / 1'000'000);
    wait_until_it_computed_for(before + time);
  }

  Outcome wait() {
    constexpr auto patience = std::chrono::seconds(120);  // sanitizers on a busy machine
    const auto end = std::chrono::steady_clock::now() + patience;
    int status = 0;
    while (::waitpid(child_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > end) {
        ::kill(child_, SIGKILL);
        ::waitpid(child_, &status, 0);
        return {-1, folder_.read("out"), "killed: it did not end"};
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, folder_.read("out"), folder_.read("err")};
  }

 private:
  bool has_ended() const {
    siginfo_t ended{};
    const int failed = ::waitid(P_PID, static_cast<id_t>(child_), &ended, WEXITED | WNOHANG | WNOWAIT);
    return failed != 0 || ended.si_pid != 0;
  }
  bool catches(int signal) const {
    std::ifstream status("/proc/" + std::to_string(child_) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1U) != 0;
    }
    return false;
  }
  static void redirect(const std::string& path, int flags, int descriptor) {
    const int file = ::open(path.c_str(), flags, 0600);
    if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
  }

  Folder folder_;
  pid_t child_ = -1;
};

inline Outcome run(const std::vector<std::string>& arguments, const std::string& input = "/dev/null") {
  return Process(arguments, input).wait();
}

inline std::string shown(const std::vector<std::string>& arguments) {
  std::string line = "warren";
  for (const std::string& word : arguments) line += ' ' + word;
  return line;
}

/// One command line that has to fail, or not, in a stated way.
struct Case {
  std::vector<std::string> arguments;
  int code;
  std::string_view said;  ///< part of standard error; empty: anything
};

/// Exit code and message are as stated, and nothing came on standard output where the code is that of an error.
inline void check(const Case& c, const std::string& input = "/dev/null") {
  SCOPED_TRACE(shown(c.arguments));
  const Outcome outcome = run(c.arguments, input);
  EXPECT_EQ(outcome.code, c.code) << outcome.err << outcome.out;
  EXPECT_NE(outcome.err.find(c.said), std::string::npos) << "standard error: " << outcome.err;
  const bool refused = c.code == 2 || c.code >= 64;
  if (refused && c.code != 124) {
    EXPECT_EQ(outcome.out, "");
  }
}

}  // namespace warren::test
