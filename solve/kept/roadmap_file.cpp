// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_file.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/base/error.hpp"
#include "solve/kept/checksum.hpp"

namespace warren {
namespace {

bool all_zero(std::span<const std::byte> bytes) {
  return std::ranges::all_of(bytes, [](std::byte b) { return b == std::byte{0}; });
}

/// Reads the header of a .roadmap file and holds all of it against the bytes that there are: afterwards each section
/// lies within the file where the layout says, whoever made the file. Looks at nothing but the header and the zeros
/// between sections; takes memory for at most 64 sections.
class HeaderReader {
 public:
  HeaderReader(const std::string& name, std::span<const std::byte> bytes) : name_(name), bytes_(bytes) {}

  /// Throws InputError, which names the file as `name`: no roadmap, of another byte order or major version, cut off,
  /// bytes appended, damaged, or a table of sections that contradicts the layout.
  CheckedHeader read() {
    read_fixed();
    check_size();
    for (std::size_t i = 0; i < fixed_.sections; ++i)
      read_entry(at<SectionEntry>(sizeof fixed_ + i * sizeof(SectionEntry)));
    check_places();
    result_.header = {fixed_.world_hash, fixed_.recipe_hash, std::string{text_of(fixed_.writer)}};
    return std::move(result_);
  }

 private:
  static std::string number(std::uint64_t n) { return std::to_string(n); }
  [[noreturn]] void fail(std::string_view what, std::string_view found = {}) const {
    throw InputError(name_, what, found);
  }
  [[noreturn]] void fail_in(const SectionPlace& section, std::string_view what, std::string_view found) const {
    fail("section `" + section.name + "` " + std::string{what}, found);
  }
  template <class T>
  T at(std::size_t offset) const {
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }
  std::string_view text(std::size_t size) const {
    return {reinterpret_cast<const char*>(bytes_.data()), std::min(size, bytes_.size())};
  }
  [[noreturn]] void fail_cut_off(std::uint64_t expected) const {
    fail("the roadmap file is cut off: expected " + number(expected) + " bytes; make or copy it again",
         number(bytes_.size()) + " bytes");
  }

  void read_fixed() {
    if (!text(roadmap_magic.size()).starts_with(roadmap_magic)) {
      fail("expected a roadmap file, which begins with \\x89WRRMAP and a line feed", text(roadmap_magic.size()));
    }
    if (bytes_.size() < sizeof fixed_) fail_cut_off(sizeof fixed_);
    fixed_ = at<FixedHeader>(0);
    if (fixed_.byte_order == __builtin_bswap32(byte_order_mark)) {
      fail("this roadmap file is big-endian: expected little-endian numbers; make it again", writer());
    }
    if (fixed_.major_version != roadmap_major) {
      fail("this roadmap file has format version " + number(fixed_.major_version) + "." + number(fixed_.minor_version) +
               " and expected is " + number(roadmap_major) + ": read it with its writer or make it again",
           writer());
    }
  }
  std::string writer() const { return "written by `" + std::string{text_of(fixed_.writer)} + "`"; }

  /// The checksum comes before all that the header says, so that damage is called damage.
  void check_size() const {
    const std::size_t size = fixed_.header_bytes;
    if (size > bytes_.size()) fail_cut_off(std::max<std::uint64_t>(size, fixed_.file_bytes));
    const std::size_t end = size - sizeof(std::uint64_t);
    if (size < header_bytes(0, 0) || size % section_alignment != 0 ||
        checksum(bytes_.first(end)) != at<std::uint64_t>(end)) {
      fail("the header of this roadmap file is damaged: its checksum is another one; make or copy it again");
    }
    if (fixed_.byte_order != byte_order_mark) fail("the header has no mark of byte order", number(fixed_.byte_order));
    if (bytes_.size() < fixed_.file_bytes) fail_cut_off(fixed_.file_bytes);
    if (bytes_.size() > fixed_.file_bytes) {
      fail("bytes follow the end of this roadmap file: expected " + number(fixed_.file_bytes) + " bytes",
           number(bytes_.size()) + " bytes");
    }
    if (fixed_.sections > most_sections) fail("a roadmap file has at most 64 sections", number(fixed_.sections));
    if (block_table(fixed_.sections) > end) fail("the header has no room for its sections", number(fixed_.sections));
    check_text(fixed_.writer, "the writer");
  }
  void check_text(std::span<const char> field, const std::string& what) const {
    const std::size_t size = text_of(field).size();
    if (!all_zero(std::as_bytes(field).subspan(size))) fail(what + " must be followed by zeros alone");
  }

