// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/program_answer.hpp"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace warren::test {
namespace {

/// What follows `"key": `, or `"key":` in an object within.
const char* value_of(const std::string& json, const std::string& key) {
  const std::string sought = "\"" + key + "\":";
  const std::size_t at = json.find(sought);
  if (at == std::string::npos) throw std::runtime_error("the answer has no " + key);
  const char* const value = json.c_str() + at + sought.size();
  return *value == ' ' ? value + 1 : value;
}

/// A difference that went below 0 comes out as larger than all others.
std::vector<unsigned long long> counts_in(const std::string& object, const std::vector<std::string>& keys) {
  std::vector<unsigned long long> counts;
  for (const std::string& key : keys) counts.push_back(std::strtoull(value_of(object, key), nullptr, 10));
  return counts;
}

/// [[1, 2], [3, 4]]; a list by itself is one of lists.
std::vector<std::vector<double>> lists_at(const char* c) {
  std::vector<std::vector<double>> lists;
  int depth = 0;
  while (*c != '\0') {
    if (*c == '[') {
      if (++depth == 2) lists.emplace_back();
      ++c;
    } else if (*c == ']') {
      ++c;
      if (--depth == 0) break;
    } else if (depth > 0 && *c != ',' && *c != ' ' && *c != '\n') {
      if (lists.empty()) lists.emplace_back();
      char* end = nullptr;
      lists.back().push_back(std::strtod(c, &end));
      if (end == c) throw std::runtime_error("the answer has something in a list that is no number");
      c = end;
    } else {
      if (depth == 0) break;  // null
      ++c;
    }
  }
  return lists;
}

}  // namespace

ProgramAnswer read_program_answer(const std::string& json) {
  ProgramAnswer answer;
  const std::string status = value_of(json, "status");
  answer.status = status.substr(1, status.find('"', 1) - 1);
  answer.verified = std::string(value_of(json, "verified")).starts_with("true");
  const auto number_of = [&](const char* key) {
    const std::string rest = value_of(json, key);
    return rest.substr(0, rest.find_first_of(",}"));
  };
  answer.length = number_of("length");
  if (json.find("\"lower_bound\": ") != std::string::npos) answer.lower_bound = number_of("lower_bound");
  if (json.find("\n \"cost\": ") != std::string::npos) answer.cost = number_of("cost");
  if (json.find("\"gap\": ") != std::string::npos) answer.gap = number_of("gap");
  answer.optimal = json.find("\"optimal\": true") != std::string::npos;
  if (json.find("\"expanded\": ") != std::string::npos) answer.expanded = number_of("expanded");
  if (json.find("\"explained\": ") != std::string::npos) {
    const std::string explained = value_of(json, "explained");
    answer.samples = counts_in(value_of(explained, "samples"), {"drawn", "kept", "dropped"});
    answer.motions = counts_in(value_of(explained, "motions"), {"checked", "free", "blocked", "undecided"});
  }
  const std::size_t path = json.find("\"path\": [");  // a stage may be called so, too
  if (path == std::string::npos) throw std::runtime_error("the answer has no path");
  answer.path = lists_at(json.c_str() + json.find('[', path));
  answer.says_why_blocked = json.find("\"blocked\": {") != std::string::npos;
  if (answer.says_why_blocked) {
    const auto place = lists_at(value_of(json, "free_place"));
    if (!place.empty()) answer.free_place = place.front();
  }
  return answer;
}

std::vector<std::vector<double>> read_numbers(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::strtod(cell.c_str(), nullptr));
  }
  return rows;
}

std::string smallest_answer(const std::string& robot, const std::vector<std::vector<double>>& path) {
  std::ostringstream text;
  text.precision(17);
  text << "{\"robot\": \"" << robot << "\", \"path\": [";
  for (std::size_t i = 0; i < path.size(); ++i) {
    text << (i == 0 ? "[" : ", [");
    for (std::size_t k = 0; k < path[i].size(); ++k) text << (k == 0 ? "" : ", ") << path[i][k];
    text << ']';
  }
  text << "]}\n";
  return text.str();
}

}  // namespace warren::test
