// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/ask_batch_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "scenes/files/json_text.hpp"
#include "solve/kept/batch_questions_io.hpp"

namespace warren {
namespace {

// Questions whose answers are held at once: lengths are few bytes, paths may be millions.
constexpr std::size_t path_block = 1024;
constexpr std::size_t length_block = 16384;

std::string path_json(const Answer& answer) {
  std::string text = "[";
  const auto add = [&](std::span<const double> state) {
    if (text.size() > 1) text += ',';
    append_json_list(text, state);
  };
  if (!answer.states.empty()) {
    for (std::size_t i = 0; i < answer.states.size(); ++i) add(answer.states[i]);
  } else {
    for (const Vec2 p : answer.path) add(std::array{p.x, p.y});
  }
  return text + "]";
}

/// One chunk of answers as text.
struct AnsweredChunk {
  std::string text;
  std::uint64_t solved = 0;
  std::uint64_t wrong = 0;
};

class Batch {
 public:
  Batch(const RoadmapQuery& query, const BatchOptions& options, const Execution& execution)
      : query_(query), options_(options), one_thread_(execution) {
    one_thread_.threads = 1;
    one_thread_.progress = nullptr;
  }

  void answer(const BatchQuestion& question, QuestionScratch& scratch, AnsweredChunk& chunk) const {
    std::string error = question.error;
    if (error.empty()) {
      try {
        one_thread_.check();
        if (options_.lengths_only) return add_length(question, scratch, chunk);
        const Answer answer = query_.ask_within(question.start, question.goal, options_.how, one_thread_, scratch);
        if (answer.outcome == Outcome::stopped) throw Stopped(answer.stop_reason.value_or(StopReason::time));
        chunk.solved += answer.outcome == Outcome::solved ? 1 : 0;
        chunk.text += options_.csv ? csv_line(question, answer) : json_line(question, answer);
        return;
      } catch (const UsageError& wrong) {
        error = wrong.what();
      }
    }
    ++chunk.wrong;
    chunk.text += options_.csv ? question.csv_id() + (options_.lengths_only ? ",error,\n" : ",error,,\n")
                               : "{\"id\":" + question.json_id() + ",\"error\":" + json_string(error) + "}\n";
  }
  std::string header() const {
    if (!options_.csv) return {};
    return options_.lengths_only ? "id,status,length\n" : "id,status,length,verified\n";
  }

 private:
  void add_length(const BatchQuestion& question, QuestionScratch& scratch, AnsweredChunk& chunk) const {
    const LengthAnswer answer = query_.length_within(question.start, question.goal, options_.how, one_thread_, scratch);
    const bool solved = answer.outcome == Outcome::solved;
    chunk.solved += solved ? 1 : 0;
    const std::string length = solved ? json_number(answer.length) : options_.csv ? "" : "null";
    const std::string status(name_of(answer.outcome));
    chunk.text += options_.csv
                      ? question.csv_id() + "," + status + "," + length + "\n"
                      : "{\"id\":" + question.json_id() + ",\"status\":\"" + status + "\",\"length\":" + length + "}\n";
  }
  std::string json_line(const BatchQuestion& question, const Answer& answer) const {
    JsonObject object;
    object.add_json("id", question.json_id());
    object.add("status", name_of(answer.outcome));
    object.add_or_null("length", answer.verified, answer.length);
    object.add("verified", answer.verified);
    object.add_json("path", path_json(answer));
    return object.closed() + "\n";
  }
  std::string csv_line(const BatchQuestion& question, const Answer& answer) const {
    std::string line = question.csv_id() + "," + std::string(name_of(answer.outcome)) + ",";
    if (answer.verified) line += json_number(answer.length);
    return line + (answer.verified ? ",true\n" : ",false\n");
  }

