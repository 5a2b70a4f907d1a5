// SPDX-License-Identifier: BSD-3-Clause
// One bit a cell, rows of 64-bit words: plain data that worlds and planners share. Bits beyond the width are 0, so that
// words can be compared, counted and scanned whole. What a set bit means is said by who holds the bitmap.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/raw_vector.hpp"
#include "core/base/whole.hpp"

namespace warren {

/// Number of a column and a row; row 0 is the bottom row where a map is meant.
struct Cell {
  std::uint32_t x = 0;  ///< column, from the left
  std::uint32_t y = 0;  ///< row
  friend constexpr bool operator==(Cell, Cell) = default;
};

/// width x height bits; x runs along a row. Owns its words; any number of threads may read, and write different rows.
class Bitmap {
 public:
  static constexpr std::uint32_t word_bits = 64;  ///< of each word of a row

  Bitmap() = default;
  /// All bits `value`, with calls of poll() on the way: the first touch of gigabytes takes seconds. Fewer than 2^32
  /// bits in all.
  template <class Poll = NoPoll>
  Bitmap(std::uint32_t width, std::uint32_t height, bool value = false, const Poll& poll = {})
      : width_(width), height_(height), stride_(words_a_row(width)) {
    assign_polled(words_, stride_ * height, value ? ~std::uint64_t{0} : 0, poll);
    if (value) clear_beyond_width();
  }
  /// What a bitmap of this size takes: rows are whole words.
  static std::size_t bytes_for(std::uint32_t width, std::uint32_t height) {
    return words_a_row(width) * height * sizeof(std::uint64_t);
  }

  std::uint32_t width() const { return width_; }                               ///< bits a row
  std::uint32_t height() const { return height_; }                             ///< rows
  bool empty() const { return words_.empty(); }                                ///< has it no bits at all?
  std::uint64_t size() const { return std::uint64_t{width_} * height_; }       ///< all bits
  std::size_t bytes() const { return words_.size() * sizeof(std::uint64_t); }  ///< of the words

  /// Is the bit set? x < width(), y < height().
  bool test(std::uint32_t x, std::uint32_t y) const {
    return (words_[y * stride_ + x / word_bits] >> (x % word_bits) & 1U) != 0;
  }
  /// Sets the bit; x < width(), y < height(). Not at once with others who write its row.
  void set(std::uint32_t x, std::uint32_t y) { words_[y * stride_ + x / word_bits] |= bit(x); }
  /// Clears the bit; as set().
  void clear(std::uint32_t x, std::uint32_t y) { words_[y * stride_ + x / word_bits] &= ~bit(x); }
  /// Sets bits first .. last - 1 of a row; first <= last <= width.
  void set_run(std::uint32_t y, std::uint32_t first, std::uint32_t last) {
    const std::span<std::uint64_t> words = row(y);
    while (first < last) {
      const std::uint32_t word = first / word_bits;
      const std::uint32_t end = last < (word + 1) * word_bits ? last : (word + 1) * word_bits;
      const std::uint32_t count = end - first;
      const std::uint64_t ones = count == word_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
      words[word] |= ones << (first % word_bits);
      first = end;
    }
  }
  /// Sets what is set in the other one, of this size or empty, with calls of poll() on the way.
  template <class Poll = NoPoll>
  void add(const Bitmap& other, const Poll& poll = {}) {
    assert(other.height_ == 0 || (width_ == other.width_ && height_ == other.height_));
    for (std::uint32_t y = 0; y < other.height_; ++y, poll()) {
      for (std::size_t w = y * stride_; w < (y + 1) * stride_; ++w) words_[w] |= other.words_[w];
    }
  }
  /// Clears what is set in the other one; as add(), and this one may be empty, too.
  template <class Poll = NoPoll>
  void remove(const Bitmap& other, const Poll& poll = {}) {
    assert(other.height_ == 0 || words_.empty() || (width_ == other.width_ && height_ == other.height_));
    for (std::uint32_t y = 0; y < other.height_; ++y, poll()) {
      for (std::size_t w = y * stride_; w < (y + 1) * stride_; ++w) words_[w] &= ~other.words_[w];
    }
  }
  /// Is the cell inside the bitmap and set? Any coordinates.
  bool holds(std::int64_t x, std::int64_t y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ &&
           test(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  }

  /// The words of a row, bit x in word x / word_bits; what lies beyond the width stays 0.
  std::span<std::uint64_t> row(std::uint32_t y) { return std::span(words_).subspan(y * stride_, stride_); }
  /// The same, to be read.
  std::span<const std::uint64_t> row(std::uint32_t y) const { return std::span(words_).subspan(y * stride_, stride_); }
  /// What lies beyond the width is 0 again, where somebody has written to whole words.
  void clear_beyond_width() {
    if (width_ % word_bits == 0) return;
    for (std::uint32_t y = 0; y < height_; ++y) row(y).back() &= bit(width_) - 1;
  }
  /// All rows, one after the other.
  std::span<const std::uint64_t> words() const { return words_; }

  /// Calls visit(x) for the set bits of a row, ascending.
  template <class Visit>
  void for_each_in_row(std::uint32_t y, const Visit& visit) const {
    const std::span<const std::uint64_t> words = row(y);
    for (std::uint32_t w = 0; w < words.size(); ++w) {
      for (std::uint64_t rest = words[w]; rest != 0; rest &= rest - 1) {
        visit(word_bits * w + as_whole<std::uint32_t>(std::countr_zero(rest)));
      }
    }
  }
  /// How many bits are set.
  std::uint64_t count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : words_) sum += static_cast<std::uint64_t>(std::popcount(word));
    return sum;
  }
  friend bool operator==(const Bitmap&, const Bitmap&) = default;

 private:
  static constexpr std::size_t words_a_row(std::uint32_t width) {
    return (std::size_t{width} + word_bits - 1) / word_bits;
  }
  static constexpr std::uint64_t bit(std::uint32_t x) { return std::uint64_t{1} << (x % word_bits); }

  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::size_t stride_ = 0;  // words a row
  RawVector<std::uint64_t> words_;
};

/// Calls visit(cell) where the bitmaps, of one size, differ, by rows, and poll() before each row; an empty one has no
/// bits.
template <class Poll, class Visit>
void for_each_differing(const Bitmap& a, const Bitmap& b, const Poll& poll, const Visit& visit) {
  const Bitmap& sized = a.empty() ? b : a;
  for (std::uint32_t y = 0; y < sized.height(); ++y) {
    poll();
    for (std::size_t w = 0; w < sized.row(y).size(); ++w) {
      const std::uint64_t in_a = a.empty() ? 0 : a.row(y)[w];
      const std::uint64_t in_b = b.empty() ? 0 : b.row(y)[w];
      for (std::uint64_t rest = in_a ^ in_b; rest != 0; rest &= rest - 1) {
        visit(Cell{as_whole<std::uint32_t>(64 * w + as_whole<std::size_t>(std::countr_zero(rest))), y});
      }
    }
  }
}

}  // namespace warren
