// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/batch_questions_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/error.hpp"
#include "scenes/text/json_text.hpp"

namespace warren {
namespace {

using Json = nlohmann::json;

constexpr std::size_t longest_line = std::size_t{1} << 16;
constexpr double empty_field = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Takes the next field of a line of CSV; quotes mean nothing to numbers.
std::string_view take_field(std::string_view& line) {
  const std::size_t comma = line.find(',');
  const std::string_view field = trimmed(line.substr(0, comma));
  line = comma == std::string_view::npos ? std::string_view() : line.substr(comma + 1);
  return field;
}

std::optional<double> number_of(std::string_view field) {
  double value = 0.0;
  const auto [last, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool is_number = error == std::errc() && last == field.data() + field.size() && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

/// x, y, theta or 1 to 6.
std::optional<std::size_t> place_named(std::string_view name) {
  if (name == "theta") return 2;
  if (name.size() != 1) return std::nullopt;
  if (name == "x" || name == "y") return name == "x" ? 0 : 1;
  return name[0] >= '1' && name[0] <= '6' ? std::optional<std::size_t>(name[0] - '1') : std::nullopt;
}

/// The numbers of a state, of which the last may be missing.
bool take_state(std::vector<double>& state) {
  while (!state.empty() && std::isnan(state.back())) state.pop_back();
  return std::none_of(state.begin(), state.end(), [](double x) { return std::isnan(x); });
}

std::vector<double> numbers_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) return {};
  std::vector<double> numbers;
  if (!found->is_array()) throw InputError(key, "expected a list of numbers");
  for (const Json& number : *found) {
    if (!number.is_number()) throw InputError(key, "expected a list of numbers");
    numbers.push_back(number.get<double>());
  }
  return numbers;
}

}  // namespace

BatchQuestions::BatchQuestions(const InputFile& file) : file_(file), rest_(file.bytes()) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";  // as spreadsheets put before CSV
  if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  std::string_view all = rest_;
  std::string_view line = trimmed(take_line());
  while (line.empty() && !rest_.empty()) {
    all = rest_;
    line = trimmed(take_line());
  }
  if (line.starts_with("start_") || line.starts_with("goal_")) {
    read_header(line);
  } else if (!line.empty() && !line.starts_with("{")) {
    throw InputError(file.name() + ":1", "expected the header start_x,start_y,goal_x,goal_y of a CSV, or JSON lines",
                     line.substr(0, 40));
  } else {
    rest_ = all;
  }
}

std::string_view BatchQuestions::take_line() {
  const std::size_t end = rest_.find('\n');
  const std::string_view line = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
  return line;
}

void BatchQuestions::read_header(std::string_view line) {
  while (!line.empty()) {
    const std::string_view name = take_field(line);
    const bool is_goal = name.starts_with("goal_");
    const auto place = place_named(name.substr(std::min(name.size(), is_goal ? std::size_t{5} : std::size_t{6})));
    if (!(is_goal || name.starts_with("start_")) || !place) {
      throw InputError(file_.name() + ":1", "expected columns such as start_x, start_y, start_theta or goal_1", name);
    }
    const Column column{is_goal, *place};
    if (std::find(columns_.begin(), columns_.end(), column) != columns_.end()) {
      throw InputError(file_.name() + ":1", "expected each column once", name);
    }
    columns_.push_back(column);
  }
}

bool BatchQuestions::next(std::size_t most, std::vector<BatchQuestion>& some) {
  some.clear();
  while (some.size() < most && !rest_.empty()) {
    const std::string_view line = trimmed(take_line());
    if (line.empty()) continue;
    ++count_;
    if (line.size() > longest_line) {
      some.push_back({std::to_string(count_), {}, {}, "a line of more than 65,536 bytes"});
    } else {
      some.push_back(columns_.empty() ? read_json(line) : read_csv(line));
    }
  }
  return !some.empty();
}

BatchQuestion BatchQuestions::read_csv(std::string_view line) const {
  BatchQuestion question{std::to_string(count_), {}, {}, {}};
  if (static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1 != columns_.size()) {
    question.error = fmt::format("expected {} fields", columns_.size());
    return question;
  }
  for (const Column& column : columns_) {
    const std::string_view field = take_field(line);
    const auto number = field.empty() ? std::optional(empty_field) : number_of(field);
    if (!number) {
      question.error = fmt::format("expected a number (found: {})", field.substr(0, 40));
      return question;
    }
    std::vector<double>& state = column.is_goal ? question.goal : question.start;
    if (state.size() <= column.place) state.resize(column.place + 1, empty_field);
    state[column.place] = *number;
  }
  if (!take_state(question.start) || !take_state(question.goal)) question.error = "a number is missing";
  return question;
}

BatchQuestion BatchQuestions::read_json(std::string_view line) const {
  BatchQuestion question{std::to_string(count_), {}, {}, {}};
  try {
    const Json json = Json::parse(line);
    if (!json.is_object()) throw InputError("line", "expected one JSON object");
    if (const auto id = json.find("id"); id != json.end() && (id->is_string() || id->is_number())) {
      question.id = id->is_string() ? json_string(id->get<std::string>()) : id->dump();
    }
    question.start = numbers_of(json, "start");
    question.goal = numbers_of(json, "goal");
  } catch (const InputError& error) {
    question.error = error.what();
  } catch (const Json::exception&) {
    question.error = "expected one JSON object {\"id\", \"start\", \"goal\"}";
  }
  return question;
}

}  // namespace warren
