// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/stored_zip_io.hpp"

#include <zlib.h>

#include <cassert>

namespace warren {
namespace {

constexpr std::uint16_t plain_version = 20;
constexpr std::uint16_t zip64_version = 45;
constexpr std::uint16_t sum_follows = 8;  // flag: check sum and sizes stand behind the member
constexpr std::uint16_t stored = 0;
constexpr std::uint16_t midnight = 0;
constexpr std::uint16_t first_day = 0x21;  // 1980-01-01
constexpr std::uint16_t zip64_field = 1;
constexpr std::uint16_t nothing_16 = 0;
constexpr std::uint32_t nothing_32 = 0;
constexpr std::uint64_t nothing_64 = 0;
constexpr std::uint32_t said_in_zip64 = 0xffffffff;

/// The fields of a record, one after the other, each as wide as its type.
template <class... Fields>
void append_fields(std::string& text, Fields... fields) {
  (append_little_endian(text, fields), ...);
}

std::uint16_t size_16(std::string_view text) { return static_cast<std::uint16_t>(text.size()); }

}  // namespace

std::uint32_t StoredZip::short_form(std::uint64_t number) const {
  return is_long(number) ? said_in_zip64 : static_cast<std::uint32_t>(number);
}

void StoredZip::put(std::string_view bytes) {
  file_.write(bytes);
  place_ += bytes.size();
}

void StoredZip::begin(std::string_view name, std::uint64_t bytes) {
  members_.push_back({std::string{name}, bytes, place_});
  const bool zip64 = is_long(bytes);
  std::string extra;
  if (zip64) append_fields(extra, zip64_field, std::uint16_t{16}, nothing_64, nothing_64);
  const std::uint32_t size = zip64 ? said_in_zip64 : nothing_32;
  std::string head;
  append_fields(head, std::uint32_t{0x04034b50}, zip64 ? zip64_version : plain_version, sum_follows, stored, midnight,
                first_day, nothing_32, size, size, size_16(name), size_16(extra));
  put(head.append(name).append(extra));
}

void StoredZip::write(std::string_view bytes) {
  Member& member = members_.back();
  member.check_sum = static_cast<std::uint32_t>(
      ::crc32_z(member.check_sum, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  member.written += bytes.size();
  put(bytes);
}

void StoredZip::end() {
  const Member& member = members_.back();
  assert(member.written == member.bytes);
  std::string tail;
  append_fields(tail, std::uint32_t{0x08074b50}, member.check_sum);
  if (is_long(member.bytes)) {
    append_fields(tail, member.bytes, member.bytes);
  } else {
    append_fields(tail, static_cast<std::uint32_t>(member.bytes), static_cast<std::uint32_t>(member.bytes));
  }
  put(tail);
}

void StoredZip::append_entry(std::string& text, const Member& member) const {
  std::string extra;
  if (is_long(member.bytes)) append_fields(extra, member.bytes, member.bytes);
  if (is_long(member.place)) append_fields(extra, member.place);
  std::string field;
  if (!extra.empty()) append_fields(field, zip64_field, size_16(extra));
  field += extra;
  const std::uint16_t version = field.empty() ? plain_version : zip64_version;
  append_fields(text, std::uint32_t{0x02014b50}, version, version, sum_follows, stored, midnight, first_day,
                member.check_sum, short_form(member.bytes), short_form(member.bytes), size_16(member.name),
                size_16(field), nothing_16, nothing_16, nothing_16, nothing_32, short_form(member.place));
  text.append(member.name).append(field);
}

void StoredZip::append_end(std::string& text, std::uint64_t directory_bytes) const {
  const std::uint64_t count = members_.size();
  if (is_long(place_) || is_long(directory_bytes)) {
    append_fields(text, std::uint32_t{0x06064b50}, std::uint64_t{44}, zip64_version, zip64_version, nothing_32,
                  nothing_32, count, count, directory_bytes, place_);
    append_fields(text, std::uint32_t{0x07064b50}, nothing_32, place_ + directory_bytes, std::uint32_t{1});
  }
  const auto short_count = static_cast<std::uint16_t>(count);
  append_fields(text, std::uint32_t{0x06054b50}, nothing_16, nothing_16, short_count, short_count,
                short_form(directory_bytes), short_form(place_), nothing_16);
}

void StoredZip::close() {
  std::string directory;
  for (const Member& member : members_) append_entry(directory, member);
  append_end(directory, directory.size());
  put(directory);
}

}  // namespace warren
