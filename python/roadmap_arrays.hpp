// SPDX-License-Identifier: BSD-3-Clause
// States and edges of a roadmap as NumPy's arrays.
#pragma once

#include <pybind11/numpy.h>

#include "python/kept_roadmap.hpp"

namespace warren::python {

/// indptr, indices and lengths of all edges: views that keep the roadmap, `self`, alive.
pybind11::tuple all_rows(const pybind11::object& self);
/// The same of the free edges, in arrays of their own.
pybind11::tuple free_rows_of(KeptRoadmap& kept);
/// 0 unchecked, 1 free, 2 blocked: of each edge end.
pybind11::array edge_states(KeptRoadmap& kept);
/// (n, numbers of a state): a view that keeps the roadmap, `self`, alive.
pybind11::array states_of(const pybind11::object& self);
/// A copy: what is learnt changes it.
pybind11::array components_of(KeptRoadmap& kept);

}  // namespace warren::python
