// SPDX-License-Identifier: BSD-3-Clause
// The section `meta` of a .roadmap file: what a roadmap is, as one JSON object with its keys in their documented order.
// Numbers read back as the same doubles.
#pragma once

#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "solve/roadmaps/roadmap.hpp"

namespace warren {

/// What shapes a roadmap beside its world: body, options and seed. A part of meta, of which the header keeps a hash.
std::string recipe_json(const Roadmap& roadmap, const Execution& execution);
/// The whole of meta.
std::string meta_json(const Roadmap& roadmap, const Execution& execution);
/// Fills in all of the roadmap but scene and arrays, which tell their sizes. Throws InputError that names `where`.
void read_meta(const std::string& where, std::string_view text, Roadmap& roadmap, const Execution& execution);
/// The lattice that meta names; 0 x 0 where it names none.
LatticeSize lattice_in_meta(const std::string& where, std::string_view text);

}  // namespace warren
