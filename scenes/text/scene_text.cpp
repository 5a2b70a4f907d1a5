// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/scene_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/edit_distance.hpp"
#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "core/base/types.hpp"

namespace warren::scene_text {

std::string Place::text() const { return line == 0 ? file : fmt::format("{}:{}", file, line); }

void Place::fail(std::string_view what, std::string_view found) const {
  constexpr std::size_t longest = 40;
  throw InputError(text(), what, printable(found, longest));
}

std::string_view Fields::word() {
  const char* begin = at_;
  skip_while([](char c) { return !is_blank(c) && c != '#'; });
  const std::string_view field(begin, static_cast<std::size_t>(at_ - begin));
  skip_blanks();
  return field;
}

double Fields::number() {
  const char* begin = at_;
  double value = 0.0;
  const bool plus = at_ != end_ && *at_ == '+' && at_ + 1 != end_ && at_[1] != '-';
  const char* limit = at_ + std::min(longest_run, end_ - at_);
  const auto [last, error] = std::from_chars(plus ? at_ + 1 : at_, limit, value);
  if (error == std::errc() && std::abs(value) <= largest_coordinate &&
      (last == end_ || is_blank(*last) || *last == '#')) {
    at_ = last;
    skip_blanks();
    return std::abs(value) < smallest_coordinate ? 0.0 : value;
  }
  const std::string_view field = word();
  if (field.empty()) place_.fail("a number is missing");
  if (last == limit && last != begin + field.size()) {
    place_.fail("expected numbers of at most 65536 characters", field);
  }
  if (last != begin + field.size() || error == std::errc::invalid_argument) place_.fail("expected a number", field);
  if (error == std::errc::result_out_of_range) return out_of_range(field);
  if (!std::isfinite(value)) place_.fail("numbers must be finite", field);
  place_.fail("numbers must not exceed 1e60 in magnitude", field);
}

/// A number that no double holds: too near to zero, which is read as zero, or too large.
double Fields::out_of_range(std::string_view field) const {
  const std::size_t exponent = field.find_first_of("eE");
  const bool tiny = exponent != std::string_view::npos ? field.substr(exponent + 1).starts_with('-')
                                                       : field.find_first_of("123456789") > field.find('.');
  if (tiny) return 0.0;
  place_.fail("numbers must not exceed 1e60 in magnitude", field);
}

std::string_view nearest_word(std::string_view written, std::span<const std::string_view> known) {
  constexpr std::size_t longest_word = 32;
  if (written.size() > longest_word) return {};
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(2, written.size() / 2) + 1;
  for (const std::string_view word : known) {
    const std::size_t distance = edit_distance(written, word);
    if (distance < best_distance) {
      best_distance = distance;
      best = word;
    }
  }
  return best;
}

}  // namespace warren::scene_text