  void read_entry(const SectionEntry& entry) {
    SectionPlace s{std::string{text_of(entry.name)},
                   entry.type,
                   entry.flags == optional_flag,
                   entry.offset,
                   entry.elements,
                   result_.blocks};
    if (!is_section_name(s.name)) fail("a section's name must be 1 to 16 of a-z, 0-9, dot and underscore", s.name);
    check_text(entry.name, "the name of section `" + s.name + "`");
    if (std::ranges::count(result_.sections, s.name, &SectionPlace::name) > 0) fail_in(s, "stands twice", {});
    if (!s.type.is_legal()) fail_in(s, "must have elements of a type like <u4 or <f8", text_of(entry.type.code));
    if (entry.flags > optional_flag) fail_in(s, "has flags that are not known", number(entry.flags));
    if (!all_zero(std::as_bytes(std::span(entry.reserved)))) fail_in(s, "must have zeros in its reserved bytes", {});
    if (s.elements > bytes_.size() / s.type.bytes()) {
      fail_in(s, "has more elements than a file of " + number(bytes_.size()) + " bytes can hold", number(s.elements));
    }
    result_.blocks += s.blocks();
    result_.sections.push_back(std::move(s));
  }

  void check_places() const {
    const std::size_t head = header_bytes(fixed_.sections, result_.blocks);
    if (head != fixed_.header_bytes) {
      fail("the header must have " + number(head) + " bytes for its sections", number(fixed_.header_bytes));
    }
    std::size_t used = block_table(fixed_.sections) + result_.blocks * sizeof(std::uint64_t);
    check_zeros(used, head - sizeof(std::uint64_t), "the header");
    std::size_t end = head;
    for (const SectionPlace& s : result_.sections) {
      if (s.offset != end)
        fail_in(s, "must begin at byte " + number(end) + ", after what is before it", number(s.offset));
      used = end + s.bytes();
      end = aligned(used);
      if (end > bytes_.size())
        fail_in(s, "ends beyond the file, at byte " + number(used), number(bytes_.size()) + " bytes");
      check_zeros(used, end, "section `" + s.name + "`");
    }
    if (end != bytes_.size()) fail("the sections end at byte " + number(end), number(bytes_.size()) + " bytes");
  }
  void check_zeros(std::size_t first, std::size_t last, const std::string& what) const {
    if (!all_zero(bytes_.subspan(first, last - first))) {
      fail("the bytes behind " + what + " must be zeros, bytes " + number(first) + " to " + number(last - 1));
    }
  }

