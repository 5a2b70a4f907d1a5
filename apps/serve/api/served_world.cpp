// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/served_world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/explain_answer.hpp"
#include "solve/kept/lattice_roadmap.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/solve.hpp"
#include "verify/judges/verify_price.hpp"

namespace warren::serve {
namespace {

void refuse_arms(const RobotSpec& robot) {
  if (state_size(robot) <= 3) return;
  throw UsageError("arms move in space, and this shows a plane; 'warren solve' plans them, 'warren render' draws them");
}

/// Where a roadmap's answers are as long as those of solve(): of a maze's lattice.
bool is_asked_by_roadmap(const Scene& scene, const Question& body, const SolveOptions& options) {
  if (!scene.maze || std::uint64_t{scene.maze->rows} * scene.maze->cols < fewest_indexed_cells) return false;
  try {
    check_buildable(scene, body, options);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

/// Is it answered over the priced cells of a map, and are these few enough to be kept?
bool leaves_ways(const Scene& scene, const Question& asked, const SolveOptions& options) {
  constexpr std::uint64_t most_cells = std::uint64_t{1} << 25U;  // of some 30 bytes each
  return scene.map && scene.map->blocked.size() <= most_cells && !prices_of(scene, asked).empty() &&
         choose_solver(options, scene, asked).planner == PlannerKind::grid;
}

/// own: prices beside the service's.
Answer solve_with_ways(const Scene& scene, const Question& asked, const Prices& own, const SolveOptions& options,
                       const Execution& execution, ByProducts* keep, LatestWays& latest) {
  std::string name =
      fmt::format("{} {} {}", robot_text(*asked.robot), *asked.clearance, fmt::join(price_lines(own), "\n"));
  std::pair<std::string, std::unique_ptr<KeptWays>> ways;  // this question's alone until they are put back
  latest.use([&](auto& those) { those.swap(ways); });
  if (ways.first != name) ways.second.reset();  // before there are new ones
  if (!ways.second) ways = {std::move(name), std::make_unique<KeptWays>()};
  Answer answer = solve_explained(scene, asked, options, execution, keep, nullptr, ways.second.get());
  if (!answer.stop_reason) latest.use([&](auto& those) { those.swap(ways); });  // those before end after the lock
  return answer;
}

}  // namespace

ServedWorld::ServedWorld(Scene scene, const Question& body, const Execution& execution) : body_(body) {
  body.validate();
  robot_ = robot_of(scene, body);
  refuse_arms(robot_);
  check_plannable(scene, body);
  clearance_ = clearance_of(scene, body);
  const SolveOptions as_usual{.planner = PlannerKind::prm};
  const Prices prices = prices_of(scene, body);
  if (prices.empty() && is_asked_by_roadmap(scene, body, as_usual)) {
    roadmap_ = std::make_unique<Roadmap>(build_within(std::move(scene), body, as_usual, execution));
    let_walls_go(*roadmap_, execution);
  } else {
    hash_ = scene_hash(scene, execution);
    barred_ = effective_scene(scene, prices, execution);
    scene_ = std::make_unique<Scene>(std::move(scene));
  }
  describe(execution);
}

ServedWorld::ServedWorld(Roadmap roadmap, const Execution& execution)
    : roadmap_(std::make_unique<Roadmap>(std::move(roadmap))), is_roadmap_(true) {
  refuse_arms(roadmap_->robot);
  robot_ = roadmap_->robot;
  clearance_ = roadmap_->clearance;
  describe(execution);
}

void ServedWorld::describe(const Execution& execution) {
  if (roadmap_) {
    hash_ = roadmap_->world_hash;
    query_ = std::make_unique<RoadmapQuery>(*roadmap_, execution, Questions::many);
  }
  if (roadmap_ && roadmap_->lattice != nullptr && roadmap_->world.is_looked_up()) {
    // Walls stand wherever the lattice has no passage: it says where they are, and nobody makes them.
    const LatticePassages& lattice = *passages(execution);
    tiles_ = maze_tiles({lattice.size(), ArrayOrView(lattice.right_words()), ArrayOrView(lattice.up_words())},
                        MazeOutline::of_course(lattice.size()), execution);
    const MazeHint maze = *roadmap_->world.outline().maze;
    box_ = {{0.5, 0.5}, {maze.cols + 0.5, maze.rows + 0.5}};
    return;
  }
  const Scene& scene = roadmap_ ? roadmap_->world.whole(execution) : *scene_;
  tiles_ = tiles_of(scene, execution);
  box_ = scene.map || scene.walls.size() + scene.polygons.size() > 0 ? obstacle_box(scene, execution) : Box{};
  if (scene.bounds) box_.include(*scene.bounds);
}

std::size_t ServedWorld::wall_count(const Execution& execution) const {
  const KeptCells* cells = roadmap_ ? roadmap_->world.looked_up(execution) : nullptr;
  return cells != nullptr ? cells->wall_count : whole(execution).walls.size();
}

std::string_view ServedWorld::why_fixed() const {
  if (roadmap_ && roadmap_->lattice != nullptr) {
    return "a large maze is asked by its lattice, which is not changed here; 'warren update' does that";
  }
  return {};
}

std::unique_ptr<ServedWorld> ServedWorld::changed(Scene now, const Execution& execution) const {
  auto next = roadmap_ ? std::make_unique<ServedWorld>(update(*roadmap_, std::move(now), execution), execution)
                       : std::make_unique<ServedWorld>(std::move(now), body_, execution);
  next->is_changed_ = true;
  return next;
}

const EdgeJudge& ServedWorld::judge(const Execution& execution) const {
  return judge_.get(execution,
                    [&] { return std::make_unique<EdgeJudge>(barred(execution), box_, robot_, clearance_); });
}

bool ServedWorld::is_own(const RobotSpec& robot, double clearance) const {
  return clearance == clearance_ && robot_text(robot) == robot_text(robot_);
}

Question ServedWorld::body_asked(const std::optional<RobotSpec>& robot, const std::optional<double>& clearance) const {
  Question body = body_;
  body.robot = robot.value_or(robot_);
  body.clearance = clearance.value_or(clearance_);
  if (is_own(*body.robot, *body.clearance)) return body;
  if (is_roadmap_) throw UsageError("a roadmap is of one body; 'warren serve' of its world asks for any");
  body.validate();
  refuse_arms(*body.robot);
  check_plannable(outline(), body);
  return body;
}

double ServedWorld::clearance_at(std::span<const double> state, const Execution& execution,
                                 const EdgeJudge* other) const {
  const Vec2 at{state[0], state[1]};
  if (other == nullptr && roadmap_ && roadmap_->lattice != nullptr) return query_->clearance_at(at, execution);
  const EdgeJudge& asked = other == nullptr ? judge(execution) : *other;
  return asked.clearance_at({at, state.size() > 2 ? std::optional(state[2]) : std::nullopt}, execution);
}

const LatticePassages* ServedWorld::passages(const Execution& execution) const {
  if (!roadmap_ || roadmap_->lattice == nullptr) return nullptr;
  if (const RoadmapFile* file = roadmap_->file.get()) {
    for (const char* name : {"passages.right", "passages.up"}) file->check_section(*file->find(name), execution);
  }
  return &roadmap_->lattice->passages();
}

void ServedWorld::prepare(const Execution& execution) const {
  if (query_) query_->prepare_paths(execution);
}

Answer ServedWorld::ask(const ServedQuestion& question, const Execution& execution,
                        std::function<void(const Answer&)> beside_judge, ByProducts* watched, LatestWays* ways) const {
  ByProducts own;
  ByProducts& made = watched != nullptr ? *watched : own;
  ByProducts* const keep = question.explains ? &made : watched;
  Question asked = body_asked(question.robot, question.clearance);
  if (!is_roadmap_ && !body_.robot) check_headings(outline(), question);
  add_prices(asked.prices, question.prices);
  asked.rule = question.rule;
  asked.route = question.route;
  asked.goal = question.goal;
  const bool is_plain = asked.prices.empty() && rule_of(outline(), asked).empty() && asked.route.empty();
  if (is_roadmap_ && !is_plain) {
    throw UsageError(
        "a roadmap knows no prices beside its own, and no choice of goals or ways; 'warren serve' of its world does");
  }
  if (query_ && is_plain && is_own(*asked.robot, *asked.clearance)) {
    if (question.planner && *question.planner != roadmap_->options.planner) {
      throw UsageError("@planner: the roadmap was built with its own");
    }
    QuestionScratch scratch;
    scratch.beside_judge = std::move(beside_judge);
    const RoadmapSearchFields how{.optimise = question.optimise};
    Answer answer = query_->ask_explained(question.start, question.goal, how, execution, scratch,
                                          question.explains ? &made : nullptr);
    const AskedWith with{.options = roadmap_->options, .samples = roadmap_->samples, .is_kept = true};
    const auto explain = [&] { explain_answer(whole(execution), with, answer, made, execution); };
    if (question.explains && roadmap_->lattice == nullptr) explain_in_time(answer, explain);
    return answer;
  }
  const Scene& scene = whole(execution);
  asked.start = question.start;
  const SolveOptions options{.planner = question.planner, .optimise = question.optimise};
  const bool leaves = ways != nullptr && leaves_ways(scene, asked, options);
  Answer answer = leaves ? solve_with_ways(scene, asked, question.prices, options, execution, keep, *ways)
                         : solve_explained(scene, asked, options, execution, keep);
  const auto explain = [&] {
    make_by_products(scene, asked, options, execution, made);
    explain_answer(scene, {options}, answer, made, execution);
  };
  if (question.explains && answer.outcome != Outcome::stopped) explain_in_time(answer, explain);
  return answer;
}

}  // namespace warren::serve
