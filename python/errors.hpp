// SPDX-License-Identifier: BSD-3-Clause
// What the library throws, as Python's exceptions of warren/_errors.py: each with where, what and value.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "core/base/stop_reason.hpp"

namespace warren::python {

/// From now on what the library throws becomes an exception of warren._errors.
void translate_errors();

/// Throws warren.Stopped with the answer, or None, that it has so far.
[[noreturn]] void raise_stopped(StopReason reason, const pybind11::object& answer);

/// "--goal-bias: ..." as Python says it: "goal_bias: ...".
std::string with_keywords(std::string text);

}  // namespace warren::python
