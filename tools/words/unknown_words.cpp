// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/unknown_words.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "core/base/printable.hpp"

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

namespace {

constexpr std::pair<std::string_view, std::string_view> spellings[] = {
    {"--svg", "--picture"}, {"--optimize", "--optimise"}, {"--neighbors", "--neighbours"}, {"--colour", "--color"}};

/// "| NAMES | HERE. |" a row, below the head.
std::vector<OtherName> rows_of(std::string_view page) {
  std::vector<OtherName> rows;
  while (!page.empty()) {
    const std::string_view row = page.substr(0, page.find('\n'));
    page.remove_prefix(row.size() + 1);
    const std::size_t bar = row.find(" | ");
    if (row.starts_with("| "))
      rows.push_back({row.substr(2, bar - 2), row.substr(bar + 3, row.rfind(". |") - bar - 3)});
  }
  rows.erase(rows.begin());
  return rows;
}

/// Without what differs from one writer to the next.
std::string letters_of(std::string_view word) {
  std::string letters;
  for (const char c : word) {
    if (std::string_view("-_ \\").find(c) != std::string_view::npos) continue;
    letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (letters.ends_with("star")) letters.replace(letters.size() - 4, 4, "*");
  constexpr std::size_t shortest_plural = 4;
  if (letters.size() >= shortest_plural && letters.ends_with('s')) letters.pop_back();
  return letters;
}

bool is_named(std::string_view list, const std::string& letters) {
  for (;;) {
    const std::size_t end = list.find(',');
    if (letters_of(list.substr(0, end)) == letters) return true;
    if (end == std::string_view::npos) return false;
    list.remove_prefix(end + 1);
  }
}

}  // namespace

const std::vector<OtherName>& other_names() {
  static const std::vector<OtherName> rows = rows_of(other_names_page().front().bytes);
  return rows;
}

std::string other_name(std::string_view word) {
  const auto is_it = [letters = letters_of(word)](const OtherName& row) { return is_named(row.names, letters); };
  const auto row = std::find_if(other_names().begin(), other_names().end(), is_it);
  if (row == other_names().end()) return {};
  std::string text{row->here};
  std::erase_if(text, [](char c) { return c == '`' || c == '\\'; });
  return text;
}

std::string_view own_spelling(std::string_view option) {
  for (const auto& [other, own] : spellings) {
    if (option == other) return own;
  }
  return option;
}

}  // namespace warren::tools
