// SPDX-License-Identifier: BSD-3-Clause
// Reads the header of a .roadmap file and holds all of it against the bytes that there are: afterwards each section
// lies within the file where the layout says, whoever made the file. Looks at nothing but the header and the zeros
// between sections; takes memory for at most 64 sections.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "roadmaps/file/file_layout.hpp"
#include "roadmaps/file/roadmap_file_header.hpp"

namespace warren {

struct CheckedHeader {
  RoadmapFileHeader header;
  std::vector<SectionPlace> sections;
  std::size_t blocks = 0;
};

/// Throws InputError, which names the file as `name`: no roadmap, of another byte order or major version, cut off,
/// bytes appended, damaged, or a table of sections that contradicts the layout.
CheckedHeader read_header(const std::string& name, std::span<const std::byte> bytes);

}  // namespace warren
