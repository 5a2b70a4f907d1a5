// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/file/write_roadmap_file.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "roadmaps/file/checksum.hpp"
#include "roadmaps/file/file_layout.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

constexpr std::array<char, section_alignment> zeros{};

void check_writable(const std::string& path, const RoadmapFileHeader& header,
                    std::span<const RoadmapSection> sections) {
  const auto is_printable = [](char c) { return c >= ' ' && c <= '~'; };
  if (header.writer.size() > sizeof(FixedHeader::writer) ||
      !std::all_of(header.writer.begin(), header.writer.end(), is_printable)) {
    throw InputError(path, "the writer must be at most 16 printable characters", header.writer);
  }
  if (sections.size() > most_sections) {
    throw InputError(path, "a roadmap file has at most 64 sections", std::to_string(sections.size()));
  }
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::string_view name = sections[i].name;
    if (!is_section_name(name)) {
      throw InputError(path, "a section's name must be 1 to 16 of a-z, 0-9, dot and underscore", name);
    }
    const auto before = sections.first(i);
    if (std::any_of(before.begin(), before.end(), [&](const RoadmapSection& s) { return s.name == name; })) {
      throw InputError(path, "a section's name may stand once", name);
    }
    assert(sections[i].type.is_legal() && sections[i].bytes.size() % sections[i].type.bytes() == 0);
  }
}

std::vector<SectionPlace> places_of(std::span<const RoadmapSection> sections) {
  std::vector<SectionPlace> places;
  std::size_t blocks = 0;
  for (const RoadmapSection& s : sections) {
    places.push_back({std::string{s.name}, s.type, s.optional, 0, s.bytes.size() / s.type.bytes(), blocks});
    blocks += places.back().blocks();
  }
  std::size_t offset = header_bytes(sections.size(), blocks);
  for (SectionPlace& place : places) {
    place.offset = offset;
    offset = aligned(offset + place.bytes());
  }
  return places;
}

std::vector<std::uint64_t> checksums_of(std::span<const RoadmapSection> sections, const Execution& execution) {
  std::vector<std::span<const std::byte>> blocks;
  for (const RoadmapSection& s : sections) {
    for (std::size_t at = 0; at < s.bytes.size(); at += checked_block) {
      blocks.push_back(s.bytes.subspan(at, std::min(checked_block, s.bytes.size() - at)));
    }
  }
  std::vector<std::uint64_t> sums(blocks.size());
  const Execution quiet{execution.threads, execution.deadline};
  for_chunks(blocks.size(), 1, quiet, [&](Range r) { sums[r.first] = checksum(blocks[r.first]); });
  return sums;
}

template <class T>
void put(std::string& bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

SectionEntry entry_of(const SectionPlace& place) {
  SectionEntry entry{};
  place.name.copy(entry.name.data(), entry.name.size());
  entry.type = place.type;
  entry.flags = place.optional ? optional_flag : 0;
  entry.offset = place.offset;
  entry.elements = place.elements;
  return entry;
}

std::string header_of(const RoadmapFileHeader& header, std::span<const SectionPlace> places,
                      std::span<const std::uint64_t> sums) {
  std::string bytes(header_bytes(places.size(), sums.size()), '\0');
  FixedHeader fixed{};
  roadmap_magic.copy(fixed.magic.data(), fixed.magic.size());
  fixed.major_version = roadmap_major;
  fixed.minor_version = roadmap_minor;
  fixed.byte_order = byte_order_mark;
  fixed.file_bytes = places.empty() ? bytes.size() : aligned(places.back().offset + places.back().bytes());
  fixed.sections = static_cast<std::uint32_t>(places.size());
  fixed.header_bytes = static_cast<std::uint32_t>(bytes.size());
  fixed.world_hash = header.world_hash;
  fixed.recipe_hash = header.recipe_hash;
  header.writer.copy(fixed.writer.data(), fixed.writer.size());
  put(bytes, 0, fixed);
  for (std::size_t i = 0; i < places.size(); ++i) {
    put(bytes, sizeof fixed + i * sizeof(SectionEntry), entry_of(places[i]));
  }
  for (std::size_t i = 0; i < sums.size(); ++i) put(bytes, block_table(places.size()) + i * sizeof sums[i], sums[i]);
  const std::size_t end = bytes.size() - sizeof(std::uint64_t);
  put(bytes, end, checksum(std::as_bytes(std::span(bytes)).first(end)));
  return bytes;
}

void write_section(OutputFile& file, std::span<const std::byte> bytes, const Execution& execution) {
  constexpr std::size_t piece = std::size_t{4} << 20;
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (; !rest.empty(); rest.remove_prefix(std::min(piece, rest.size()))) {
    const std::string_view some = rest.substr(0, piece);
    file.write(some);
    execution.advance(some.size());
  }
  file.write({zeros.data(), aligned(bytes.size()) - bytes.size()});
}

}  // namespace

void write_roadmap_file(const std::string& path, const RoadmapFileHeader& header,
                        std::span<const RoadmapSection> sections, const Execution& execution) {
  check_writable(path, header, sections);
  OutputFile file(path, execution);  // first: a place that can't be written is known before the work
  write_roadmap_file(file, path, header, sections, execution);
  file.commit();
}

void write_roadmap_file(OutputFile& file, const std::string& path, const RoadmapFileHeader& header,
                        std::span<const RoadmapSection> sections, const Execution& execution) {
  check_writable(path, header, sections);
  const std::vector<SectionPlace> places = places_of(sections);
  const std::string head = header_of(header, places, checksums_of(sections, execution));
  std::size_t bytes = head.size();
  for (const SectionPlace& place : places) bytes += place.bytes();
  if (execution.progress != nullptr) execution.progress->begin("write", bytes);
  file.write(head);
  execution.advance(head.size());
  for (const RoadmapSection& section : sections) write_section(file, section.bytes, execution);
}

}  // namespace warren