  const RoadmapQuery& query_;
  const BatchOptions& options_;
  Execution one_thread_;
};

}  // namespace

BatchAccount ask_batch(const RoadmapQuery& query, const InputFile& questions, const BatchOptions& options,
                       const Execution& execution, const std::function<void(std::string_view)>& write) {
  BatchQuestions reader(questions, BatchLines::questions, query.roadmap(), execution);
  const Batch batch(query, options, execution);
  BatchAccount account;
  write(batch.header());
  if (!options.lengths_only) query.prepare_paths(execution);
  std::vector<BatchQuestion> some;
  std::vector<QuestionScratch> scratch(thread_count(execution.threads));
  for (QuestionScratch& one : scratch) one.search.tells_separation = false;  // which no line has
  while (reader.next(options.lengths_only ? length_block : path_block, some)) {
    for (const BatchQuestion& question : some) {
      query.expect(question.start, execution);
      query.expect(question.goal, execution);
    }
    const std::size_t share = (some.size() + scratch.size() - 1) / scratch.size();
    std::vector<AnsweredChunk> chunks(chunk_count(some.size(), share));
    for_chunks(some.size(), share, execution, [&](Range r) {
      const std::size_t chunk = r.first / share;
      for (std::size_t i = r.first; i < r.last; ++i) batch.answer(some[i], scratch[chunk], chunks[chunk]);
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

namespace {

constexpr std::size_t pairs_at_once = std::size_t{1}
                                      << 14;  // pairs whose lengths are held at once, where a line has fewer
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

/// What is known of one pair.
struct Entry {
  LengthAnswer answer;
  std::string error;  ///< why it can't be asked; empty: it can
};

class Matrix {
 public:
  Matrix(const RoadmapQuery& query, std::vector<BatchQuestion> goals, const BatchOptions& options,
         const Execution& execution)
      : query_(query),
        goals_(std::move(goals)),
        options_(options),
        execution_(execution),
        scratch_(thread_count(execution.threads)) {
    account_.goals = goals_.size();
    for (const BatchQuestion& goal : goals_) account_.wrong += goal.error.empty() ? 0 : 1;
  }
  const MatrixAccount& account() const { return account_; }
  std::size_t starts_at_once() const {
    return std::clamp<std::size_t>(pairs_at_once / std::max<std::size_t>(goals_.size(), 1), 1, most_starts);
  }
  std::string header() const {
    if (!options_.csv) return {};
    std::string text = "id";
    for (const BatchQuestion& goal : goals_) text.append(",").append(goal.csv_id());
    return text + "\n";
  }
  void answer(const std::vector<BatchQuestion>& starts, const std::function<void(std::string_view)>& write);

 private:
  Entry asked(const BatchQuestion& start, const BatchQuestion& goal, const Execution& one_thread,
              QuestionScratch& scratch) const;
  void count(const BatchQuestion& start, std::span<const Entry> row);
  std::string csv_line(const BatchQuestion& start, std::span<const Entry> row) const;
  std::string json_line(const BatchQuestion& start, std::span<const Entry> row) const;

  const RoadmapQuery& query_;
  const std::vector<BatchQuestion> goals_;
  const BatchOptions& options_;
  const Execution& execution_;
  std::vector<QuestionScratch> scratch_;
  std::vector<Entry> entries_;  // of the starts that are being answered, row by row
  MatrixAccount account_;
};

Entry Matrix::asked(const BatchQuestion& start, const BatchQuestion& goal, const Execution& one_thread,
                    QuestionScratch& scratch) const {
  if (!start.error.empty()) return {{}, start.error};
  if (!goal.error.empty()) return {{}, fmt::format("goal {}: {}", goal.id, goal.error)};
  try {
    one_thread.check();
    return {query_.length_within(start.start, goal.start, options_.how, one_thread, scratch), {}};
  } catch (const UsageError& error) {
    return {{}, error.what()};
  }
}

void Matrix::answer(const std::vector<BatchQuestion>& starts, const std::function<void(std::string_view)>& write) {
  const std::size_t pairs = starts.size() * goals_.size();
  execution_.reserve(pairs * bytes_of_entry);
  if (!goals_.empty()) {
    for (const BatchQuestion& start : starts) query_.expect(start.start, execution_);
    for (const BatchQuestion& goal : goals_) query_.expect(goal.start, execution_);
  }
  entries_.resize(pairs);
  Execution one_thread = execution_;
  one_thread.threads = 1;
  one_thread.progress = nullptr;
  const std::size_t share = std::max<std::size_t>(1, (pairs + scratch_.size() - 1) / scratch_.size());
  for_chunks(pairs, share, execution_, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      entries_[i] = asked(starts[i / goals_.size()], goals_[i % goals_.size()], one_thread, scratch_[r.first / share]);
    }
  });
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::span<const Entry> row = std::span(entries_).subspan(i * goals_.size(), goals_.size());
    count(starts[i], row);
    write(options_.csv ? csv_line(starts[i], row) : json_line(starts[i], row));
  }
}

void Matrix::count(const BatchQuestion& start, std::span<const Entry> row) {
  ++account_.starts;
  account_.wrong += start.error.empty() ? 0 : 1;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool is_its_own = start.error.empty() && goals_[i].error.empty();
    account_.wrong += is_its_own && !row[i].error.empty() ? 1 : 0;
    account_.solved += row[i].error.empty() && row[i].answer.outcome == Outcome::solved ? 1 : 0;
  }
}

std::string Matrix::csv_line(const BatchQuestion& start, std::span<const Entry> row) const {
  std::string text = start.csv_id();
  for (const Entry& entry : row) {
    text += ',';
    if (!entry.error.empty()) {
      text += "error";
    } else if (entry.answer.outcome == Outcome::solved) {
      text += json_number(entry.answer.length);
    }
  }
  return text + "\n";
}

/// The row's error is the first of its pairs'.
std::string Matrix::json_line(const BatchQuestion& start, std::span<const Entry> row) const {
  JsonObject object;
  object.add_json("id", start.json_id());
  if (!start.error.empty()) {
    object.add("error", std::string_view(start.error));
    return object.closed() + "\n";
  }
  std::string status;
  std::string length;
  std::string_view error;
  for (const Entry& entry : row) {
    const bool solved = entry.error.empty() && entry.answer.outcome == Outcome::solved;
    if (error.empty()) error = entry.error;
    status.append(status.empty() ? "\"" : ",\"");
    status.append(entry.error.empty() ? name_of(entry.answer.outcome) : "error").append("\"");
    length.append(length.empty() ? "" : ",").append(solved ? json_number(entry.answer.length) : "null");
  }
  object.add_json("status", "[" + status + "]");
  object.add_json("length", "[" + length + "]");
  if (!error.empty()) object.add("error", error);
  return object.closed() + "\n";
}

}  // namespace

MatrixAccount ask_matrix(const RoadmapQuery& query, const InputFile& starts, const InputFile& goals,
                         const BatchOptions& options, const Execution& execution,
                         const std::function<void(std::string_view)>& write) {
  BatchQuestions reader(starts, BatchLines::starts, query.roadmap(), execution);
  Matrix matrix(query, all_places(goals, query.roadmap(), execution), options, execution);
  write(matrix.header());
  std::vector<BatchQuestion> some;
  while (reader.next(matrix.starts_at_once(), some)) matrix.answer(some, write);
  return matrix.account();
}

}  // namespace warren
