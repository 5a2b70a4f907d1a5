// SPDX-License-Identifier: BSD-3-Clause
// A route index as named arrays of bytes, for whoever writes files, and back: the arrays of a mapped file are looked at
// where they are. Numbers lie in the machine's own order; elements have the widths that route_index.hpp says.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "planners/route_index/route_index.hpp"

namespace warren {

struct RouteSection {
  std::string_view name;      ///< a literal, at most 15 letters
  std::size_t element_bytes;  ///< of one element; for structs, their size
  std::span<const std::byte> bytes;
  FirstLook first_look = {};  ///< before its bytes are read
};

/// All arrays, in a fixed order; they live as long as the index.
std::vector<RouteSection> route_sections(const RouteIndex& index);

/// Their names and widths alone, without bytes.
std::vector<RouteSection> route_section_kinds();

/// An index that looks at the sections' bytes, which must outlive it and be aligned to 8 bytes. Sections with other
/// names are left alone. Throws InputError for one that is missing, has half an element, or contradicts another.
RouteIndex route_index_of(LatticeSize size, std::span<const RouteSection> sections);

/// May its bytes be looked at one by one, when they are needed? Else whoever makes an index of it looks at all of them.
bool is_read_in_parts(std::string_view section);

/// What an index of views relies on: throws InputError unless arrays have the sizes that the lattice and the others ask
/// for, and fronts lie in theirs. O(fronts).
void check_route_sizes(const LatticePlaces& places, const RouteArrays& arrays);

/// The bounds and lengths of a front whose place in the arrays is right, each in its range.
void check_front_arrays(const FrontArrays& arrays, const Front& front);

/// Throws InputError unless every number in the arrays is in its range; what is wrong nevertheless gives wrong answers
/// and nothing worse. O(bytes).
void check_route_arrays(const LatticePlaces& places, const RouteArrays& arrays);

}  // namespace warren