  const std::string& name_;
  std::span<const std::byte> bytes_;
  FixedHeader fixed_{};
  CheckedHeader result_;
};

constexpr std::size_t most_checked_whole = std::size_t{64} << 20;  // a few milliseconds

constexpr std::array<char, section_alignment> zeros{};

std::vector<std::uint64_t> checksums_of(std::span<const RoadmapSection> sections, const Execution& execution) {
  std::vector<std::span<const std::byte>> blocks;
  for (const RoadmapSection& s : sections) {
    for (std::size_t at = 0; at < s.bytes.size(); at += checked_block) {
      blocks.push_back(s.bytes.subspan(at, std::min(checked_block, s.bytes.size() - at)));
    }
  }
  return parts_of_chunks(blocks.size(), 1, execution.quiet(), [&](Range r) { return checksum(blocks[r.first]); });
}

template <class T>
void put(std::string& bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// sums: of the blocks of all sections.
std::string header_of(const RoadmapFileHeader& header, std::span<const RoadmapSection> sections,
                      std::span<const std::uint64_t> sums) {
  assert(sections.size() <= most_sections);
  std::string bytes(header_bytes(sections.size(), sums.size()), '\0');
  std::size_t end = bytes.size();  // of what is before the next section
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const RoadmapSection& s = sections[i];
    assert(is_section_name(s.name) && s.type.is_legal() && s.bytes.size() % s.type.bytes() == 0);
    SectionEntry entry{};
    s.name.copy(entry.name.data(), entry.name.size());
    entry.type = s.type;
    entry.flags = s.optional ? optional_flag : 0;
    entry.offset = end;
    entry.elements = s.bytes.size() / s.type.bytes();
    put(bytes, sizeof(FixedHeader) + i * sizeof entry, entry);
    end = aligned(end + s.bytes.size());
  }
  FixedHeader fixed{};
  roadmap_magic.copy(fixed.magic.data(), fixed.magic.size());
  fixed.major_version = roadmap_major;
  fixed.minor_version = roadmap_minor;
  fixed.byte_order = byte_order_mark;
  fixed.file_bytes = end;
  fixed.sections = static_cast<std::uint32_t>(sections.size());
  fixed.header_bytes = static_cast<std::uint32_t>(bytes.size());
  fixed.world_hash = header.world_hash;
  fixed.recipe_hash = header.recipe_hash;
  header.writer.copy(fixed.writer.data(), fixed.writer.size());
  put(bytes, 0, fixed);
  for (std::size_t i = 0; i < sums.size(); ++i) put(bytes, block_table(sections.size()) + i * sizeof sums[i], sums[i]);
  const std::size_t summed = bytes.size() - sizeof(std::uint64_t);
  put(bytes, summed, checksum(std::as_bytes(std::span(bytes)).first(summed)));
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

RoadmapFile::RoadmapFile(const std::function<InputFile()>& open, const Execution& execution)
    : file_(open()), head_(HeaderReader(file_.name(), bytes()).read()), checked_(head_.blocks) {
  for (const SectionPlace& place : head_.sections) {
    if (is_small() || place.blocks() == 1) check_section(place, execution.quiet());
  }
}

bool RoadmapFile::is_small() const { return bytes().size() <= most_checked_whole; }

FirstLook RoadmapFile::first_look(const SectionPlace& place) const {
  const auto look = [](const void* file, std::size_t block) {
    static_cast<const RoadmapFile*>(file)->check_blocks({block, block + 1}, {});
  };
  return {&checked_, place.first_block, checked_block, this, look};
}

const SectionPlace* RoadmapFile::find(std::string_view name) const {
  const auto found = std::ranges::find(head_.sections, name, &SectionPlace::name);
  return found == head_.sections.end() ? nullptr : &*found;
}

void RoadmapFile::refuse_unknown(std::span<const std::string_view> known) const {
  for (const SectionPlace& place : head_.sections) {
    if (place.optional || std::ranges::find(known, place.name) != known.end()) continue;
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
  const std::size_t first = first_that(blocks.size(), 1, execution, [&](std::size_t i) {
    const std::size_t block = blocks.first + i;
    if (checked_.test(block)) return false;
    if (!is_sound(block)) return true;
    checked_.set(block);
    return false;
  });
  if (first < blocks.size()) refuse(blocks.first + first);
}

bool RoadmapFile::is_sound(std::size_t block) const {
  std::uint64_t wanted = 0;
  const std::size_t at = block_table(head_.sections.size()) + block * sizeof wanted;
  std::memcpy(&wanted, bytes().data() + at, sizeof wanted);
  return checksum(bytes_of(place_of(block), block)) == wanted;
}

/// The last section that begins at this block: empty ones have none and come before it.
const SectionPlace& RoadmapFile::place_of(std::size_t block) const {
  return *(std::ranges::upper_bound(head_.sections, block, {}, &SectionPlace::first_block) - 1);
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

void write_roadmap_file(OutputFile& file, const RoadmapFileHeader& header, std::span<const RoadmapSection> sections,
                        const Execution& execution) {
  const std::string head = header_of(header, sections, checksums_of(sections, execution));
  std::size_t bytes = head.size();
  for (const RoadmapSection& section : sections) bytes += section.bytes.size();
  if (execution.progress != nullptr) execution.progress->begin("write", bytes);
  file.write(head);
  execution.advance(head.size());
  for (const RoadmapSection& section : sections) write_section(file, section.bytes, execution);
}

}  // namespace warren
