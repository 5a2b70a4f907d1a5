// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "pictures/formats/markup.hpp"

namespace warren::studies {
namespace {

/// Of each column the width of its widest cell, the head included; 0 where no row says anything.
std::vector<std::size_t> widths_of(const TextTable& table) {
  std::vector<std::size_t> widths(table.head.size(), 0);
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (std::size_t i = 0; i < widths.size(); ++i) {
    if (widths[i] > 0) widths[i] = std::max(widths[i], table.head[i].size());
  }
  return widths;
}

TextTable without_empty_columns(TextTable table) {
  const std::vector<std::size_t> widths = widths_of(table);
  for (std::size_t i = widths.size(); i-- > 0;) {
    if (widths[i] > 0) continue;
    table.head.erase(table.head.begin() + static_cast<std::ptrdiff_t>(i));
    for (auto& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(i));
    table.words -= i < table.words ? 1 : 0;
  }
  return table;
}

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

std::string html_of(const TextTable& whole) {
  const TextTable table = without_empty_columns(whole);
  std::string text = table.title.empty() ? "" : "<h2>" + xml_text(table.title) + "</h2>\n";
  text += "<div class=\"wide\"><table><thead>" + cells_of(table, table.head, true) + "</thead><tbody>\n";
  for (const std::vector<std::string>& row : table.rows) text += cells_of(table, row, false);
  return text + "</tbody></table></div>\n";
}

std::string paragraphs(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& one : all) text += "<p>" + xml_text(one) + "</p>\n";
  return text;
}

std::string escaped(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}
std::string latex_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    out += c == '\\'  ? "\\textbackslash{}"
           : c == '~' ? "\\textasciitilde{}"
           : c == '^' ? "\\textasciicircum{}"
                      : escaped({&c, 1}, "&%$#_{}");
  }
  return out;
}

template <class Text>
std::string joined_cells(const std::vector<std::string>& cells, std::string_view between, const Text& text) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line.append(i == 0 ? "" : between).append(text(cells[i]));
  return line;
}

}  // namespace

std::string named_line(const Palette& palette, std::string_view name, std::string_view what) {
  return fmt::format("{}{}\n", palette.faint(fmt::format("{:<11}", name)), what);
}

std::string ReportPage::html() const {
  static constexpr std::string_view script = "report.js";
  std::string page = head_of_page(title, page_file("report.css"), std::span(&script, 1));
  page += "<body>\n<h1>" + xml_text(title) + "</h1>\n<p><code>" + xml_text(command_line) + "</code></p>\n";
  page += paragraphs(notes);
  if (!plots.empty()) page += fmt::format("<div class=\"plots\">\n{}\n</div>\n", fmt::join(plots, "\n"));
  for (const TextTable& table : tables) page += html_of(table);
  page += paragraphs(remarks);
  return page + script_element(script) + "</body>\n</html>\n";
}

std::string TextTable::markdown() const {
  const TextTable table = without_empty_columns(*this);
  const auto row = [](const std::vector<std::string>& cells) {
    return "| " + joined_cells(cells, " | ", [](const auto& cell) { return escaped(cell, "|*_<\\"); }) + " |\n";
  };
  std::string text = row(table.head) + '|';
  for (std::size_t i = 0; i < table.head.size(); ++i) text += i < table.words ? "---|" : "---:|";
  text += '\n';
  for (const auto& cells : table.rows) text += row(cells);
  return text;
}

std::string TextTable::latex() const {
  const TextTable table = without_empty_columns(*this);
  const auto row = [](const std::vector<std::string>& cells) {
    return joined_cells(cells, " & ", latex_text) + " \\\\\n";
  };
  std::string text = "\\begin{tabular}{" + std::string(table.words, 'l') +
                     std::string(table.head.size() - table.words, 'r') + "}\n\\toprule\n" + row(table.head) +
                     "\\midrule\n";
  for (const auto& cells : table.rows) text += row(cells);
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string TextTable::text(const Palette& palette) const {
  const TextTable table = without_empty_columns(*this);
  const std::vector<std::size_t> widths = widths_of(table);
  const auto line_of = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      line += i == 0 ? "" : "  ";
      line += i < table.words ? fmt::format("{:<{}}", cells[i], widths[i]) : fmt::format("{:>{}}", cells[i], widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
  };
  std::string text = palette.strong(line_of(table.head)) + '\n';
  for (const auto& row : table.rows) text += line_of(row) + '\n';
  return text;
}

}  // namespace warren::studies
