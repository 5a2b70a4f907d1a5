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

constexpr std::pair<std::string_view, std::string_view> spellings[] = {
    {"--svg", "--picture"}, {"--optimize", "--optimise"}, {"--neighbors", "--neighbours"}, {"--colour", "--color"}};

/// Without what differs from one writer to the next.
std::string letters_of(std::string_view word) {
  std::string letters = small_letters(word);
  std::erase_if(letters, [](char c) { return std::string_view("-_ \\").find(c) != std::string_view::npos; });
  if (letters.ends_with("star")) letters.replace(letters.size() - 4, 4, "*");
  constexpr std::size_t shortest_plural = 4;
  if (letters.size() >= shortest_plural && letters.ends_with('s')) letters.pop_back();
  return letters;
}

struct NearRow {
  const OtherName* row = nullptr;
  std::string_view name;  ///< the one of its names that is meant
};

/// The first of the rows with the closest name that differs from the word in at most `most` letters.
NearRow row_near(std::string_view word, std::size_t most) {
  const std::string letters = letters_of(word);
  NearRow near;
  for (const OtherName& row : other_names()) {
    for (const std::string_view name : split(row.names, ", ")) {
      const std::string its = letters_of(name);
      const std::size_t distance = most == 0 ? its != letters : edit_distance(letters, its);
      if (distance > most || (near.row != nullptr && distance == most)) continue;
      near = {&row, name};
      most = distance;
      if (most == 0) return near;
    }
  }
  return near;
}

std::string plain(std::string_view text) {
  std::string words{text};
  std::erase_if(words, [](char c) { return c == '`' || c == '\\'; });
  return words;
}

}  // namespace

const std::vector<OtherName>& other_names() {
  static const std::vector<OtherName> rows = [] {  // "| NAMES | HERE. |" each, below the head
    std::vector<OtherName> all;
    for (const std::string_view row : split(other_names_page().front().bytes, "\n")) {
      const std::size_t bar = row.find(" | ");
      if (!row.starts_with("| ")) continue;
      all.push_back({row.substr(2, bar - 2), row.substr(bar + 3, row.rfind(". |") - bar - 3)});
    }
    all.erase(all.begin());
    return all;
  }();
  return rows;
}

std::string other_name(std::string_view word) {
  const NearRow found = row_near(word, 0);
  return found.row == nullptr ? std::string{} : plain(found.row->here);
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
  if (!best.empty()) return "; did you mean " + std::string{best} + "?";
  const NearRow near = row_near(word.substr(0, longest), letters.size() / 4);
  return near.row == nullptr ? "" : "; did you mean " + plain(near.name) + "? " + plain(near.row->here);
}

std::string_view own_spelling(std::string_view option) {
  for (const auto& [other, own] : spellings) {
    if (option == other) return own;
  }
  return option;
}

}  // namespace warren::tools
