// SPDX-License-Identifier: BSD-3-Clause
// A table for the terminal, with columns as wide as their widest cell, and for documents.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/text/palette.hpp"

namespace warren::studies {

struct TextTable {
  std::vector<std::string> head;
  std::size_t words = 0;  ///< so many columns from the left stand to the left, the others to the right
  std::vector<std::vector<std::string>> rows;

  /// The head strong, each line with an end; columns that are empty in all rows are left out.
  std::string text(const Palette& palette) const;

  TextTable without_empty_columns() const;

  /// As Markdown has tables, or as LaTeX's tabular, with the package booktabs; without columns that are empty.
  std::string markdown() const;
  std::string latex() const;
};

}  // namespace warren::studies
