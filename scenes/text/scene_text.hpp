// SPDX-License-Identifier: BSD-3-Clause
// The words of one line of a scene file: fields between blanks or commas up to a `#`, numbers as the C locale writes
// them, and errors that name file and line. Numbers that are not finite or beyond largest_coordinate are refused,
// numbers nearer to zero than smallest_coordinate are zero.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "parallel/execution.hpp"

namespace warren::scene_text {

/// Where an error is: "file:line"; line 0 is no line: an option, a key.
struct Place {
  const std::string& file;
  std::size_t line;
  std::string text() const;
  /// Throws InputError; `found` is shortened and made printable.
  [[noreturn]] void fail(std::string_view what, std::string_view found = {}) const;
};

inline bool is_blank(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

/// Walks over the fields of one line. With an execution, runs of blanks or letters look at the deadline every 64 KiB.
class Fields {
 public:
  Fields(std::string_view line, Place place, const Execution* execution = nullptr)
      : at_(line.data()), end_(line.data() + line.size()), place_(place), execution_(execution) {
    skip_blanks();
  }
  bool done() const { return at_ == end_; }
  /// Does a number come next, by its first character?
  bool number_follows() const {
    return !done() && ((*at_ >= '0' && *at_ <= '9') || *at_ == '-' || *at_ == '+' || *at_ == '.');
  }
  /// The next field as it stands; empty at the end.
  std::string_view word();
  /// The next field as a number. Throws InputError if it is none, or longer than 65,536 characters.
  double number();
  const Place& place() const { return place_; }

 private:
  static constexpr std::ptrdiff_t longest_run = 1 << 16;  // of letters without a look, and of a number's

  template <class Wanted>
  void skip_while(const Wanted& wanted) {
    const char* look = at_ + std::min(longest_run, end_ - at_);
    while (at_ != end_ && wanted(*at_)) {
      if (++at_ != look || look == end_) continue;
      if (execution_ != nullptr) execution_->check();
      look += std::min(longest_run, end_ - at_);
    }
  }
  void skip_blanks() {
    skip_while(is_blank);
    if (at_ != end_ && *at_ == '#') at_ = end_;
  }
  double out_of_range(std::string_view field) const;

  const char* at_;
  const char* end_;
  Place place_;
  const Execution* execution_;
};

/// The known word that is nearest to what was written, by edit distance; empty if none is near.
std::string_view nearest_word(std::string_view written, std::span<const std::string_view> known);

}  // namespace warren::scene_text
