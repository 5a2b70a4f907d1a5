// SPDX-License-Identifier: BSD-3-Clause
// What a service serves: a world that each question is solved in, or a roadmap that is asked. A large maze becomes a
// roadmap of its lattice when it is opened: its answers are as long and come a thousand times as fast; of several ways
// of one length it may take another.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "apps/serve/graphs/route_graph.hpp"
#include "apps/serve/tiles/world_tiles.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "solve/kinds/kept_ways.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::serve {

/// What one request asks. Without a robot or clearance of its own it has the service's; a roadmap has its own alone.
/// Prices stand beside the service's; masks are its own alone.
struct ServedQuestion : Question {
  bool optimise = false;                    ///< pull the path taut
  std::optional<PlannerKind> planner = {};  ///< none: the usual one; of a roadmap its own alone
  std::optional<double> budget_s = {};      ///< none: the service's
  bool explains = false;  ///< say what would help, too; of the lattices of large mazes nothing is said
};

/// What the latest question over the priced cells of a map has left for the next one with its body and its prices,
/// whatever has changed in the map meanwhile, and its name. nullptr: nothing yet, or somebody has taken it.
using LatestWays = Guarded<std::pair<std::string, std::unique_ptr<KeptWays>>>;

/// Any number of threads may ask.
class ServedWorld {
 public:
  /// body: what moves, and its clearance; start and goal mean nothing. Throws UsageError for arms and for bodies that
  /// can't be planned in this world, InputError, Stopped.
  ServedWorld(Scene scene, const Question& body, const Execution& execution);
  /// The same of a roadmap.
  ServedWorld(Roadmap roadmap, const Execution& execution);

  /// All but the walls, which may be there too.
  const Scene& outline() const { return roadmap_ ? roadmap_->world.outline() : *scene_; }
  const std::string& hash() const { return hash_; }
  const RobotSpec& robot() const { return robot_; }
  double clearance() const { return clearance_; }
  /// What moves, with the service's robot and clearance for none. Throws UsageError for bodies that can't be planned
  /// here, and for others than a roadmap's own.
  Question body_asked(const std::optional<RobotSpec>& robot, const std::optional<double>& clearance) const;
  /// Is this the service's robot, with its clearance?
  bool is_own(const RobotSpec& robot, double clearance) const;
  const WorldTiles& tiles() const { return *tiles_; }
  /// The box of all that there is.
  const Box& box() const { return box_; }
  /// All of it. Throws Stopped, InputError.
  const Scene& whole(const Execution& execution) const { return roadmap_ ? roadmap_->world.whole(execution) : *scene_; }
  /// All of it, and what the file's and the service's words forbid; unknown cells that they open are free. Throws
  /// Stopped, InputError.
  const Scene& barred(const Execution& execution) const { return barred_ ? *barred_ : whole(execution); }
  /// The same for one request. Throws Stopped, InputError.
  Scene copy_of_whole(const Execution& execution) const {
    return roadmap_ ? roadmap_->world.copy_of_whole(execution) : *scene_;
  }
  /// Costs no walls where cells say them. Throws Stopped, InputError.
  std::size_t wall_count(const Execution& execution) const;
  /// Of its body, among all of it. Throws Stopped, InputError.
  const EdgeJudge& judge(const Execution& execution) const;
  /// Least distance between the body in this state and anything, as paths are judged. Throws Stopped, InputError.
  /// other: the judge of another body than the service's.
  double clearance_at(std::span<const double> state, const Execution& execution,
                      const EdgeJudge* other = nullptr) const;
  /// nullptr: each question is solved by itself.
  const RoadmapQuery* query() const { return query_.get(); }
  /// Of a maze's lattice, held against its file's checksums; nullptr where there is none. Throws InputError, Stopped.
  const LatticePassages* passages(const Execution& execution) const;
  /// Was it opened as a roadmap, or else as a world?
  bool is_roadmap() const { return is_roadmap_; }
  /// Is it another one than its source holds?
  bool is_changed() const { return is_changed_; }

  /// Why it is not changed here, whatever the change; empty: ask changed().
  std::string_view why_fixed() const;
  /// The same body and options in another scene: a roadmap is updated. why_fixed() is empty. Throws UsageError where
  /// that can't be done here, InputError, Stopped.
  std::unique_ptr<ServedWorld> changed(Scene now, const Execution& execution) const;
  /// Makes what first questions would wait for. Throws Stopped, InputError.
  void prepare(const Execution& execution) const;
  /// A verified answer, or why there is none; a blocked end is explained. beside_judge: as QuestionScratch has it.
  /// keep: as solve() has it, of questions that are solved by themselves. ways: of this world and those it followed.
  /// Throws UsageError, InputError, Stopped.
  Answer ask(const ServedQuestion& question, const Execution& execution,
             std::function<void(const Answer&)> beside_judge = {}, ByProducts* keep = nullptr,
             LatestWays* ways = nullptr) const;

 private:
  void describe(const Execution& execution);

  Question body_ = {};
  std::unique_ptr<Scene> scene_;  // nullptr where there is a roadmap
  std::optional<Scene> barred_;   // none: as it is
  std::unique_ptr<Roadmap> roadmap_;
  std::unique_ptr<RoadmapQuery> query_;
  std::unique_ptr<WorldTiles> tiles_;
  MadeOnce<EdgeJudge> judge_;
  std::string hash_;
  RobotSpec robot_ = {};
  double clearance_ = 0.0;
  Box box_ = {};
  bool is_roadmap_ = false;
  bool is_changed_ = false;
};

}  // namespace warren::serve
