// SPDX-License-Identifier: BSD-3-Clause
// Makes all checksums of a .roadmap file right again, as whoever forges one would: whatever its header says.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

#include "solve/kept/checksum.hpp"
#include "solve/kept/roadmap_file.hpp"

namespace warren::test {

template <class T>
T read_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

template <class T>
void write_at(std::string& bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

inline std::uint64_t checksum_of(const std::string& bytes, std::size_t at, std::size_t size) {
  return checksum(std::as_bytes(std::span(bytes)).subspan(at, size));
}

/// Blocks of all sections that lie within the file, then the header; leaves out what has no place.
inline void mend_checksums(std::string& bytes) {
  if (bytes.size() < header_bytes(0, 0)) return;
  const auto fixed = read_at<FixedHeader>(bytes, 0);
  if (fixed.header_bytes > bytes.size() || fixed.header_bytes < header_bytes(0, 0)) return;
  const std::size_t end = fixed.header_bytes - sizeof(std::uint64_t);
  const std::size_t sections = std::min<std::size_t>(fixed.sections, most_sections);
  std::size_t next = block_table(sections);
  for (std::size_t i = 0; i < sections && next <= end; ++i) {
    const auto entry = read_at<SectionEntry>(bytes, sizeof fixed + i * sizeof(SectionEntry));
    if (!entry.type.is_legal() || entry.elements > bytes.size() || entry.offset > bytes.size()) break;
    const std::size_t size = entry.elements * entry.type.bytes();
    if (size > bytes.size() - entry.offset) break;
    for (std::size_t at = 0; at < size && next + sizeof(std::uint64_t) <= end; at += checked_block) {
      write_at(bytes, next, checksum_of(bytes, entry.offset + at, std::min(checked_block, size - at)));
      next += sizeof(std::uint64_t);
    }
  }
  write_at(bytes, end, checksum_of(bytes, 0, end));
}

}  // namespace warren::test
