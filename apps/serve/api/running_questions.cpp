// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/running_questions.hpp"

#include <algorithm>
#include <utility>

#include "apps/serve/api/request_bodies_io.hpp"
#include "scenes/text/json_text.hpp"

namespace warren::serve {

RunningQuestions::Entry::Entry(RunningQuestions& all, std::string name)
    : all_(all), name_(std::move(name)), is_seen_(!name_.empty() && all_.questions_.use([this](auto& questions) {
        return questions.try_emplace(name_).second;
      })) {}

RunningQuestions::Entry::~Entry() {
  if (is_seen_) all_.questions_.use([this](auto& questions) { questions.erase(name_); });
}

void RunningQuestions::Entry::tell(const Improvement& improvement, std::vector<Vec2> way) {
  if (!is_seen_) return;
  if (way.size() > most_points) way.clear();
  all_.questions_.use([&](auto& questions) {
    Question& question = questions.at(name_);
    question.told.push_back({improvement, std::move(way)});
    if (question.told.size() <= most_told) return;
    question.told.pop_front();
    ++question.first;
  });
}

std::string RunningQuestions::told(const std::string& name, std::uint64_t from) const {
  std::vector<Told> fresh;
  std::uint64_t first = from;
  const bool is_running = questions_.use([&](const auto& questions) {
    const auto found = questions.find(name);
    if (found == questions.end()) return false;
    const Question& question = found->second;
    first = std::max(from, question.first);
    std::size_t points = 0;  // written on the thread of all connections: who is told only some of them asks again
    for (std::uint64_t i = first - question.first; i < question.told.size() && points < most_points_told; ++i) {
      fresh.push_back(question.told[i]);
      points += question.told[i].way.size();
    }
    return true;
  });
  if (!is_running) return "{\"running\":false}";
  std::string list;
  for (const Told& one : fresh) {
    JsonObject json;
    json.add("iterations", one.improvement.iterations);
    json.add("seconds", one.improvement.seconds);
    json.add("length", one.improvement.length);
    json.add("cost", one.improvement.cost);
    json.add("by", std::string_view(one.improvement.by));
    json.add_or_null("lower_bound", one.improvement.lower_bound > 0.0, one.improvement.lower_bound);
    json.add_json("chains", json_chains({one.way}, {}));
    list += (list.empty() ? "" : ", ") + json.closed();
  }
  JsonObject json;
  json.add("running", true);
  json.add("first", first);
  json.add_json("improvements", "[" + list + "]");
  return json.closed();
}

}  // namespace warren::serve
