// SPDX-License-Identifier: BSD-3-Clause
// Calls from Python into the library: without the interpreter's lock, within limits, and stopped by signals. Only the
// main thread runs Python's handlers, and it is busy here: so while it computes, SIGINT, SIGTERM and SIGHUP that Python
// handles set the flag that all loops of the library look at, beside what Python does with them; then the handler runs.
// No second thread, no hand-over: 1 us a call.
// Python's keywords are the words of a command line: the program's own table says which there are, and the program's
// own readers (tools/words) what they mean, so that an option can't be one thing here and another there. A keyword
// costs under a microsecond.
#pragma once

#include <pybind11/pybind11.h>

#include <csignal>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "solve/question/limits.hpp"
#include "tools/words/command.hpp"

namespace warren::python {

/// While it lives on the main thread, signals that Python handles stop the call. Does nothing on other threads, as
/// Python does. Of calls within a call the outermost alone does so. Nothing else of Python runs on that thread
/// meanwhile: a handler may set another one, and may compute itself. Made and ended with the interpreter's lock held.
class SignalWatch : NotCopied {
 public:
  SignalWatch();
  ~SignalWatch();

  /// The flag that signals set, if any do; else `other`.
  SignalFlag& flag_or(SignalFlag& other) const;

 private:
  bool is_watching_ = false;
};

/// While it lives, the interpreter's lock is free for others. A thread that wants it back when the interpreter has
/// ended sleeps until the process ends, too: CPython would unwind its stack, through destructors, and abort.
class Unlocked : NotCopied {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  ~Unlocked();

 private:
  PyThreadState* state_;
};

/// What a call may take, as its keywords say, and the function that is told how far it is.
class CallLimits {
 public:
  /// `progress`: None, or called with stage, done and total, on another thread.
  CallLimits(unsigned threads, std::optional<double> budget_s, std::optional<std::size_t> memory,
             pybind11::object progress);
  CallLimits() : CallLimits(0, {}, {}, pybind11::none()) {}

  /// Calls `told`, unless it is None, with the figures of each better path, on the thread that calls run(), with the
  /// interpreter's lock held; False, or what it raises, ends the search.
  void tell_improvements(pybind11::object told) { on_improvement_ = std::move(told); }

  /// Calls work(execution) without the interpreter's lock. Throws what it throws, and what handlers of signals and
  /// progress functions raise; Stopped where a handler of a signal lets the program go on.
  template <class Work>
  auto run(const Work& work) {
    try {
      if constexpr (std::is_void_v<decltype(watched(work))>) {
        watched(work);
        raise_failure();
      } else {
        auto made = watched(work);
        raise_failure();
        return made;
      }
    } catch (const Stopped& stopped) {
      raise_what_stopped(stopped.reason);
      throw;
    }
  }
  /// Throws what has stopped a call for that reason, if it was raised in Python.
  void raise_what_stopped(StopReason reason);

 private:
  template <class Work>
  auto watched(const Work& work) {
    const SignalWatch watch;
    const Unlocked unlocked;
    const LimitedExecution limited(limits(watch));
    return work(limited.execution());
  }
  Limits limits(const SignalWatch& watch);
  template <class News>
  bool tell(const News& news) noexcept;
  bool ask_python(const ProgressReport& report);
  bool ask_python(const Improvement& improvement);
  void raise_failure();

  Limits limits_;
  SignalFlag own_flag_{0};
  SignalFlag* flag_ = &own_flag_;  // set by signals, and where a function of Python fails
  pybind11::object progress_;
  pybind11::object on_improvement_ = pybind11::none();
  std::optional<pybind11::error_already_set> failure_;  // of one of these two functions
};

/// From now on what the library throws becomes an exception of warren._errors: each with where, what and value.
void translate_errors();

/// "--goal-bias: ..." as Python says it: "goal_bias: ...".
std::string with_keywords(std::string_view text);

/// A command of these options, but for those named `without`.
tools::Command command_of(std::string_view name, std::initializer_list<std::span<const tools::OptionSpec>> options,
                          std::initializer_list<std::string_view> without = {});

/// What `make` makes: made when it is first asked for, and kept.
template <tools::Command make()>
const tools::Command& made_once() {
  static const tools::Command command = make();
  return command;
}

/// What follows an option on a command line: words as they are, numbers with all their digits, sequences apart by
/// commas, sequences of sequences by semicolons. Throws TypeError.
std::string word_of(pybind11::handle value, const std::string& keyword);

/// The keywords that are not None, nor False where that is a flag left out, after what is there already, such as
/// operands. Throws TypeError for one that the command has not, UsageError.
tools::Arguments arguments_of(const tools::Command& command, const pybind11::dict& keywords,
                              std::vector<std::string> words = {});

/// Takes threads, budget (seconds, or a word such as "500ms"), memory (bytes, or a word such as "2GiB") and progress
/// out of the keywords. Throws UsageError, TypeError.
CallLimits take_limits(pybind11::dict& keywords);
/// The word of --budget: a number is of seconds.
std::string budget_word(pybind11::handle value);

/// The keywords of a command: name, what follows it, help, choices.
pybind11::list keyword_table(const tools::Command& command);

}  // namespace warren::python
