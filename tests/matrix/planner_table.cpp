// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/planner_table.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace warren::test {
namespace {

/// "a | b | c" without the blanks around.
std::vector<std::string> parts_of(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream text(line);
  for (std::string part; std::getline(text, part, '|');) {
    const std::size_t first = part.find_first_not_of(' ');
    const std::size_t last = part.find_last_not_of(' ');
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
  }
  return parts;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

PlannerField field_of(std::istringstream& rest) {
  std::string mark;
  PlannerField field;
  rest >> mark >> std::ws;
  if (mark.size() != 3 || mark.find_first_not_of("+-") != std::string::npos) {
    throw std::runtime_error("planners.table: a field needs three of + and -");
  }
  field.optimises = mark[0] == '+';
  field.is_kept = mark[1] == '+';
  field.chooses_index = mark[2] == '+';
  std::getline(rest, field.words);
  return field;
}

}  // namespace

PlannerTable PlannerTable::read(const std::string& file) {
  PlannerTable table;
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file + ": can't be read");
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream rest(line);
    std::string item;
    std::string name;
    rest >> item >> std::ws;
    std::string text;
    if (item == "field") {
      rest >> name;
      table.planners_.back().fields[name] = field_of(rest);
      continue;
    }
    std::getline(rest, text);
    const std::vector<std::string> parts = parts_of(text);
    if (item == "column" && parts.size() == 4) {
      table.columns_.push_back({parts[0], words_of(parts[1]), words_of(parts[2]), parts[3]});
    } else if (item == "planner" && parts.size() == 2) {
      table.planners_.push_back({parts[0], parts[1], {}});
    } else if (item == "refused" && parts.size() == 3) {
      table.refusals_.push_back({words_of(parts[0]), words_of(parts[1]), parts[2]});
    } else {
      throw std::runtime_error(file + ": " + line);
    }
  }
  return table;
}

const BodyColumn* PlannerTable::column_of(const std::string& body, const std::string& world) const {
  for (const BodyColumn& column : columns_) {
    if (holds(column.bodies, body) && holds(column.worlds, world)) return &column;
  }
  return nullptr;
}

const PlannerField* PlannerTable::field(const PlannerRow& planner, const BodyColumn& column) {
  const auto found = planner.fields.find(column.name);
  return found == planner.fields.end() ? nullptr : &found->second;
}

const std::string& PlannerTable::refusal(const std::string& body, const std::string& world) const {
  for (const Refusal& refusal : refusals_) {
    if (holds(refusal.bodies, body) && holds(refusal.worlds, world)) return refusal.names;
  }
  throw std::out_of_range("planners.table says nothing of " + body + " in " + world);
}

std::string PlannerTable::markdown() const {
  std::string text = "|";
  std::string rule = "\n|---|";
  for (const BodyColumn& column : columns_) {
    text += " | " + column.head;
    rule += "---|";
  }
  text += " |" + rule + "\n";
  for (const PlannerRow& planner : planners_) {
    text += "| `" + planner.name + "`: " + planner.does + " |";
    for (const BodyColumn& column : columns_) {
      const PlannerField* found = field(planner, column);
      text += found == nullptr ? " |" : " " + found->words + " |";
    }
    text += "\n";
  }
  return text;
}

}  // namespace warren::test
