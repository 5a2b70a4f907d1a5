// SPDX-License-Identifier: BSD-3-Clause
// Where everything stands in a .roadmap file, said once for whoever writes and whoever reads; docs/file_formats.md has
// it as a table of bytes.
//
//   FixedHeader | SectionEntry, one a section | checksum of each block, section by section | zeros | checksum of all
//   this section, zeros to the next multiple of 64 | section, zeros | ...
//
// The sections stand in the order of their entries and each begins where the one before it has ended, so that a file's
// content has one layout alone: nothing can overlap, and no byte is without a checksum or a rule. A section is checked
// in blocks of 1 MiB, the last one shorter; the checksums of blocks are covered by that of the header, so the header's
// is one of the whole file.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "roadmaps/file/element_type.hpp"

namespace warren {

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

/// Bytes of the whole header, its checksum included.
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

}  // namespace warren
