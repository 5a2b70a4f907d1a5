// SPDX-License-Identifier: BSD-3-Clause
// A .roadmap file, open for reading: named sections of plain numbers, mapped where the file is large, and never looked
// at before their checksums have been. What sections mean is nobody's business here.
//
// A file of up to 64 MiB is checked whole when it is opened. Of a larger one the header, the zeros between sections and
// the sections of up to 1 MiB are; each other block of 1 MiB is checked before it is first given out and never again: a
// bit a block says so. Whoever reads parts of a large section pays a load and a test for each of them.
// A mapped file must not change or become shorter while it is open (scenes/text/input_file_io.hpp).
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "parallel/once.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
// What the elements of a section are, in NumPy's words: '<' (little-endian; '|' for single bytes), a letter (u
// unsigned, i signed, f IEEE-754), the bytes of one. Four characters in a file, the last one zero.

/// Numbers that files hold as they are: fixed widths of at most 8 bytes.
template <class T>
concept FileElement = std::same_as<T, std::byte> ||
    (std::is_arithmetic_v<T> && !std::same_as<T, bool> && sizeof(T) <= 8);

struct ElementType {
  std::array<char, 4> code{};  ///< "<u4", say, and a zero

  constexpr std::string_view name() const { return {code.data(), 3}; }
  constexpr std::size_t bytes() const { return static_cast<std::size_t>(code[2] - '0'); }
  /// Also of types that a later minor version may bring: their size can be told.
  constexpr bool is_legal() const {
    const bool one = code[2] == '1';
    const bool some = one || code[2] == '2' || code[2] == '4' || code[2] == '8';
    return code[0] == (one ? '|' : '<') && code[1] >= 'a' && code[1] <= 'z' && some && code[3] == '\0';
  }
  friend constexpr bool operator==(const ElementType&, const ElementType&) = default;
};

/// char and std::byte are |u1.
template <FileElement T>
constexpr ElementType element_type() {
  constexpr bool is_text = std::same_as<T, char> || std::same_as<T, std::byte>;
  constexpr char letter = std::is_floating_point_v<T> ? 'f' : is_text || std::is_unsigned_v<T> ? 'u' : 'i';
  return {{sizeof(T) == 1 ? '|' : '<', letter, static_cast<char>('0' + sizeof(T)), '\0'}};
}

// Where everything stands in a .roadmap file, as docs/file_formats.md has it: FixedHeader, a SectionEntry a section, a
// checksum a block, zeros, the checksum of all this, the sections. Each begins where the one before it has ended, so
// that a file's content has one layout alone.

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");

/// The first byte is no ASCII and the last one ends a line: a transfer that takes the file for text breaks it at once.
inline constexpr std::string_view roadmap_magic = "\x89WRRMAP\n";
inline constexpr std::uint16_t roadmap_major = 1;
inline constexpr std::uint16_t roadmap_minor = 0;
inline constexpr std::uint32_t byte_order_mark = 0x01020304;
inline constexpr std::uint32_t optional_flag = 1;  ///< whoever doesn't know the section may leave it out
inline constexpr std::size_t most_sections = 64;
inline constexpr std::size_t section_alignment = 64;
inline constexpr std::size_t checked_block = std::size_t{1} << 20;

/// Bytes 0 .. 63. Magic, major version and writer keep their places in all versions to come.
struct FixedHeader {
  std::array<char, 8> magic;
  std::uint16_t major_version;
  std::uint16_t minor_version;
  std::uint32_t byte_order;
  std::uint64_t file_bytes;
  std::uint32_t sections;
  std::uint32_t header_bytes;
  std::uint64_t world_hash;
  std::uint64_t recipe_hash;
  std::array<char, 16> writer;
};
static_assert(sizeof(FixedHeader) == 64);

struct SectionEntry {
  std::array<char, 16> name;
  ElementType type;
  std::uint32_t flags;
  std::uint64_t offset;
  std::uint64_t elements;
  std::array<std::uint64_t, 3> reserved;
};
static_assert(sizeof(SectionEntry) == 64);

/// One section as it stands in a file.
struct SectionPlace {
  std::string name;
  ElementType type;
  bool optional = false;
  std::size_t offset = 0;  ///< of the file, a multiple of 64
  std::size_t elements = 0;
  std::size_t first_block = 0;  ///< number of its first block among those of all sections

  std::size_t bytes() const { return elements * type.bytes(); }
  std::size_t blocks() const { return (bytes() + checked_block - 1) / checked_block; }
};

constexpr std::size_t aligned(std::size_t bytes) {
  return (bytes + section_alignment - 1) / section_alignment * section_alignment;
}

