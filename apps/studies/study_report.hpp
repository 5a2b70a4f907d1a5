// SPDX-License-Identifier: BSD-3-Clause
// What a study says: as tables for the terminal and for documents, and as a page that needs nothing but itself, with
// tables that a click on a head sorts, plots whose marks tell what they stand for, light and dark, wide and narrow.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/text/human_units.hpp"

namespace warren::studies {

/// Its columns are as wide as their widest cell.
struct TextTable {
  std::vector<std::string> head;
  std::size_t words = 0;   ///< so many columns from the left stand to the left, the others to the right
  std::string title = {};  ///< of pages and documents; "": none
  std::vector<std::vector<std::string>> rows = {};

  /// The head strong, each line with an end; columns that are empty in all rows are left out.
  std::string text(const Palette& palette) const;
  /// As Markdown has tables, or as LaTeX's tabular, with the package booktabs; without columns that are empty.
  std::string markdown() const;
  std::string latex() const;
};

/// A line with its end below a table: its name, faint and eleven wide, and what it says.
std::string named_line(const Palette& palette, std::string_view name, std::string_view what);

/// All words are plain text.
struct ReportPage {
  std::string title;
  std::string command_line = {};
  std::vector<std::string> notes = {};  ///< a paragraph each, above the plots
  std::vector<std::string> plots = {};  ///< SVG elements; what has data-tip tells it
  std::vector<TextTable> tables = {};
  std::vector<std::string> remarks = {};  ///< a paragraph each, at the end

  std::string html() const;
};

}  // namespace warren::studies
