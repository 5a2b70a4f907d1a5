// SPDX-License-Identifier: BSD-3-Clause
#include "apps/python/bind.hpp"

#include <cxxabi.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <exception>

#include "tools/screen/run_of_verb.hpp"
#include "tools/words/help.hpp"
#include "tools/words/option_values.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

constinit SignalFlag flag{0};
constexpr std::array<int, 3> watched{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, watched.size()> pythons;  // what Python does at each; only the main thread writes it
int watches = 0;  // calls that are on the main thread: one, and those that its on_improvement makes

/// Called by any thread. Python's own handler only takes a note, too.
void take_note(int number) {
  flag.store(number, std::memory_order_relaxed);
  for (std::size_t i = 0; i < watched.size(); ++i) {
    if (watched[i] == number) pythons[i].sa_handler(number);
  }
}

bool is_handled_by_function(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN;
}

bool is_main_thread() {
  static const auto main_thread =
      py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  return PyThread_get_thread_ident() == main_thread;
}

/// Calls what wants the interpreter's lock; where the interpreter has ended, which unwinds this thread, it never
/// returns. So nothing that Python counts may be a local of `call`.
template <class Call>
void or_sleep_at_exit(const Call& call) noexcept {
  try {
    call();
  } catch (abi::__forced_unwind&) {
    while (true) ::pause();
  }
}

py::object error_class(const char* name) { return py::module_::import("warren._errors").attr(name); }

void set(const char* name, std::string_view where, std::string_view what, std::string_view value) {
  const py::object type = error_class(name);
  PyErr_SetObject(type.ptr(), type(std::string(where), std::string(what), std::string(value)).ptr());
}

void set(const char* name, const PlacedError& error) { set(name, error.where(), error.wrong(), error.value()); }

/// A line of the program's words: "goal_bias: expected a number from 0 to 1 (found: '2')".
void set_usage(std::string_view line) {
  const std::size_t colon = line.find(": ");
  const std::size_t keyword_end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_");
  const bool has_place = colon != std::string_view::npos && keyword_end == colon;
  const std::string_view where = has_place ? line.substr(0, colon) : "";
  std::string_view what = has_place ? line.substr(colon + 2) : line;
  std::string_view value;
  constexpr std::string_view before = " (found: ";
  if (const std::size_t found = what.rfind(before); found != std::string_view::npos && what.ends_with(')')) {
    value = what.substr(found + before.size(), what.size() - found - before.size() - 1);
    what = what.substr(0, found);
  }
  set("UsageError", where, what, value);
}

std::string option_of(std::string_view keyword) {
  std::string option = "--" + std::string(keyword);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

/// Keywords that say the same more shortly, or because the word itself is Python's.
constexpr std::pair<std::string_view, std::string_view> other_keywords[] = {
    {"goals", "goal"}, {"tolerance", "goal_tolerance"}, {"region", "goal_region"}, {"return_", "return"}};

std::string_view own_keyword(std::string_view keyword) {
  for (const auto& [other, own] : other_keywords) {
    if (keyword == other) return own;
  }
  return keyword;
}

bool is_list(py::handle value) { return PySequence_Check(value.ptr()) != 0 && !py::isinstance<py::str>(value); }

/// Is it several values of an option that may be given several times? One value begins with or has a number.
bool is_several(py::handle value) {
  if (!is_list(value)) return false;
  const auto items = py::reinterpret_borrow<py::sequence>(value);
  return std::all_of(items.begin(), items.end(),
                     [](py::handle item) { return is_list(item) || py::isinstance<py::str>(item); });
}

[[noreturn]] void refuse_type(const std::string& keyword, std::string_view expected, py::handle found) {
  throw py::type_error(fmt::format("{}: expected {} (found: {})", keyword, expected,
                                   py::str(py::type::handle_of(found).attr("__name__")).cast<std::string>()));
}

[[noreturn]] void refuse_keyword(const tools::Command& command, const std::string& keyword) {
  const std::string option = option_of(keyword);
  for (const auto& [name, why] : command.foreign) {
    if (name == option) throw UsageError(fmt::format("{}: {}", name, why));
  }
  std::vector<std::string> known;
  for (const tools::OptionSpec& spec : command.options) known.push_back(with_keywords(spec.name));
  const std::vector<std::string_view> names(known.begin(), known.end());
  throw py::type_error(fmt::format("{}() got an unexpected keyword argument '{}'{}", command.name, keyword,
                                   with_keywords(tools::suggestion(keyword, names))));
}

void add_flag(const tools::OptionSpec& spec, const std::string& keyword, py::handle value,
              std::vector<std::string>& words) {
  if (value.is(py::bool_(true))) {
    words.emplace_back(spec.name);
  } else if (spec.value.empty()) {
    refuse_type(keyword, "True or False", value);
  } else {
    words.push_back(std::string(spec.name) + "=" + word_of(value, keyword));
  }
}

/// areas=[(F, polygon), ...] are what --area says, which beside it has files.
void add_several(const tools::OptionSpec& spec, const std::string& keyword, py::handle value,
                 std::vector<std::string>& words) {
  const py::object plain =
      py::hasattr(value, "tolist") ? value.attr("tolist")() : py::reinterpret_borrow<py::object>(value);
  const auto add = [&](py::handle item) {
    const bool is_polygon = spec.name == "--areas" && is_list(item) && py::len(item) == 2 &&
                            is_list(py::reinterpret_borrow<py::sequence>(item)[1]);
    words.push_back(std::string(is_polygon ? "--area" : spec.name) + "=" + word_of(item, keyword));
  };
  if (!is_several(plain)) return add(plain);
  for (const py::handle item : py::reinterpret_borrow<py::sequence>(plain)) add(item);
}

}  // namespace

SignalWatch::SignalWatch() : is_watching_(is_main_thread()) {
  if (!is_watching_ || watches++ > 0) return;
  flag.store(0, std::memory_order_relaxed);
  for (std::size_t i = 0; i < watched.size(); ++i) {
    ::sigaction(watched[i], nullptr, &pythons[i]);
    if (!is_handled_by_function(pythons[i])) continue;
    struct sigaction ours = pythons[i];
    ours.sa_handler = take_note;
    ::sigaction(watched[i], &ours, nullptr);
  }
}

SignalWatch::~SignalWatch() {
  if (!is_watching_ || --watches > 0) return;
  for (std::size_t i = 0; i < watched.size(); ++i) {
    if (is_handled_by_function(pythons[i])) ::sigaction(watched[i], &pythons[i], nullptr);
  }
}

SignalFlag& SignalWatch::flag_or(SignalFlag& other) const { return is_watching_ ? flag : other; }

Unlocked::~Unlocked() {
  or_sleep_at_exit([&] { PyEval_RestoreThread(state_); });
}

CallLimits::CallLimits(unsigned threads, std::optional<double> budget_s, std::optional<std::size_t> memory,
                       py::object progress)
    : progress_(std::move(progress)) {
  limits_.threads = threads;
  constexpr double longest_s = 1e9;  // thirty years are no limit, and nanoseconds count to a few hundred
  constexpr double shortest_s = 1e-9;
  if (budget_s && *budget_s < longest_s) {
    const std::chrono::duration<double> seconds(std::max(*budget_s, shortest_s));
    limits_.budget = std::chrono::duration_cast<std::chrono::nanoseconds>(seconds);
  }
  limits_.memory = memory;
}

/// False where nothing more is to be told.
template <class News>
bool CallLimits::tell(const News& news) noexcept {
  bool goes_on = false;
  or_sleep_at_exit([&] {
    const PyGILState_STATE state = PyGILState_Ensure();
    goes_on = !failure_ && ask_python(news);
    PyGILState_Release(state);
  });
  return goes_on;
}

Limits CallLimits::limits(const SignalWatch& watch) {
  flag_ = &watch.flag_or(own_flag_);
  limits_.cancel = flag_;
  if (!progress_.is_none()) limits_.progress = [this](const ProgressReport& report) { tell(report); };
  if (!on_improvement_.is_none()) limits_.on_improvement = [this](const Improvement& better) { return tell(better); };
  return limits_;
}

bool CallLimits::ask_python(const ProgressReport& report) {
  PyObject* stage = PyUnicode_FromStringAndSize(report.stage.data(), static_cast<Py_ssize_t>(report.stage.size()));
  PyObject* said = PyObject_CallFunction(progress_.ptr(), "NKK", stage, static_cast<unsigned long long>(report.done),
                                         static_cast<unsigned long long>(report.total));
  Py_XDECREF(said);
  if (said != nullptr) return true;
  failure_.emplace();
  flag_->store(SIGINT, std::memory_order_relaxed);
  return false;
}

bool CallLimits::ask_python(const Improvement& improvement) {
  PyObject* said = PyObject_CallFunction(
      on_improvement_.ptr(), "Kdddsd", static_cast<unsigned long long>(improvement.iterations), improvement.seconds,
      improvement.length, improvement.cost, improvement.by.c_str(), improvement.lower_bound);
  // None, as of a function without return, goes on; NumPy's False is not Python's.
  const int truth = said == nullptr ? -1 : said == Py_None ? 1 : PyObject_IsTrue(said);
  const bool goes_on = truth > 0;
  Py_XDECREF(said);
  if (truth < 0) failure_.emplace();
  return goes_on;
}

void CallLimits::raise_failure() {
  if (failure_) throw std::move(*failure_);
}

void CallLimits::raise_what_stopped(StopReason reason) {
  raise_failure();
  // Python runs its handlers, which raise KeyboardInterrupt, most of all.
  if (is_signal(reason) && PyErr_CheckSignals() != 0) throw py::error_already_set();
}

std::string with_keywords(std::string_view text) {
  std::string said;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = text.compare(i, 2, "--") == 0 && i + 2 < text.size() && std::islower(text[i + 2]) != 0 &&
                        (i == 0 || text[i - 1] == ' ');
    if (!begins) {
      said += text[i];
      continue;
    }
    for (i += 2; i < text.size() && (std::islower(text[i]) != 0 || text[i] == '-'); ++i) {
      said += text[i] == '-' ? '_' : text[i];
    }
    --i;
  }
  return said;
}

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const UsageError& error) {
      set_usage(with_keywords(error.spelled("", '_')));
    } catch (const InputError& error) {
      set("InputError", error);
    } catch (const ReadError& error) {
      set("ReadError", error);
    } catch (const WriteError& error) {
      set("WriteError", error);
    } catch (const Stopped& stopped) {
      const py::object type = error_class("Stopped");
      const std::string name(name_of(stopped.reason));
      PyErr_SetObject(type.ptr(), type(name, stop_text(stopped.reason, stopped.wanted_bytes), py::none()).ptr());
    }
  });
}

