// SPDX-License-Identifier: BSD-3-Clause
#include "solve/batches/ask_batch_io.hpp"

#include <array>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "scenes/text/json_text.hpp"
#include "solve/batches/batch_questions_io.hpp"

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

}  // namespace warren
