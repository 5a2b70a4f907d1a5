// SPDX-License-Identifier: BSD-3-Clause
// What an answer tells beyond its summary, in lines for people, and as JSON: its stages, what explains it, notes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/text/human_units.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// Lines of a name and a text, each with its end, as people are told of an answer.
struct AnswerLines {
  const Palette& palette;
  std::string text = {};
  void add(std::string_view name, std::string_view what);
};

/// AnswerLines; empty unless the answer is explained.
std::string explanation_text(const Answer& answer, const Palette& palette);
/// "0.5 of room on leg 1, near 3,4"
std::string text_of(const NarrowPlace& narrow);
/// As JSON; null where there is none.
std::string narrowest_json(const std::optional<NarrowPlace>& narrow);
/// The value of the key "explained".
std::string explanation_json(const Answer& answer);

// What a summary's figures leave open unless somebody says it: samples that were dropped, edges that nobody asked
// about, what an estimate cost, that another option would find the shortest way.

/// AnswerLines; empty where there is nothing to note.
std::string notes_text(const Answer& answer, const Palette& palette);

// The stages of an answer one by one, as lines: what each took, of how many items. Where planners draw samples, these
// are the links of the chain: samples, index, neighbours, checks, rows, components, reduction, queue, verified.

struct StageLine {
  std::string key;    ///< in JSON and CSV, with _cpu the key of its CPU time
  std::string label;  ///< for people
  double wall_s = 0.0;
  double cpu_s = 0.0;
  std::uint64_t count = 0;  ///< of items; 0: not known
  std::string counted;      ///< what they are, and what came of them
  /// CPU nanoseconds an item; 0: not known
  double ns_each() const { return count > 0 ? 1e9 * cpu_s / static_cast<double>(count) : 0.0; }
};

/// In the order of the work. None of an answer that nobody kept account of: one of a kept roadmap, say.
std::vector<StageLine> stage_lines(const Answer& answer);

/// The keys of stages_s: the promised sums, then what each stage has for itself, with _cpu its CPU time.
std::vector<std::pair<std::string, double>> keyed_seconds(const StageTimes& sums, const std::vector<StageCost>& costs);

}  // namespace warren