tools::Command command_of(std::string_view name, std::initializer_list<std::span<const tools::OptionSpec>> options,
                          std::initializer_list<std::string_view> without) {
  return {name, "", "", tools::options_but(tools::joined_options(options), without), {}};
}

std::string word_of(py::handle value, const std::string& keyword, unsigned depth) {
  constexpr unsigned deepest = 8;  // a list may hold itself
  if (py::isinstance<py::str>(value)) {
    Py_ssize_t size = 0;
    const char* const text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
    if (text != nullptr) return {text, static_cast<std::size_t>(size)};
    PyErr_Clear();
    throw py::value_error(keyword + ": a lone surrogate is in it, which is no character");
  }
  if (py::isinstance<py::bool_>(value)) refuse_type(keyword, "a word, a number or numbers", value);
  if (PyFloat_Check(value.ptr()) != 0) return fmt::format("{}", value.cast<double>());
  if (PyIndex_Check(value.ptr()) != 0 && PySequence_Check(value.ptr()) == 0) {
    return py::str(py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()))).cast<std::string>();
  }
  if (py::hasattr(value, "__fspath__")) return py::module_::import("os").attr("fspath")(value).cast<std::string>();
  if (py::hasattr(value, "tolist")) {
    const py::object plain = value.attr("tolist")();
    if (py::hasattr(plain, "tolist")) refuse_type(keyword, "a word, a number or numbers", value);
    return word_of(plain, keyword, depth);
  }
  if (PySequence_Check(value.ptr()) != 0 && depth < deepest) {
    std::string words;
    for (const py::handle item : py::reinterpret_borrow<py::sequence>(value)) {
      words.append(words.empty() ? "" : is_list(item) ? ";" : ",").append(word_of(item, keyword, depth + 1));
    }
    return words;
  }
  if (PyNumber_Check(value.ptr()) != 0) {  // no float or int of Python: numpy's
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Float(value.ptr()));
    if (number) return fmt::format("{}", number.cast<double>());
    PyErr_Clear();
  }
  refuse_type(keyword, "a word, a number or numbers", value);
}

