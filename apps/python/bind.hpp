// SPDX-License-Identifier: BSD-3-Clause
// The parts of the module warren._core, a file each. What users see of it is apps/python/warren/: classes with their
// documentation over these bare ones.
#pragma once

#include <pybind11/pybind11.h>

#include "apps/python/library_calls.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"

namespace warren::python {

/// An answer, and what its planner made where it was asked to keep it.
struct KeptAnswer {
  Answer answer;
  ByProducts made = {};
};

/// An answer as it is told, without what nobody asked to keep. Throws what Python's handlers of signals raise that have
/// stopped it, or its explanation.
KeptAnswer finished(KeptAnswer said, bool keep, CallLimits& limits);

void bind_worlds(pybind11::module_& module);
void bind_answers(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);
void bind_solving(pybind11::module_& module);
void bind_roadmaps(pybind11::module_& module);
void bind_studies(pybind11::module_& module);

// Worlds and answers as bytes, for pickle: what one version of the library writes, the same version reads. One list of
// members a type (binary_archive.cpp) serves both ways.

template <class T>
pybind11::bytes bytes_of(const T& value);

/// Throws InputError for the bytes of another version, or cut off.
template <class T>
T from_bytes(const pybind11::bytes& bytes);

}  // namespace warren::python
