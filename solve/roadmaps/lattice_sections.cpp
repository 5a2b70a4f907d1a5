// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/lattice_sections.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "planners/lengths/route_index.hpp"

namespace warren {
namespace {

/// Elements of other widths are bytes.
ElementType type_of(std::size_t bytes) {
  switch (bytes) {
    case 2:
      return element_type<std::uint16_t>();
    case 4:
      return element_type<std::uint32_t>();
    case 8:
      return element_type<std::uint64_t>();
    default:
      return element_type<std::byte>();
  }
}

/// The bytes of a section of whatever type.
std::span<const std::byte> bytes_of(const RoadmapFile& file, const SectionPlace& place) {
  switch (place.type.bytes()) {
    case 2:
      return std::as_bytes(file.unchecked_section<std::uint16_t>(place.name));
    case 4:
      return std::as_bytes(file.unchecked_section<std::uint32_t>(place.name));
    case 8:
      return std::as_bytes(file.unchecked_section<std::uint64_t>(place.name));
    default:
      return file.unchecked_section<std::byte>(place.name);
  }
}

/// What call() gives; its failures name the file.
template <class Call>
auto named_by(const RoadmapFile& file, const Call& call) {
  try {
    return call();
  } catch (const InputError& error) {
    throw InputError(file.name(), error.what());
  }
}

}  // namespace

void append_lattice_sections(const RouteIndex& index, std::vector<RoadmapSection>& sections) {
  for (const RouteSection& s : route_sections(index)) {
    sections.push_back({s.name, type_of(s.element_bytes), s.bytes});
  }
}

bool has_lattice(const RoadmapFile& file) { return file.find("passages.right") != nullptr; }

bool is_lattice_section(std::string_view name) {
  const std::vector<RouteSection> kinds = route_section_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const RouteSection& kind) { return kind.name == name; });
}

std::unique_ptr<RouteIndex> read_lattice(const RoadmapFile& file, LatticeSize size, const Execution& execution) {
  std::vector<RouteSection> sections = route_section_kinds();
  for (RouteSection& section : sections) {
    const SectionPlace* place = file.find(section.name);
    if (place == nullptr || place->type != type_of(section.element_bytes)) {
      throw InputError(file.name(), "a section of its index is missing or of another type", section.name);
    }
    section.bytes = bytes_of(file, *place);
    section.first_look = file.first_look(*place);
    if (!is_read_in_parts(section.name)) file.check_section(*place, execution);
  }
  return named_by(file, [&] {
    LatticePassages::check_size(size);
    auto index = std::make_unique<RouteIndex>(route_index_of(size, sections));
    if (file.is_small()) check_route_arrays(index->places(), index->arrays());
    return index;
  });
}

void check_lattice(const RoadmapFile& file, const RouteIndex& index, const Execution& execution) {
  file.check_all(execution);
  named_by(file, [&] { check_route_arrays(index.places(), index.arrays()); });
}

}  // namespace warren
