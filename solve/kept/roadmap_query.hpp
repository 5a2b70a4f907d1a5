// SPDX-License-Identifier: BSD-3-Clause
// Questions to a roadmap: from where to where. An answer is that of solve() with the roadmap's own options, verified as
// that is; what it takes is two neighbour queries, one search and the judge. Made once a roadmap: the world's index and
// that of the states.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "core/run/execution.hpp"
#include "planners/lengths/route_index.hpp"
#include "planners/roadmap/ask_roadmap.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/limits.hpp"

namespace warren {

/// What a question may say beside its ends: asked_options. All others are the roadmap's, whatever is said here.
using RoadmapSearchFields = SolveOptions;

/// What one thread keeps from one question to the next.
struct QuestionScratch {
  AskScratch search;                ///< of searches
  std::optional<RouteQuery> route;  ///< of a lattice's index
  /// Called with the answer while the judge looks at its path, where that pays; what it makes means nothing unless the
  /// answer comes out verified. May be empty.
  std::function<void(const Answer&)> beside_judge = {};
};

/// How long the shortest way of the roadmap is.
struct LengthAnswer {
  Outcome outcome = Outcome::not_connected;  ///< how it ended
  double length = 0.0;                       ///< only for solved
};

/// What will be asked: one path, whose judge then passes over all obstacles; many paths, for which the judge makes bits
/// or an index of its own first. Where a lattice's file says its walls, the judge looks them up there.
enum class Questions : std::uint8_t { one, many };

/// Refers to the roadmap. Any number of threads may ask; while they do, learnt() is nobody's.
class RoadmapQuery : NotCopied {
 public:
  /// Makes what paths need, within the limits. Throws UsageError, InputError, Stopped.
  explicit RoadmapQuery(const Roadmap& roadmap, const Limits& limits = {});
  /// The same under an execution, for what will be asked.
  RoadmapQuery(const Roadmap& roadmap, const Execution& execution, Questions questions = Questions::many);
  ~RoadmapQuery();

  /// Start and goal as Question has them: 2 or 3 numbers, of an arm one a joint; empty: the world file's. Says where
  /// a blocked end is free, and what an estimate cost, too. Throws UsageError, InputError for a world that is not what
  /// its file promises.
  Answer ask(const std::vector<double>& start, const std::vector<double>& goal, const RoadmapSearchFields& how = {},
             const Limits& limits = {}, ByProducts* keep = nullptr) const;
  /// The same under an execution, with a scratch that the thread keeps from one question to the next.
  Answer ask_explained(const std::vector<double>& start, const std::vector<double>& goal,
                       const RoadmapSearchFields& how, const Execution& execution, QuestionScratch& scratch,
                       ByProducts* keep = nullptr) const;
  /// The answer alone: nothing is said of where a blocked end is free, nor of what an estimate cost.
  Answer ask_within(const std::vector<double>& start, const std::vector<double>& goal, const RoadmapSearchFields& how,
                    const Execution& execution, QuestionScratch& scratch, ByProducts* keep = nullptr) const;
  /// The same without the path where an index tells the length alone. Throws UsageError, Stopped.
  LengthAnswer length_within(const std::vector<double>& start, const std::vector<double>& goal,
                             const RoadmapSearchFields& how, const Execution& execution,
                             QuestionScratch& scratch) const;
  /// Makes what the judge of many paths needs, on all threads; else the first path's thread does it alone. Throws
  /// InputError, Stopped.
  void prepare_paths(const Execution& execution) const;
  /// A question from or to there will follow: what many such ends need is then made on all threads; else the thread of
  /// a question does it alone. Throws InputError, Stopped.
  void expect(const std::vector<double>& place, const Execution& execution) const;
  /// Least distance between the body at a place of a lattice and any wall, by the judge of its paths. Throws Stopped,
  /// InputError.
  double clearance_at(Vec2 place, const Execution& execution) const;
  /// That it refers to.
  const Roadmap& roadmap() const { return roadmap_; }
  /// Length of the motion between two of the roadmap's states, in the world's metric.
  double distance(VertexId from, VertexId to) const;
  /// What all questions so far have learnt of the edges of a lazy roadmap.
  std::span<const std::uint64_t> edge_states() const;

 private:
  struct Opened;
  struct Walls;
  const Roadmap& roadmap_;
  std::unique_ptr<Opened> opened_;  // nullptr for a lattice
  std::unique_ptr<Walls> walls_;    // nullptr but for a lattice
};

/// Takes over what the questions to a roadmap have learnt of its edges. Throws Stopped.
void learn(Roadmap& roadmap, const RoadmapQuery& query, const Execution& execution);

// Why a body does not fit where it shall start or end, in the world of a roadmap: where that is a large maze whose
// walls can be looked up, they are not made for it.

/// As explain_blocked_end() of a scene. Throws InputError for a world that is not what its file promises.
void explain_blocked_end(const Roadmap& roadmap, Answer& answer, const Execution& execution);

}  // namespace warren
