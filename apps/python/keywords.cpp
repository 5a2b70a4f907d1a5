// SPDX-License-Identifier: BSD-3-Clause
#include "apps/python/keywords.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/unknown_words.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

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

std::string keyword_of(std::string_view option) { return with_keywords(std::string(option)); }

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
  for (const tools::OptionSpec& spec : command.options) known.push_back(keyword_of(spec.name));
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

tools::Command command_of(std::string_view name, std::initializer_list<std::span<const tools::OptionSpec>> options,
                          std::initializer_list<std::string_view> without) {
  return {name, "", "", tools::options_but(tools::joined_options(options), without), {}};
}

std::string word_of(py::handle value, const std::string& keyword) {
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
    return word_of(plain, keyword);
  }
  if (PySequence_Check(value.ptr()) != 0) {
    std::string words;
    for (const py::handle item : py::reinterpret_borrow<py::sequence>(value)) {
      words.append(words.empty() ? "" : is_list(item) ? ";" : ",").append(word_of(item, keyword));
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

std::string budget_word(py::handle value) {
  const std::string text = word_of(value, "budget");
  return py::isinstance<py::str>(value) ? text : text + "s";
}

CallLimits take_limits(py::dict& keywords) {
  const auto take = [&](const char* keyword) -> py::object { return keywords.attr("pop")(keyword, py::none()); };
  const auto word = [&](const char* keyword, std::string_view unit) -> std::optional<std::string> {
    const py::object value = take(keyword);
    if (value.is_none()) return std::nullopt;
    const std::string text = word_of(value, keyword);
    return py::isinstance<py::str>(value) ? text : text + std::string(unit);
  };
  const auto threads = word("threads", "");
  const py::object budget = take("budget");
  const auto memory = word("memory", "B");
  const py::object progress = take("progress");
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0) refuse_type("progress", "a function", progress);
  return {threads ? tools::threads_value("--threads", *threads) : 0,
          budget.is_none() ? std::nullopt : std::optional(tools::duration_value("--budget", budget_word(budget))),
          memory ? std::optional(tools::memory_value("--memory", *memory)) : std::nullopt, progress};
}

py::list keyword_table(const tools::Command& command) {
  py::list table;
  for (const tools::OptionSpec& spec : command.options) {
    table.append(py::make_tuple(keyword_of(spec.name), std::string(spec.value), with_keywords(std::string(spec.help)),
                                tools::words_of(spec.choices), spec.value_optional));
  }
  return table;
}

}  // namespace warren::python
