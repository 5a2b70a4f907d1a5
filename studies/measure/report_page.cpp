// SPDX-License-Identifier: BSD-3-Clause
#include "studies/measure/report_page.hpp"

#include <fmt/format.h>

#include <span>
#include <string_view>

#include "pictures/model/xml_text.hpp"
#include "pictures/page/page_files.hpp"

namespace warren::studies {
namespace {

std::string cells_of(const TextTable& table, const std::vector<std::string>& cells, bool is_head) {
  std::string text = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string_view kind = i < table.words ? " class=\"word\"" : "";
    const std::string cell = xml_text(cells[i]);
    text += is_head ? fmt::format("<th scope=\"col\"{}><button>{}</button></th>", kind, cell)
                    : fmt::format("<td{}>{}</td>", kind, cell);
  }
  return text + "</tr>\n";
}

std::string html_of(const ReportTable& report) {
  const TextTable table = report.table.without_empty_columns();
  std::string text = report.title.empty() ? "" : "<h2>" + xml_text(report.title) + "</h2>\n";
  text += "<div class=\"wide\"><table><thead>" + cells_of(table, table.head, true) + "</thead><tbody>\n";
  for (const std::vector<std::string>& row : table.rows) text += cells_of(table, row, false);
  return text + "</tbody></table></div>\n";
}

std::string paragraphs(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& one : all) text += "<p>" + xml_text(one) + "</p>\n";
  return text;
}

}  // namespace

std::string ReportPage::html() const {
  static constexpr std::string_view script = "report.js";
  std::string page = head_of_page(title, page_file("report.css"), std::span(&script, 1));
  page += "<body>\n<h1>" + xml_text(title) + "</h1>\n<p><code>" + xml_text(command_line) + "</code></p>\n";
  page += paragraphs(notes);
  if (!plots.empty()) page += "<div class=\"plots\">\n";
  for (const std::string& plot : plots) page += plot + "\n";
  if (!plots.empty()) page += "</div>\n";
  for (const ReportTable& table : tables) page += html_of(table);
  page += paragraphs(remarks);
  return page + script_element(script) + "</body>\n</html>\n";
}

}  // namespace warren::studies
