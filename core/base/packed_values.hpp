// SPDX-License-Identifier: BSD-3-Clause
// Plain values as bytes, for files and for other processes of the same program: numbers and plain structs as they lie
// in memory, lists behind their number of elements. Little-endian machines alone.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/types.hpp"

namespace warren {

static_assert(std::endian::native == std::endian::little, "values are packed as they lie in memory");

using Bytes = std::vector<std::byte>;

class ValuePacker {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    append(&value, sizeof value);
  }
  template <class T>
  void add_list(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(std::uint64_t{values.size()});
    append(values.data(), values.size_bytes());
  }
  template <class T, class A>
  void add_list(const std::vector<T, A>& values) {
    add_list(std::span<const T>(values));
  }
  void add_text(std::string_view text) { add_list(std::span<const char>(text)); }

  std::span<const std::byte> bytes() const { return bytes_; }
  Bytes take() { return std::move(bytes_); }

 private:
  void append(const void* from, std::size_t size) {
    if (size == 0) return;
    const std::size_t before = bytes_.size();
    bytes_.resize(before + size);
    std::memcpy(bytes_.data() + before, from, size);
  }

  Bytes bytes_;
};

/// Takes values in the order in which they were added. Throws InputError, naming `where`, at the bytes' end.
class ValueUnpacker {
 public:
  ValueUnpacker(std::span<const std::byte> bytes, std::string_view where) : left_(bytes), where_(where) {}

  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, next(sizeof value), sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> take_list() {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto count = take<std::uint64_t>();
    if (count > left_.size() / sizeof(T)) refuse();
    std::vector<T> values(static_cast<std::size_t>(count));
    if (count > 0) std::memcpy(values.data(), next(values.size() * sizeof(T)), values.size() * sizeof(T));
    return values;
  }
  std::string take_text() {
    const std::vector<char> text = take_list<char>();
    return {text.begin(), text.end()};
  }
  bool is_done() const { return left_.empty(); }
  [[noreturn]] void refuse() const { throw InputError(where_, "contradicts itself"); }

 private:
  const std::byte* next(std::size_t size) {
    if (size > left_.size()) refuse();
    const std::byte* const at = left_.data();
    left_ = left_.subspan(size);
    return at;
  }

  std::span<const std::byte> left_;
  std::string where_;
};

enum class PartKind : std::uint32_t { maze_group = 1, tiles = 2 };

/// Where finished parts of a long work are kept, so that a later run of the same work goes on from them. Any number of
/// threads may call find() and keep() at once.
class KeptParts : NotCopied {
 public:
  virtual ~KeptParts() = default;
  /// Before all else: what the work is, word for word all that its parts depend on. Throws InputError where parts of
  /// another work are kept.
  virtual void begin(std::string_view work) = 0;
  /// The bytes of a part, if an earlier run has kept it. Throws InputError where they are damaged.
  virtual std::optional<Bytes> find(PartKind kind, std::uint64_t number) = 0;
  /// Of a part that was not found.
  virtual void keep(PartKind kind, std::uint64_t number, std::span<const std::byte> bytes) = 0;
};

}  // namespace warren
