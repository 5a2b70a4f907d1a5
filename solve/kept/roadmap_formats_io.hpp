// SPDX-License-Identifier: BSD-3-Clause
// What the formats of exported roadmaps are written by: whole numbers for real ones, zip archives.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/text/output_file_io.hpp"

namespace warren {

/// Edges of a roadmap, by their ends, in a piece of an export: less than a megabyte of text.
inline constexpr std::size_t edge_ends_a_block = 4096;

/// Real numbers as whole ones, for formats that have no others: multiples of a power of two, the finest that lets the
/// largest number stay below 2^31, which is what most readers' integers hold. A power of two, because scaling by it is
/// exact: the only error is that of rounding, at most half a unit.
class BinaryUnit {
 public:
  /// For numbers of magnitude 0 .. `largest`, which is finite. Without any but 0 the unit is 1.
  explicit BinaryUnit(double largest) {
    if (largest == 0) return;
    bits_ = 30 - std::ilogb(largest);
    if (multiple(largest) > std::numeric_limits<std::int32_t>::max()) --bits_;  // rounded up to 2^31
  }

  /// The nearest multiple, halves away from zero.
  std::int64_t multiple(double number) const { return std::llround(std::ldexp(number, bits_)); }
  /// "2^-20"
  std::string name() const { return "2^" + std::to_string(-bits_); }

 private:
  int bits_ = 0;  ///< the unit is 2^-bits_
};

/// A zip archive whose members are stored as they are, written in one pass: the check sum of a member follows it, its
/// size is said before. Members and archives of 4 GiB and more are ZIP64. Times are 1980-01-01, so that the same
/// members are the same bytes. PKWARE's APPNOTE.TXT 6.3. Writes to a file that outlives it, and does not commit that.
class StoredZip {
 public:
  /// What the plain format can't say, from this size or place on, is said in ZIP64; tests choose a smaller one.
  explicit StoredZip(OutputFile& file, std::uint64_t zip64_from = 0xffffffff) : file_(file), zip64_from_(zip64_from) {}

  /// A member of that many bytes follows, in calls of write().
  void begin(std::string_view name, std::uint64_t bytes);
  void write(std::string_view bytes);
  void end();
  /// The directory of all members. Nothing may follow.
  void close();

 private:
  struct Member {
    std::string name;
    std::uint64_t bytes;
    std::uint64_t place;
    std::uint32_t check_sum = 0;
    std::uint64_t written = 0;
  };
  static constexpr std::uint32_t said_in_zip64 = 0xffffffff;
  bool is_long(std::uint64_t number) const { return number >= zip64_from_; }
  std::uint32_t short_form(std::uint64_t number) const {
    return is_long(number) ? said_in_zip64 : static_cast<std::uint32_t>(number);
  }
  void append_entry(std::string& text, const Member& member) const;
  void put(std::string_view bytes);

  OutputFile& file_;
  std::uint64_t zip64_from_;
  std::uint64_t place_ = 0;
  std::vector<Member> members_;
};

}  // namespace warren
