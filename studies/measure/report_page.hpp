// SPDX-License-Identifier: BSD-3-Clause
// A study as a page that needs nothing but itself: tables that a click on a head sorts, plots whose marks tell what
// they stand for, light and dark, wide and narrow.
#pragma once

#include <string>
#include <vector>

#include "studies/measure/text_table.hpp"

namespace warren::studies {

struct ReportTable {
  std::string title;  ///< "": none
  TextTable table;
};

/// All words are plain text.
struct ReportPage {
  std::string title;
  std::string command_line = {};
  std::vector<std::string> notes = {};  ///< a paragraph each, above the plots
  std::vector<std::string> plots = {};  ///< SVG elements; what has data-tip tells it
  std::vector<ReportTable> tables = {};
  std::vector<std::string> remarks = {};  ///< a paragraph each, at the end

  std::string html() const;
};

}  // namespace warren::studies
