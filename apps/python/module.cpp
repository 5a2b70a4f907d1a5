// SPDX-License-Identifier: BSD-3-Clause
// The module warren._core.
#include <pybind11/pybind11.h>

#include "apps/python/bind.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace warren::python;
  module.attr("__version__") = WARREN_VERSION;
  translate_errors();
  bind_worlds(module);
  bind_answers(module);
  bind_pictures(module);
  bind_solving(module);
  bind_roadmaps(module);
}