constexpr std::size_t header_bytes(std::size_t sections, std::size_t blocks) {
  return aligned(sizeof(FixedHeader) + sections * sizeof(SectionEntry) + (blocks + 1) * sizeof(std::uint64_t));
}

/// Where the blocks' checksums begin.
constexpr std::size_t block_table(std::size_t sections) {
  return sizeof(FixedHeader) + sections * sizeof(SectionEntry);
}

/// Is it one to sixteen of a-z, 0-9, dot and underscore?
constexpr bool is_section_name(std::string_view name) {
  for (const char c : name) {
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_')) return false;
  }
  return !name.empty() && name.size() <= sizeof(SectionEntry::name);
}

/// The text in a field that zeros fill up. The rest of the field may be anything.
constexpr std::string_view text_of(std::span<const char> field) {
  const std::string_view all(field.data(), field.size());
  return all.substr(0, all.find('\0'));
}

/// What a .roadmap file says of itself, whatever is in it.
struct RoadmapFileHeader {
  std::uint64_t world_hash = 0;   ///< of the world that it was made for
  std::uint64_t recipe_hash = 0;  ///< of body, options and seed
  std::string writer;             ///< program and version: "warren 0.1.0"; at most 16 printable characters of ASCII
};

/// What is read of it once all of it was held against the bytes that there are: each section lies within the file.
struct CheckedHeader {
  RoadmapFileHeader header;
  std::vector<SectionPlace> sections;
  std::size_t blocks = 0;
};

/// Any number of threads may read. Neither copied nor moved, for views refer to it; everything given out ends with it.
class RoadmapFile : NotCopied {
 public:
  /// Throws ReadError, InputError (which names the file, and the section where it is one's fault), Stopped.
  RoadmapFile(const std::string& path, const Execution& execution)
      : RoadmapFile([&] { return InputFile(path, execution); }, execution) {}
  /// Bytes that are in memory already, under the name that messages shall give: a copy.
  static RoadmapFile of_bytes(const std::string& name, std::string_view bytes, const Execution& execution) {
    return {[&] { return InputFile::of_bytes(name, bytes); }, execution};
  }

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
    return {reinterpret_cast<const T*>(bytes().data() + place.offset), place.elements};
  }
  /// The same, or nothing where the section is missing.
  template <FileElement T>
  std::optional<std::span<const T>> optional_section(std::string_view name, const Execution& execution) const {
    return find(name) == nullptr ? std::nullopt : std::optional(section<T>(name, execution));
  }
  /// Of the section, with nothing of it checked: for who calls first_look(place).ensure() before it looks.
  std::span<const std::byte> unchecked_bytes(const SectionPlace& place) const {
    return bytes().subspan(place.offset, place.bytes());
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
  RoadmapFile(const std::function<InputFile()>& open, const Execution& execution);
  const SectionPlace& required(std::string_view name, ElementType type) const;
  void check_blocks(Range blocks, const Execution& execution) const;
  bool is_sound(std::size_t block) const;
  const SectionPlace& place_of(std::size_t block) const;
  std::span<const std::byte> bytes_of(const SectionPlace& place, std::size_t block) const;
  [[noreturn]] void refuse(std::size_t block) const;

  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(file_.bytes())); }

  InputFile file_;
  CheckedHeader head_;
  mutable LastingMarks checked_;  ///< a block's bytes are what its checksum says
};

// Writes a .roadmap file: named sections of plain numbers, whatever they mean, behind a header with their checksums.
// The same bytes for any number of threads, compiler and processor: no time, no padding that nobody has set. Two passes
// over the sections: one for the checksums, on all threads at memory speed, one to write them. Memory: the header.

/// Refers to numbers that live elsewhere.
struct RoadmapSection {
  std::string_view name;  ///< one to sixteen of a-z, 0-9, dot and underscore
  ElementType type;
  std::span<const std::byte> bytes;
  bool optional = false;  ///< readers that don't know it may leave it out
};

template <std::ranges::contiguous_range Numbers>
RoadmapSection roadmap_section(std::string_view name, const Numbers& numbers, bool optional = false) {
  return {name, element_type<std::ranges::range_value_t<Numbers>>(), std::as_bytes(std::span(numbers)), optional};
}

/// Into a file that the caller completes and puts in its place: at most 64 sections, each of another name. Throws
/// WriteError, Stopped as OutputFile does.
void write_roadmap_file(OutputFile& file, const RoadmapFileHeader& header, std::span<const RoadmapSection> sections,
                        const Execution& execution);

}  // namespace warren
