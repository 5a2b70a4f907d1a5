// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/file/roadmap_file.hpp"

#include <algorithm>
#include <cstring>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "roadmaps/file/checksum.hpp"

namespace warren {
namespace {

constexpr std::size_t most_checked_whole = std::size_t{64} << 20;  // a few milliseconds

Execution without_progress(const Execution& execution) { return {execution.threads, execution.deadline}; }

}  // namespace

RoadmapFile::RoadmapFile(const std::string& path, const Execution& execution)
    : file_(path, execution), head_(read_header(file_.name(), bytes())), checked_(head_.blocks) {
  check_opened(execution);
}

RoadmapFile::RoadmapFile(const std::string& name, std::string_view bytes_in_memory, const Execution& execution)
    : file_(InputFile::of_bytes(name, bytes_in_memory)),
      head_(read_header(file_.name(), bytes())),
      checked_(head_.blocks) {
  check_opened(execution);
}

void RoadmapFile::check_opened(const Execution& execution) const {
  if (is_small()) {
    check_blocks({0, head_.blocks}, without_progress(execution));
    return;
  }
  for (const SectionPlace& place : head_.sections) {
    if (place.blocks() == 1) check_block(place.first_block);
  }
}

bool RoadmapFile::is_small() const { return bytes().size() <= most_checked_whole; }

FirstLook RoadmapFile::first_look(const SectionPlace& place) const {
  const auto look = [](const void* file, std::size_t block) {
    static_cast<const RoadmapFile*>(file)->check_block(block);
  };
  return {&checked_, place.first_block, checked_block, this, look};
}

const SectionPlace* RoadmapFile::find(std::string_view name) const {
  const auto found = std::find_if(head_.sections.begin(), head_.sections.end(),
                                  [name](const SectionPlace& place) { return place.name == name; });
  return found == head_.sections.end() ? nullptr : &*found;
}

void RoadmapFile::refuse_unknown(std::span<const std::string_view> known) const {
  for (const SectionPlace& place : head_.sections) {
    if (place.optional || std::find(known.begin(), known.end(), place.name) != known.end()) continue;
    throw InputError(name(),
                     "this program doesn't know section `" + place.name + "`, without which the others can't " +
                         "be read: use the program that wrote it",
                     head_.header.writer);
  }
}

const SectionPlace& RoadmapFile::required(std::string_view section, ElementType type) const {
  const SectionPlace* const place = find(section);
  const std::string quoted = "section `" + std::string{section} + "` ";
  if (place == nullptr) throw InputError(name(), quoted + "is missing");
  if (place->type != type) {
    throw InputError(name(), quoted + "must have elements of type " + std::string{type.name()}, place->type.name());
  }
  return *place;
}

void RoadmapFile::check_all(const Execution& execution) const {
  if (execution.progress != nullptr) execution.progress->begin("check", head_.blocks);
  check_blocks({0, head_.blocks}, execution);
}

/// The first damaged block is named whichever thread finds which.
void RoadmapFile::check_blocks(Range blocks, const Execution& execution) const {
  std::vector<std::uint8_t> damaged(blocks.size(), 0);
  for_chunks(blocks.size(), 1, execution, [&](Range r) {
    const std::size_t block = blocks.first + r.first;
    if (checked_.test(block)) return;
    if (is_sound(block)) {
      checked_.set(block);
    } else {
      damaged[r.first] = 1;
    }
  });
  const auto first = std::find(damaged.begin(), damaged.end(), 1);
  if (first != damaged.end()) refuse(blocks.first + static_cast<std::size_t>(first - damaged.begin()));
}

void RoadmapFile::check_block(std::size_t block) const {
  if (!is_sound(block)) refuse(block);
  checked_.set(block);
}

bool RoadmapFile::is_sound(std::size_t block) const {
  std::uint64_t wanted = 0;
  const std::size_t at = block_table(head_.sections.size()) + block * sizeof wanted;
  std::memcpy(&wanted, bytes().data() + at, sizeof wanted);
  return checksum(bytes_of(place_of(block), block)) == wanted;
}

/// The last section that begins at this block: empty ones have none and come before it.
const SectionPlace& RoadmapFile::place_of(std::size_t block) const {
  const auto behind = std::upper_bound(head_.sections.begin(), head_.sections.end(), block,
                                       [](std::size_t b, const SectionPlace& place) { return b < place.first_block; });
  return *(behind - 1);
}

std::span<const std::byte> RoadmapFile::bytes_of(const SectionPlace& place, std::size_t block) const {
  const std::size_t first = (block - place.first_block) * checked_block;
  return bytes().subspan(place.offset + first, std::min(checked_block, place.bytes() - first));
}

void RoadmapFile::refuse(std::size_t block) const {
  const SectionPlace& place = place_of(block);
  const std::span<const std::byte> found = bytes_of(place, block);
  const auto first = static_cast<std::size_t>(found.data() - bytes().data());
  throw InputError(name(), "section `" + place.name + "` is damaged within bytes " + std::to_string(first) + " to " +
                               std::to_string(first + found.size() - 1) +
                               ": their checksum is another one; make or copy the roadmap again");
}

}  // namespace warren