tools::Arguments arguments_of(const tools::Command& command, const py::dict& keywords, std::vector<std::string> words) {
  for (const auto& [name, value] : keywords) {
    if (value.is_none()) continue;
    const auto keyword = name.cast<std::string>();
    const std::string option = option_of(own_keyword(keyword));
    const tools::OptionSpec* spec = tools::option_named(command, option);
    if (spec == nullptr) refuse_keyword(command, keyword);
    if (spec->value.empty() || spec->value_optional) {
      if (!value.is(py::bool_(false))) add_flag(*spec, keyword, value, words);
    } else if (spec->may_repeat) {
      add_several(*spec, keyword, value, words);
    } else {
      words.push_back(option + "=" + word_of(value, keyword));
    }
  }
  return {command, words};
}

std::optional<std::string> take_word(py::dict& keywords, const char* keyword, const char* unit) {
  const py::object value = keywords.attr("pop")(keyword, py::none());
  if (value.is_none()) return std::nullopt;
  return word_of(value, keyword) + (py::isinstance<py::str>(value) ? "" : unit);
}

CallLimits take_limits(py::dict& keywords) {
  const auto threads = take_word(keywords, "threads");
  const auto budget = take_word(keywords, "budget", "s");
  const auto memory = take_word(keywords, "memory", "B");
  const py::object progress = keywords.attr("pop")("progress", py::none());
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0) refuse_type("progress", "a function", progress);
  return {threads ? tools::threads_value("--threads", *threads) : 0,
          budget ? std::optional(tools::duration_value("--budget", *budget)) : std::nullopt,
          memory ? std::optional(tools::memory_value("--memory", *memory)) : std::nullopt, progress};
}

py::list keyword_table(const tools::Command& command) {
  py::list table;
  for (const tools::OptionSpec& spec : command.options) {
    table.append(py::make_tuple(with_keywords(spec.name), std::string(spec.value), with_keywords(spec.help),
                                tools::words_of(spec.choices), spec.value_optional));
  }
  return table;
}

}  // namespace warren::python
