// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/ask_batch_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/json_text.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/kept/roadmap.hpp"

namespace warren {
namespace {

struct BatchQuestion {
  std::string id;  ///< a CSV line's is its number from 1
  bool id_is_text = false;
  std::vector<double> start;  ///< empty: the world's own, as the goal; of a matrix its place
  std::vector<double> goal;
  std::string error;  ///< what is wrong with the line; empty: nothing

  std::string json_id() const { return id_is_text ? json_string(id) : id; }
  std::string csv_id() const { return csv_field(id); }
};

enum class BatchLines : std::uint8_t { questions, starts, goals };

using Json = nlohmann::json;

constexpr std::size_t longest_line = std::size_t{1} << 16;
constexpr double empty_field = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::string_view, 3> plane_axes{"x", "y", "theta"};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);  // npos + 1 is 0
}

/// Takes the next field of a line of CSV; quotes mean nothing to numbers.
std::string_view take_field(std::string_view& line) {
  const std::size_t comma = line.find(',');
  const std::string_view field = trimmed(line.substr(0, comma));
  line = comma == std::string_view::npos ? std::string_view() : line.substr(comma + 1);
  return field;
}

std::optional<double> number_of(std::string_view field) {
  const auto value = scene_text::number_in_full<double>(field);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Only a goal's heading may be missing, or all of a state: then the world's own stands.
bool take_state(std::vector<double>& state, bool is_goal) {
  const auto is_missing = [](double x) { return std::isnan(x); };
  if (std::ranges::all_of(state, is_missing)) state.clear();
  if (is_goal && state.size() == plane_axes.size() && is_missing(state.back())) state.pop_back();
  return std::ranges::none_of(state, is_missing);
}

std::vector<double> numbers_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) return {};
  const bool are_numbers = std::all_of(found->begin(), found->end(), [](const Json& x) { return x.is_number(); });
  if (!found->is_array() || !are_numbers) throw InputError(key, "expected a list of numbers");
  return found->get<std::vector<double>>();
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

