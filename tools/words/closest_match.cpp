// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/closest_match.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include "tools/words/other_names.hpp"

namespace warren::tools {
namespace {

std::string small_letters(std::string_view word) {
  std::string letters{word.substr(std::min(word.find_first_not_of('-'), word.size()))};
  for (char& c : letters) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

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
