// SPDX-License-Identifier: BSD-3-Clause
// Writes a .roadmap file: named sections of plain numbers, whatever they mean, behind a header with their checksums.
// The same bytes for any number of threads, compiler and processor: no time, no padding that nobody has set. Two passes
// over the sections: one for the checksums, on all threads at memory speed, one to write them. Memory: the header.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "roadmaps/file/element_type.hpp"
#include "roadmaps/file/roadmap_file_header.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {

/// Refers to numbers that live elsewhere.
struct RoadmapSection {
  std::string_view name;  ///< one to sixteen of a-z, 0-9, dot and underscore
  ElementType type;
  std::span<const std::byte> bytes;
  bool optional = false;  ///< readers that don't know it may leave it out
};

template <FileElement T>
RoadmapSection roadmap_section(std::string_view name, std::span<const T> elements, bool optional = false) {
  return {name, element_type<T>(), std::as_bytes(elements), optional};
}

/// Writes the file beside its place and renames it. Throws InputError for names that are wrong or stand twice, more
/// than 64 sections, a writer that doesn't fit; WriteError, Stopped as OutputFile does.
void write_roadmap_file(const std::string& path, const RoadmapFileHeader& header,
                        std::span<const RoadmapSection> sections, const Execution& execution);
/// The same into a file that the caller completes and puts in its place.
void write_roadmap_file(OutputFile& file, const std::string& path, const RoadmapFileHeader& header,
                        std::span<const RoadmapSection> sections, const Execution& execution);

}  // namespace warren