/// The questions of a batch, or the places of a matrix, line by line: CSV or JSON lines (docs/file_formats.md). Refers
/// to the file, the roadmap and the execution; belongs to one thread.
class BatchQuestions {
 public:
  /// Throws InputError for a CSV whose header names other columns, or lacks one without which no line can be asked;
  /// Stopped.
  BatchQuestions(const InputFile& file, BatchLines kind, const Roadmap& roadmap, const Execution& execution)
      : lines_(file, execution), kind_(kind), scene_(roadmap.world.outline()), width_(roadmap.arrays.dimension) {
    for (const bool is_goal : {false, true}) {
      if (kind != BatchLines::questions && is_goal != (kind == BatchLines::goals)) continue;
      const std::string_view prefix = kind != BatchLines::questions ? "" : is_goal ? "goal_" : "start_";
      for (std::size_t i = 0; i < width_; ++i) {
        const std::string axis = width_ > plane_axes.size() ? std::to_string(i + 1) : std::string(plane_axes[i]);
        known_.push_back({is_goal, i, fmt::format("{}{}", prefix, axis)});
      }
    }
    std::string_view line;
    while (line.empty() && lines_.next()) line = trimmed(lines_.line());
    if (line.empty()) return;
    is_at_line_ = line.starts_with("{");
    if (!is_at_line_) read_header(line);
  }
  /// Fills `some` with the next ones, at most so many; false where there are none left. Throws Stopped.
  bool next(std::size_t most, std::vector<BatchQuestion>& some) {
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

 private:
  /// Where a column's number goes: the start's or the goal's, and which of its numbers.
  struct Column {
    bool is_goal;
    std::size_t place;
    std::string name;
  };
  std::string whole_header() const {
    std::string header;
    for (const Column& column : known_) header.append(header.empty() ? "" : ",").append(column.name);
    return header;
  }
  void read_header(std::string_view line) {
    const std::string where = lines_.place().text();
    while (!line.empty()) {
      const std::string_view name = take_field(line);
      const auto column = std::ranges::find(known_, name, &Column::name);
      if (column == known_.end()) {
        throw InputError(where, fmt::format("expected the header {} of a CSV, or JSON lines", whole_header()),
                         name.substr(0, 40));
      }
      if (std::ranges::find(columns_, name, &Column::name) != columns_.end()) {
        throw InputError(where, "expected each column once", name);
      }
      columns_.push_back(*column);
    }
    check_columns(where);
  }
  /// All columns of a state or none: then the world has a state of its own.
  void check_columns(const std::string& where) const {
    for (const Column& column : known_) {
      const bool any = std::ranges::count(columns_, column.is_goal, &Column::is_goal) > 0;
      const bool has_own = !(column.is_goal ? scene_.goal : scene_.start).empty();
      const bool is_heading_of_goal = column.is_goal && width_ == plane_axes.size() && column.place + 1 == width_;
      if ((!any && has_own) || is_heading_of_goal) continue;
      if (std::ranges::find(columns_, column.name, &Column::name) != columns_.end()) continue;
      const std::string_view why = any              ? ""
                                   : column.is_goal ? ", for the world has no goal"
                                                    : ", for the world has no start";
      throw InputError(where, fmt::format("lacks the column {}{}", column.name, why));
    }
  }
  BatchQuestion read_line(std::string_view line) const {
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
  void read_csv(std::string_view line, BatchQuestion& question) const {
    if (static_cast<std::size_t>(std::ranges::count(line, ',')) + 1 != columns_.size()) {
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
  void read_json(std::string_view line, BatchQuestion& question) const {
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
  void check_place(const std::vector<double>& place) const {
    const bool any_heading = width_ == 3 && place.size() == 2;
    const bool of_the_tool = width_ > plane_axes.size() && place.size() == 3;
    if (place.size() == width_ || (kind_ == BatchLines::goals && (any_heading || of_the_tool))) return;
    throw InputError("state", fmt::format("expected {} numbers (found: {})", width_, place.size()));
  }

  TextLines lines_;
  bool is_at_line_ = false;  // the line is still to be read
  BatchLines kind_;
  const Scene& scene_;
  std::size_t width_;            // numbers of a state
  std::vector<Column> known_;    // all that a header may have
  std::vector<Column> columns_;  // empty: JSON lines
  std::uint64_t count_ = 0;
};

// Questions whose answers are held at once: lengths are few bytes, paths may be millions.
constexpr std::size_t path_block = 1024;
constexpr std::size_t length_block = 16384;
constexpr std::size_t bytes_of_number = 26;  // as text, at most

std::string path_json(const Answer& answer) {
  std::string text = "[";
  for (std::size_t i = 0; i < answer.state_count(); ++i) {
    if (i > 0) text += ',';
    append_json_list(text, answer.numbers(i));
  }
  return text + "]";
}

struct AnsweredChunk : BatchAccount {
  std::string text;
};

/// whole: nullptr where lengths alone are asked.
void add_line(const BatchOptions& options, const BatchQuestion& question, Outcome outcome, std::optional<double> length,
              const Answer* whole, AnsweredChunk& chunk) {
  chunk.solved += outcome == Outcome::solved ? 1 : 0;
  if (options.csv) {
    chunk.text.append(question.csv_id()).append(",").append(name_of(outcome)).append(",");
    if (length) append_json_number(chunk.text, *length);
    if (whole != nullptr) chunk.text += whole->verified ? ",true" : ",false";
  } else {
    JsonObject object;
    object.add_json("id", question.json_id());
    object.add("status", name_of(outcome), "length", length);
    if (whole != nullptr) object.add("verified", whole->verified);
    if (whole != nullptr) object.add_json("path", path_json(*whole));
    chunk.text += object.closed();
  }
  chunk.text += '\n';
}

void add_answer(const RoadmapQuery& query, const BatchOptions& options, const BatchQuestion& question,
                const Execution& one_thread, QuestionScratch& scratch, AnsweredChunk& chunk) {
  std::string error = question.error;
  if (error.empty()) {
    try {
      one_thread.check();
      if (options.lengths_only) {
        const auto [outcome, length] =
            query.length_within(question.start, question.goal, options.how, one_thread, scratch);
        return add_line(options, question, outcome, outcome == Outcome::solved ? std::optional(length) : std::nullopt,
                        nullptr, chunk);
      }
      const Answer answer = query.ask_within(question.start, question.goal, options.how, one_thread, scratch);
      if (answer.outcome == Outcome::stopped) throw Stopped(answer.stop_reason.value_or(StopReason::time));
      constexpr std::size_t copies = 4;  // while the text grows, and moves into the block's
      const std::size_t numbers = options.csv ? 0 : answer.state_count() * answer.state_width();
      one_thread.reserve(copies * bytes_of_number * numbers);
      return add_line(options, question, answer.outcome, answer.verified ? std::optional(answer.length) : std::nullopt,
                      &answer, chunk);
    } catch (const UsageError& wrong) {
      error = wrong.what();
    }
  }
  ++chunk.wrong;
  chunk.text += options.csv ? question.csv_id() + (options.lengths_only ? ",error,\n" : ",error,,\n")
                            : "{\"id\":" + question.json_id() + ",\"error\":" + json_string(error) + "}\n";
}

/// Calls each(question, which of the threads has it), each thread with questions that follow one another.
template <class Each>
void deal(std::size_t questions, std::size_t threads, const Execution& execution, const Each& each) {
  const std::size_t share = std::max<std::size_t>(1, chunk_count(questions, threads));
  for_chunks(questions, share, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) each(i, r.first / share);
  });
}

// Pairs whose lengths are held at once, where a line has fewer.
constexpr std::size_t pairs_at_once = std::size_t{1} << 14;
constexpr std::size_t most_starts = 1024;
constexpr std::size_t bytes_of_place = sizeof(BatchQuestion) + 64;
constexpr std::size_t bytes_of_entry = 128;  // a length as a number and as text

std::vector<BatchQuestion> all_places(const InputFile& file, const Roadmap& roadmap, const Execution& execution) {
  BatchQuestions reader(file, BatchLines::goals, roadmap, execution);
  std::vector<BatchQuestion> all;
  std::vector<BatchQuestion> some;
  while (reader.next(pairs_at_once, some)) {
    execution.reserve((all.size() + some.size()) * bytes_of_place);
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

struct Entry {
  LengthAnswer answer;
  std::string error;  ///< why it can't be asked; empty: it can

  bool is_solved() const { return error.empty() && answer.outcome == Outcome::solved; }
};

Entry asked_pair(const RoadmapQuery& query, const BatchOptions& options, const BatchQuestion& start,
                 const BatchQuestion& goal, const Execution& one_thread, QuestionScratch& scratch) {
  if (!start.error.empty()) return {{}, start.error};
  if (!goal.error.empty()) return {{}, fmt::format("goal {}: {}", goal.id, goal.error)};
  try {
    one_thread.check();
    return {query.length_within(start.start, goal.start, options.how, one_thread, scratch), {}};
  } catch (const UsageError& error) {
    return {{}, error.what()};
  }
}

std::string csv_line(const BatchQuestion& start, std::span<const Entry> row) {
  std::string text = start.csv_id();
  for (const Entry& entry : row) {
    text += ',';
    if (!entry.error.empty()) text += "error";
    if (entry.is_solved()) append_json_number(text, entry.answer.length);
  }
  return text + "\n";
}

/// The row's error is the first of its pairs'.
std::string json_line(const BatchQuestion& start, std::span<const Entry> row) {
  JsonObject object;
  object.add_json("id", start.json_id());
  if (!start.error.empty()) {
    object.add("error", std::string_view(start.error));
    return object.closed() + "\n";
  }
  object.add_json("status", json_list_of(row, ",", [](const Entry& entry) {
                    return fmt::format("\"{}\"", entry.error.empty() ? name_of(entry.answer.outcome) : "error");
                  }));
  object.add_json("length", json_list_of(row, ",", [](const Entry& entry) {
                    return entry.is_solved() ? json_number(entry.answer.length) : "null";
                  }));
  const auto wrong = std::ranges::find_if(row, [](const Entry& entry) { return !entry.error.empty(); });
  if (wrong != row.end()) object.add("error", std::string_view(wrong->error));
  return object.closed() + "\n";
}

}  // namespace

BatchAccount ask_batch(const RoadmapQuery& query, const InputFile& questions, const BatchOptions& options,
                       const Execution& execution, const std::function<void(std::string_view)>& write) {
  BatchQuestions reader(questions, BatchLines::questions, query.roadmap(), execution);
  Execution one_thread = execution.quiet();
  one_thread.threads = 1;
  BatchAccount account;
  write(!options.csv ? "" : options.lengths_only ? "id,status,length\n" : "id,status,length,verified\n");
  if (!options.lengths_only) query.prepare_paths(execution);
  std::vector<BatchQuestion> some;
  std::vector<QuestionScratch> scratch(thread_count(execution.threads));
  for (QuestionScratch& one : scratch) one.search.tells_separation = false;  // which no line has
  while (reader.next(options.lengths_only ? length_block : path_block, some)) {
    for (const BatchQuestion& question : some) {
      query.expect(question.start, execution);
      query.expect(question.goal, execution);
    }
    std::vector<AnsweredChunk> chunks(scratch.size());
    deal(some.size(), scratch.size(), execution, [&](std::size_t i, std::size_t chunk) {
      add_answer(query, options, some[i], one_thread, scratch[chunk], chunks[chunk]);
    });
    for (const AnsweredChunk& chunk : chunks) {
      write(chunk.text);
      account.solved += chunk.solved;
      account.wrong += chunk.wrong;
    }
    account.questions += some.size();
  }
  return account;
}

MatrixAccount ask_matrix(const RoadmapQuery& query, const InputFile& starts, const InputFile& goals,
                         const BatchOptions& options, const Execution& execution,
                         const std::function<void(std::string_view)>& write) {
  BatchQuestions reader(starts, BatchLines::starts, query.roadmap(), execution);
  const std::vector<BatchQuestion> columns = all_places(goals, query.roadmap(), execution);
  const std::size_t width = columns.size();
  Execution one_thread = execution.quiet();
  one_thread.threads = 1;
  MatrixAccount account{.goals = width};
  std::string header = options.csv ? "id" : "";
  for (const BatchQuestion& goal : columns) {
    account.wrong += goal.error.empty() ? 0 : 1;
    if (options.csv) header.append(",").append(goal.csv_id());
  }
  write(options.csv ? header + "\n" : header);
  std::vector<QuestionScratch> scratch(thread_count(execution.threads));
  std::vector<BatchQuestion> some;
  std::vector<Entry> entries;  // of these starts, row by row
  while (reader.next(std::clamp<std::size_t>(pairs_at_once / std::max<std::size_t>(width, 1), 1, most_starts), some)) {
    execution.reserve(some.size() * width * bytes_of_entry);
    entries.resize(some.size() * width);
    if (width > 0) {
      for (const BatchQuestion& start : some) query.expect(start.start, execution);
      for (const BatchQuestion& goal : columns) query.expect(goal.start, execution);
    }
    deal(entries.size(), scratch.size(), execution, [&](std::size_t i, std::size_t chunk) {
      entries[i] = asked_pair(query, options, some[i / width], columns[i % width], one_thread, scratch[chunk]);
    });
    for (std::size_t i = 0; i < some.size(); ++i) {
      const std::span<const Entry> row = std::span(entries).subspan(i * width, width);
      ++account.starts;
      account.wrong += some[i].error.empty() ? 0 : 1;
      for (std::size_t k = 0; k < width; ++k) {
        const bool is_its_own = some[i].error.empty() && columns[k].error.empty();
        account.wrong += is_its_own && !row[k].error.empty() ? 1 : 0;
        account.solved += row[k].is_solved() ? 1 : 0;
      }
      write(options.csv ? csv_line(some[i], row) : json_line(some[i], row));
    }
  }
  return account;
}

}  // namespace warren
