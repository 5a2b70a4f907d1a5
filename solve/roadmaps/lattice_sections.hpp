// SPDX-License-Identifier: BSD-3-Clause
// A lattice roadmap as sections of its file: its passages, and the arrays of its route index under their own names.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "parallel/execution.hpp"
#include "planners/lengths/route_index.hpp"
#include "roadmaps/file/roadmap_file.hpp"
#include "roadmaps/file/write_roadmap_file.hpp"

namespace warren {

/// They live as long as the index.
void append_lattice_sections(const RouteIndex& index, std::vector<RoadmapSection>& sections);

bool has_lattice(const RoadmapFile& file);
/// Is it one of their names?
bool is_lattice_section(std::string_view name);

/// Looks at the file, which must outlive it. Of a file of up to 64 MiB all is checked; of a larger one questions check
/// what they look at, and throw InputError. Throws InputError, Stopped.
std::unique_ptr<RouteIndex> read_lattice(const RoadmapFile& file, LatticeSize size, const Execution& execution);
/// Checks all of a large file's index, too. Throws InputError, Stopped.
void check_lattice(const RoadmapFile& file, const RouteIndex& index, const Execution& execution);

}  // namespace warren
