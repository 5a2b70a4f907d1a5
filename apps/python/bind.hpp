// SPDX-License-Identifier: BSD-3-Clause
// The parts of the module warren._core, a file each. What users see of it is apps/python/warren/: classes with their
// documentation over these bare ones.
//
// Calls from Python into the library (library_calls.cpp): without the interpreter's lock, within limits, and stopped by
// signals. Only the main thread runs Python's handlers, and it is busy here: so while it computes, SIGINT, SIGTERM and
// SIGHUP that Python handles set the flag that all loops of the library look at, beside what Python does with them;
// then the handler runs. No second thread, no hand-over: 1 us a call.
// Python's keywords are the words of a command line: the program's own table says which there are, and the program's
// own readers (tools/words) what they mean, so that an option can't be one thing here and another there. A keyword
// costs under a microsecond.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kept/roadmap_query.hpp"
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
/// commas, sequences of sequences by semicolons; depth: of the value in others. Throws TypeError.
std::string word_of(pybind11::handle value, const std::string& keyword, unsigned depth = 0);

/// The keywords that are not None, nor False where that is a flag left out, after what is there already, such as
/// operands. Throws TypeError for one that the command has not, UsageError.
tools::Arguments arguments_of(const tools::Command& command, const pybind11::dict& keywords,
                              std::vector<std::string> words = {});

/// Takes the keyword out, as word_of() has it, a number with its unit; none where it is None.
std::optional<std::string> take_word(pybind11::dict& keywords, const char* keyword, const char* unit = "");

/// Takes threads, budget (seconds, or a word such as "500ms"), memory (bytes, or a word such as "2GiB") and progress
/// out of the keywords. Throws UsageError, TypeError.
CallLimits take_limits(pybind11::dict& keywords);

/// The keywords of a command: name, what follows it, help, choices.
pybind11::list keyword_table(const tools::Command& command);

/// An answer, and what its planner made where it was asked to keep it.
struct KeptAnswer {
  Answer answer;
  ByProducts made = {};
};

/// An answer as it is told, without what nobody asked to keep. Throws what Python's handlers of signals raise that have
/// stopped it, or its explanation.
KeptAnswer finished(KeptAnswer said, bool keep, CallLimits& limits);

/// A roadmap that Python holds, with what its questions need: made when they are first asked, kept for the next ones.
/// Not movable, for queries refer to the roadmap. Any number of threads may ask.
class KeptRoadmap {
 public:
  explicit KeptRoadmap(Roadmap roadmap) : roadmap_(std::move(roadmap)) {}

  const Roadmap& roadmap() const { return roadmap_; }
  const RoadmapQuery& query(const Execution& execution) const;
  /// States and edges; a lattice's are made for it.
  const RoadmapArrays& arrays(const Execution& execution) const;
  /// Length of each edge end, in the order of arrays().
  const RawVector<double>& lengths(const Execution& execution) const;
  double length(VertexId from, VertexId to, const RoadmapQuery* query) const;
  /// Takes over what the questions so far have learnt of the edges. Nobody may ask meanwhile.
  void learn(const Execution& execution);

 private:
  friend class Asking;
  static constexpr int learner = -1;
  int askers_ = 0;  // calls that ask now, or `learner`; read and written with the interpreter's lock held

  Roadmap roadmap_;
  MadeOnce<RoadmapQuery> query_;
  MadeOnce<RoadmapArrays> lattice_;
  MadeOnce<RawVector<double>> lengths_;
};

/// One of those who ask: any number of them, while nobody learns; or the only one, who learns and may change the
/// roadmap. Made and ended with the interpreter's lock held, which is free between.
class Asking : NotCopied {
 public:
  /// Throws ValueError while another thread learns, and for who `learns` while another one asks.
  explicit Asking(KeptRoadmap& kept, bool learns = false) : kept_(kept) {
    if (learns && kept.askers_ != 0) throw pybind11::value_error("learn: another thread asks this roadmap now");
    if (kept.askers_ == KeptRoadmap::learner)
      throw pybind11::value_error("roadmap: another thread calls its learn() now");
    kept.askers_ = learns ? KeptRoadmap::learner : kept.askers_ + 1;
  }
  ~Asking() { kept_.askers_ = kept_.askers_ == KeptRoadmap::learner ? 0 : kept_.askers_ - 1; }

 private:
  KeptRoadmap& kept_;
};

void bind_worlds(pybind11::module_& module);
void bind_answers(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);
void bind_solving(pybind11::module_& module);
void bind_roadmaps(pybind11::module_& module);

// NumPy's arrays in and out. In: read where they lie, so their type and layout must fit, and a TypeError says how they
// don't; what is no array (lists, tuples) and whole numbers are converted, and what a mask hides is refused. Out:
// read-only views of what an object of ours holds, which keep that object alive, or arrays that own their block.

using Shape = std::vector<pybind11::ssize_t>;

/// Of these sizes.
template <class... Sizes>
Shape shape_of(Sizes... sizes) {
  return {static_cast<pybind11::ssize_t>(sizes)...};
}

inline pybind11::array read_only(pybind11::array array) {
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Numbers in C order that `owner` holds.
template <class T>
pybind11::array view_of(const T* numbers, Shape shape, pybind11::handle owner) {
  return read_only(pybind11::array(pybind11::dtype::of<T>(), std::move(shape), {}, numbers, owner));
}

/// Takes a block of numbers: a vector of them, or of structs of them. row: the shape of each row, of which there are as
/// many as the block has numbers for.
template <class T, class Block>
pybind11::array array_of(Block block, Shape row = {}) {
  std::size_t rows = block.size() * sizeof(block[0]) / sizeof(T);
  for (const pybind11::ssize_t size : row) rows /= static_cast<std::size_t>(size);
  row.insert(row.begin(), static_cast<pybind11::ssize_t>(rows));
  auto held = std::make_unique<Block>(std::move(block));
  const auto* numbers = reinterpret_cast<const T*>(held->data());  // NOLINT: structs of T alone
  const pybind11::capsule owner(held.release(), [](void* p) { delete static_cast<Block*>(p); });
  return read_only(pybind11::array(pybind11::dtype::of<T>(), std::move(row), {}, numbers, owner));
}

/// Rows of numbers, float64 in C order. Keeps the array that holds them.
struct NumberRows {
  pybind11::array_t<double, pybind11::array::c_style> array;
  const double* numbers = nullptr;
  std::size_t rows = 0;
  std::size_t columns = 0;

  std::vector<double> row(std::size_t i) const { return {numbers + i * columns, numbers + (i + 1) * columns}; }
};

/// An (n, columns) argument, of float64 or of whole numbers. Throws TypeError, which names it, for another type or
/// shape.
NumberRows rows_of(pybind11::handle value, const std::string& name, std::initializer_list<std::size_t> columns);

/// Throws TypeError where it is an array with a mask that hides something.
void refuse_masked(pybind11::handle value, const std::string& name);

/// An array of whole numbers?
bool is_whole(pybind11::handle value);

/// "int64 (5, 2)": what an array is, for errors.
std::string kind_of(const pybind11::array& array);

// Worlds and answers as bytes, for pickle: what one version of the library writes, the same version reads. One list of
// members a type (binary_archive.cpp) serves both ways.

template <class T>
pybind11::bytes bytes_of(const T& value);

/// Throws InputError for the bytes of another version, or cut off.
template <class T>
T from_bytes(const pybind11::bytes& bytes);

}  // namespace warren::python
