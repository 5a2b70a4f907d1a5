// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/program_answer.hpp"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace warren::test {
namespace {

/// What follows `"key": `.
const char* value_of(const std::string& json, const std::string& key) {
  const std::string sought = "\"" + key + "\": ";
  const std::size_t at = json.find(sought);
  if (at == std::string::npos) throw std::runtime_error("the answer has no " + key);
  return json.c_str() + at + sought.size();
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
  if (json.find("\"expanded\": ") != std::string::npos) answer.expanded = number_of("expanded");
  int depth = 0;
  for (const char* c = value_of(json, "path"); *c != '\0';) {
    if (*c == '[') {
      if (++depth == 2) answer.path.emplace_back();
      ++c;
    } else if (*c == ']') {
      ++c;
      if (--depth == 0) break;
    } else if (depth == 2 && *c != ',' && *c != ' ' && *c != '\n') {
      char* end = nullptr;
      answer.path.back().push_back(std::strtod(c, &end));
      if (end == c) throw std::runtime_error("the answer's path has something that is no number");
      c = end;
    } else {
      ++c;
    }
  }
  return answer;
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
