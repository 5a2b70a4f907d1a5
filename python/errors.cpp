// SPDX-License-Identifier: BSD-3-Clause
#include "python/errors.hpp"

#include <cctype>
#include <exception>
#include <string_view>

#include "core/base/error.hpp"
#include "parallel/deadline.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

py::object error_class(const char* name) { return py::module_::import("warren._errors").attr(name); }

void set(const char* name, std::string_view where, std::string_view what, std::string_view value) {
  const py::object type = error_class(name);
  PyErr_SetObject(type.ptr(), type(std::string(where), std::string(what), std::string(value)).ptr());
}

void set(const char* name, const PlacedError& error) { set(name, error.where(), error.wrong(), error.value()); }

bool is_keyword(std::string_view text) {
  return text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string_view::npos;
}

/// A line of the program's words: "goal_bias: expected a number from 0 to 1 (found: '2')".
void set_usage(std::string_view line) {
  const std::size_t colon = line.find(": ");
  const bool has_place = colon != std::string_view::npos && is_keyword(line.substr(0, colon));
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

void set_stopped(StopReason reason, const py::object& answer) {
  const py::object type = error_class("Stopped");
  const std::string_view name = name_of(reason);
  PyErr_SetObject(type.ptr(), type(std::string(name), std::string(text_of(reason)), answer).ptr());
}

}  // namespace

std::string with_keywords(std::string text) {
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

void raise_stopped(StopReason reason, const py::object& answer) {
  set_stopped(reason, answer);
  throw py::error_already_set();
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
      set_stopped(stopped.reason, py::none());
    }
  });
}

}  // namespace warren::python
