// SPDX-License-Identifier: BSD-3-Clause
// A zip archive whose members are stored as they are, written in one pass: the check sum of a member follows it, its
// size is said before. Members and archives of 4 GiB and more are ZIP64. Times are 1980-01-01, so that the same members
// are the same bytes. PKWARE's APPNOTE.TXT 6.3.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scenes/text/output_file_io.hpp"

namespace warren {

/// Writes to a file that outlives it, and does not commit that.
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
  bool is_long(std::uint64_t number) const { return number >= zip64_from_; }
  std::uint32_t short_form(std::uint64_t number) const;
  void append_entry(std::string& text, const Member& member) const;
  void append_end(std::string& text, std::uint64_t directory_bytes) const;
  void put(std::string_view bytes);

  OutputFile& file_;
  std::uint64_t zip64_from_;
  std::uint64_t place_ = 0;
  std::vector<Member> members_;
};

// Numbers as bytes of a file, the least significant first.

template <class Number>
void append_little_endian(std::string& bytes, Number number) {
  static_assert(std::is_arithmetic_v<Number>);
  static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

}  // namespace warren
