// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/batch_questions_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/error.hpp"

namespace warren {
namespace {

using Json = nlohmann::json;

constexpr std::size_t longest_line = std::size_t{1} << 16;
constexpr double empty_field = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::string_view, 3> plane_axes{"x", "y", "theta"};
constexpr std::array<std::string_view, 6> joint_axes{"1", "2", "3", "4", "5", "6"};

std::span<const std::string_view> axes_of(unsigned dimension) {
  if (dimension > plane_axes.size()) return joint_axes;
  return std::span(plane_axes).first(dimension);
}

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

/// Only a goal's heading may be missing, or all of a state: then the world's own stands.
bool take_state(std::vector<double>& state, bool is_goal) {
  const auto is_missing = [](double x) { return std::isnan(x); };
  if (std::all_of(state.begin(), state.end(), is_missing)) state.clear();
  if (is_goal && state.size() == plane_axes.size() && is_missing(state.back())) state.pop_back();
  return std::none_of(state.begin(), state.end(), is_missing);
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

void take_id(const Json& json, BatchQuestion& question) {
  const auto id = json.find("id");
  if (id == json.end()) return;
  if (!id->is_string() && !id->is_number()) throw InputError("id", "expected a text or a number");
  question.id_is_text = id->is_string();
  question.id = id->is_string() ? id->get<std::string>() : id->dump();
}

void refuse_other_keys(const Json& json, bool is_place) {
  for (const auto& [key, value] : json.items()) {
    const bool known = key == "id" || (is_place ? key == "state" : key == "start" || key == "goal");
    if (!known)
      throw InputError(key, is_place ? "expected the keys id and state" : "expected the keys id, start, goal");
  }
}

}  // namespace

BatchQuestions::BatchQuestions(const InputFile& file, BatchLines kind, const Roadmap& roadmap,
                               const Execution& execution)
    : lines_(file, execution), kind_(kind), scene_(roadmap.world.outline()), axes_(axes_of(roadmap.arrays.dimension)) {
  std::string_view line;
  while (line.empty() && lines_.next()) line = trimmed(lines_.line());
  if (line.empty()) return;
  is_at_line_ = line.starts_with("{");
  if (!is_at_line_) read_header(line);
}

std::string_view BatchQuestions::prefix(bool is_goal) const {
  if (kind_ != BatchLines::questions) return "";
  return is_goal ? "goal_" : "start_";
}

std::string BatchQuestions::whole_header() const {
  std::string header;
  for (const bool is_goal : {false, true}) {
    if (is_goal && kind_ != BatchLines::questions) break;
    for (const std::string_view axis : axes_) {
      header.append(header.empty() ? "" : ",").append(prefix(is_goal)).append(axis);
    }
  }
  return header;
}

void BatchQuestions::read_header(std::string_view line) {
  const std::string where = lines_.place().text();
  while (!line.empty()) {
    const std::string_view name = take_field(line);
    const bool is_goal = kind_ == BatchLines::goals || (kind_ == BatchLines::questions && name.starts_with("goal_"));
    const std::string_view head = prefix(is_goal);
    const auto axis = std::find(axes_.begin(), axes_.end(), name.substr(std::min(head.size(), name.size())));
    if (!name.starts_with(head) || axis == axes_.end()) {
      throw InputError(where, fmt::format("expected the header {} of a CSV, or JSON lines", whole_header()),
                       name.substr(0, 40));
    }
    const Column column{is_goal, static_cast<std::size_t>(axis - axes_.begin())};
    if (std::find(columns_.begin(), columns_.end(), column) != columns_.end()) {
      throw InputError(where, "expected each column once", name);
    }
    columns_.push_back(column);
  }
  check_columns(where);
}

/// All columns of a state or none: then the world has a state of its own.
void BatchQuestions::check_columns(const std::string& where) const {
  for (const bool is_goal : {false, true}) {
    const bool any = std::any_of(columns_.begin(), columns_.end(), [&](Column c) { return c.is_goal == is_goal; });
    const bool has_own = !(is_goal ? scene_.goal : scene_.start).empty();
    if (!any && (kind_ != BatchLines::questions || has_own)) continue;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const bool may_lack = is_goal && axes_[i] == plane_axes.back();
      if (may_lack || std::find(columns_.begin(), columns_.end(), Column{is_goal, i}) != columns_.end()) continue;
      const std::string_view why = any ? "" : is_goal ? ", for the world has no goal" : ", for the world has no start";
      throw InputError(where, fmt::format("lacks the column {}{}{}", prefix(is_goal), axes_[i], why));
    }
  }
}

bool BatchQuestions::next(std::size_t most, std::vector<BatchQuestion>& some) {
  some.clear();
  while (some.size() < most && (is_at_line_ || lines_.next())) {
    is_at_line_ = false;
    const std::string_view line = trimmed(lines_.line());
    if (line.empty()) continue;
    ++count_;
    some.push_back(read_line(line));
  }
  return !some.empty();
}

BatchQuestion BatchQuestions::read_line(std::string_view line) const {
  BatchQuestion question;
  question.id = std::to_string(count_);
  try {
    if (line.size() > longest_line) {
      question.error = "a line of more than 65,536 bytes";
    } else {
      columns_.empty() ? read_json(line, question) : read_csv(line, question);
    }
  } catch (const InputError& error) {
    question.error = error.what();
  } catch (const Json::exception&) {
    question.error = kind_ == BatchLines::questions ? "expected one JSON object {\"id\", \"start\", \"goal\"}"
                                                    : "expected one JSON object {\"id\", \"state\"}";
  }
  return question;
}

void BatchQuestions::read_csv(std::string_view line, BatchQuestion& question) const {
  if (static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1 != columns_.size()) {
    question.error = fmt::format("expected {} fields", columns_.size());
    return;
  }
  for (const Column& column : columns_) {
    const std::string_view field = take_field(line);
    const auto number = field.empty() ? std::optional(empty_field) : number_of(field);
    if (!number) {
      question.error = fmt::format("expected a number (found: {})", printable(field, 40));
      return;
    }
    std::vector<double>& state = column.is_goal ? question.goal : question.start;
    if (state.size() <= column.place) state.resize(column.place + 1, empty_field);
    state[column.place] = *number;
  }
  if (!take_state(question.start, false) || !take_state(question.goal, true)) {
    question.error = "a number is missing";
    return;
  }
  if (kind_ == BatchLines::goals) question.start = std::move(question.goal);
  if (kind_ != BatchLines::questions) check_place(question.start);
}

void BatchQuestions::read_json(std::string_view line, BatchQuestion& question) const {
  const Json json = Json::parse(line);
  if (!json.is_object()) throw InputError("line", "expected one JSON object");
  take_id(json, question);
  refuse_other_keys(json, kind_ != BatchLines::questions);
  if (kind_ == BatchLines::questions) {
    question.start = numbers_of(json, "start");
    question.goal = numbers_of(json, "goal");
  } else {
    question.start = numbers_of(json, "state");
    check_place(question.start);
  }
}

/// A goal may have no heading, or be a place of an arm's tool.
void BatchQuestions::check_place(const std::vector<double>& place) const {
  const bool any_heading = axes_.size() == 3 && place.size() == 2;
  const bool of_the_tool = axes_.size() == joint_axes.size() && place.size() == 3;
  if (place.size() == axes_.size() || (kind_ == BatchLines::goals && (any_heading || of_the_tool))) return;
  throw InputError("state", fmt::format("expected {} numbers (found: {})", axes_.size(), place.size()));
}

}  // namespace warren
