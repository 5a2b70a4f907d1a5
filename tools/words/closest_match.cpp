// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/closest_match.hpp"

#include <algorithm>
#include <cctype>

#include "core/base/edit_distance.hpp"
#include "tools/words/other_names.hpp"

namespace warren::tools {
namespace {

std::string small_letters(std::string_view word) {
  std::string letters{word.substr(std::min(word.find_first_not_of('-'), word.size()))};
  for (char& c : letters) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

}  // namespace

std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
  if (const std::string here = other_name(word); !here.empty()) return "; " + here;
  constexpr std::size_t longest = 64;  // nobody misspells an option at greater length
  const std::string letters = small_letters(word.substr(0, longest));
  std::string_view best;
  std::size_t best_distance = letters.size() / 3 + 1;
  for (const std::string_view candidate : known) {
    const std::string its = small_letters(candidate);
    const bool is_begun = letters.size() > 2 && its.starts_with(letters);
    const std::size_t distance = is_begun ? 1 : edit_distance(letters, its);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best.empty() ? "" : "; did you mean " + std::string{best} + "?";
}

}  // namespace warren::tools
