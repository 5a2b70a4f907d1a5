// SPDX-License-Identifier: BSD-3-Clause
// A .roadmap file, open for reading: named sections of plain numbers, mapped where the file is large, and never looked
// at before their checksums have been. What sections mean is nobody's business here.
//
// A file of up to 64 MiB is checked whole when it is opened. Of a larger one the header, the zeros between sections and
// the sections of up to 1 MiB are; each other block of 1 MiB is checked before it is first given out and never again: a
// bit a block says so. Whoever reads parts of a large section pays a load and a test for each of them.
// A mapped file must not change or become shorter while it is open (scenes/text/input_file_io.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "parallel/chunks.hpp"
#include "parallel/execution.hpp"
#include "parallel/first_look.hpp"
#include "parallel/lasting_marks.hpp"
#include "roadmaps/file/file_layout.hpp"
#include "roadmaps/file/roadmap_file_header.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

// Reads the header of a .roadmap file and holds all of it against the bytes that there are: afterwards each section
// lies within the file where the layout says, whoever made the file. Looks at nothing but the header and the zeros
// between sections; takes memory for at most 64 sections.

struct CheckedHeader {
  RoadmapFileHeader header;
  std::vector<SectionPlace> sections;
  std::size_t blocks = 0;
};

/// Throws InputError, which names the file as `name`: no roadmap, of another byte order or major version, cut off,
/// bytes appended, damaged, or a table of sections that contradicts the layout.
CheckedHeader read_header(const std::string& name, std::span<const std::byte> bytes);

/// Any number of threads may read. Neither copied nor moved, for views refer to it; everything given out ends with it.
class RoadmapFile {
 public:
  /// Throws ReadError, InputError (which names the file, and the section where it is one's fault), Stopped.
  RoadmapFile(const std::string& path, const Execution& execution);
  /// Bytes that are in memory already, under the name that messages shall give: a copy.
  static RoadmapFile of_bytes(const std::string& name, std::string_view bytes, const Execution& execution) {
    return {name, bytes, execution};
  }
  RoadmapFile(const RoadmapFile&) = delete;
  RoadmapFile& operator=(const RoadmapFile&) = delete;

  const std::string& name() const { return file_.name(); }
  const RoadmapFileHeader& header() const { return head_.header; }
  std::span<const SectionPlace> sections() const { return head_.sections; }
  /// nullptr where there is no such section.
  const SectionPlace* find(std::string_view name) const;
  /// Throws InputError for a section that is not `known` and not optional: it would change what the others mean.
  void refuse_unknown(std::span<const std::string_view> known) const;

  /// A whole section, checked on all threads where it was not yet. Throws InputError where it is missing, of another
  /// type or damaged; Stopped.
  template <FileElement T>
  std::span<const T> section(std::string_view name, const Execution& execution) const {
    const SectionPlace& place = required(name, element_type<T>());
    check_section(place, execution);
    return unchecked<T>(place);
  }
  /// The same, or nothing where the section is missing.
  template <FileElement T>
  std::optional<std::span<const T>> optional_section(std::string_view name, const Execution& execution) const {
    return find(name) == nullptr ? std::nullopt : std::optional(section<T>(name, execution));
  }
  /// The section with nothing of it checked: for who calls first_look(place).ensure() before it looks. Throws
  /// InputError where it is missing or of another type.
  template <FileElement T>
  std::span<const T> unchecked_section(std::string_view name) const {
    return unchecked<T>(required(name, element_type<T>()));
  }

  /// Checks what of a section was not checked yet, on all threads. Throws InputError, Stopped.
  void check_section(const SectionPlace& place, const Execution& execution) const {
    check_blocks({place.first_block, place.first_block + place.blocks()}, execution);
  }
  /// Checks the blocks that hold the bytes which somebody looks at, unless they were checked before.
  FirstLook first_look(const SectionPlace& place) const;
  /// Was all of it checked when it was opened?
  bool is_small() const;
  /// Checks all that was not checked yet. Throws InputError for the first damaged block; Stopped.
  void check_all(const Execution& execution) const;

 private:
  RoadmapFile(const std::string& name, std::string_view bytes, const Execution& execution);
  void check_opened(const Execution& execution) const;
  const SectionPlace& required(std::string_view name, ElementType type) const;
  void check_blocks(Range blocks, const Execution& execution) const;
  void check_block(std::size_t block) const;
  bool is_sound(std::size_t block) const;
  const SectionPlace& place_of(std::size_t block) const;
  std::span<const std::byte> bytes_of(const SectionPlace& place, std::size_t block) const;
  [[noreturn]] void refuse(std::size_t block) const;

  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(file_.bytes())); }
  template <class T>
  std::span<const T> unchecked(const SectionPlace& place) const {
    return {reinterpret_cast<const T*>(bytes().data() + place.offset), place.elements};
  }

  InputFile file_;
  CheckedHeader head_;
  mutable LastingMarks checked_;  ///< a block's bytes are what its checksum says
};

}  // namespace warren
