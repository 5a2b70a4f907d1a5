// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "studies/compare/comparison_report.hpp"
#include "studies/measure/machine_memory.hpp"

namespace warren::studies {

std::string comparison_page(const Comparison& comparison, const std::string& command_line) {
  ReportPage page{.title = "Planners and searches side by side",
                  .command_line = command_line,
                  .tables = comparison_tables(comparison),
                  .remarks = comparison.notes};
  for (const PlotSheet& sheet : comparison_panels(comparison)) page.plots.push_back(sheet.svg());
  page.notes.push_back(fmt::format("Machine: {}.{}", text_of(this_machine()),
                                   comparison.stopped ? " Interrupted: these are the runs so far." : ""));
  return page.html();
}

}  // namespace warren::studies
