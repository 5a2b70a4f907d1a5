// SPDX-License-Identifier: BSD-3-Clause
// Joins CarWorld with the planners that take it: a car, with Dubins or Reeds-Shepp curves or as a differential drive,
// among walls, polygons and bounds, or among the cells of a map. Dubins curves have a direction: their roadmaps are
// planners/roadmap/one_way_prm.hpp's. The answer's path has a pose wherever the steering or the gear changes, and one a
// quarter turn, so each leg is a straight or an arc that its two poses tell wholly.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "planners/grid/motion_lattice.hpp"
#include "planners/shorten/redrive.hpp"
#include "solve/kinds/car_lattice.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "solve/kinds/solve_to_goal.hpp"
#include "solve/question/planner_choice.hpp"
#include "verify/judges/verify_price.hpp"
#include "worlds/poses/car_world.hpp"

namespace warren {
namespace {

/// The file's car, and what the options say otherwise.
PoseProblem car_problem(const Scene& scene, const Question& question, const CarFields& car) {
  PoseProblem problem = pose_problem(scene, question);
  problem.robot.turning_radius = car.turning_radius.value_or(problem.robot.turning_radius);
  problem.robot.steering = car.steering.value_or(problem.robot.steering);
  return problem;
}

struct OverLattice {
  Path<Se2> path;
  LatticeSolution found;
  double cell = 0.0;
  double unit = 0.0;  // of the lattice's cost, in the world's
};

template <class Curve>
class Car : public PoseBody {
 public:
  using World = CarWorld<Curve>;

  explicit Car(const SolveRequest& request)
      : PoseBody(request, car_problem(request.scene, request.question, request.options.car)),
        options_(request.options),
        on_lattice_(request.planner == PlannerKind::grid) {
    if (on_lattice_ && options_.grid.cell && scene_.map)
      throw UsageError("@cell: on a map the grid's positions are the middles of its cells");
    const std::uint32_t headings = options_.grid.headings.value_or(16);
    if (on_lattice_ && headings != 16 && headings != 32) throw UsageError("@headings: a car's lattice has 16 or 32");
    const CarFields& asked = options_.car;
    if (!asked.cusp_cost && !asked.reverse_cost) return;
    const std::string_view option = name_of(asked.cusp_cost ? Option::cusp_cost : Option::reverse_cost);
    if (!options_.optimise && !on_lattice_)
      throw UsageError(fmt::format("@{} prices what @optimise drives: ask for it", option));
    if (Curve::one_way) throw UsageError(fmt::format("@{}: a car with @steering dubins has one gear", option));
    if (Curve::turns_on_spot && !on_lattice_)
      throw UsageError(fmt::format("@{}: of @steering differential grid prices gears alone", option));
  }

  void index(std::optional<World>& world, SamplerKind) const {
    const RobotSpec& robot = problem_.robot;
    const CarOptions options{.turning_radius = robot.turning_radius,
                             .radius = robot.radius,
                             .outline = robot.outline,
                             .clearance = problem_.clearance};
    world.emplace(scene_, options, execution_);
  }
  static double length(const World& world, const Se2& a, const Se2& b) {
    return Curve::turns_on_spot ? norm(b.position() - a.position()) : world.distance(a, b);
  }
  /// Where a tolerance or region lets the path end, of what the lattice joins to the start: the nearest to the goals;
  /// in a region the cheapest.
  std::vector<GoalPlace> places(const World& world, const GoalRule& rule,
                                std::vector<std::vector<double>> goals) const {
    if (!start_stands_free()) return {};
    const CarLatticeOptions options = lattice_options();
    CarLattice lattice(world.body(), scene_, problem_.robot, Curve::shortest, problem_.start, {}, options, execution_);
    double coarse = 0.0;  // half of the widest gap between two headings
    for (std::uint32_t k = 1; k < lattice.headings(); ++k) {
      const double gap = turn_between(lattice.motions().heading_rad(k - 1), lattice.motions().heading_rad(k));
      coarse = std::max(coarse, 0.5 * std::abs(gap));
    }
    GoalPlaces places(std::move(goals), rule, coarse * (1.0 + 1e-9));
    LatticeSearchOptions search;
    search.gear_change = lattice.units_of(options.price.cusp);
    LatticeSearch everywhere(lattice, search, execution_);
    everywhere.run();
    everywhere.for_each_met([&](Cell cell, std::uint32_t heading, std::uint64_t cost) {
      const Se2 pose = lattice.pose_of(cell, heading);
      rule.region ? places.offer(pose, static_cast<double>(cost)) : places.offer(pose);
    });
    return places.taken();
  }
  /// The path of least price over the lattice, near enough; where there is none, one with strokes at an end where the
  /// car can hardly move; empty: nor that.
  Path<Se2> on_lattice(const World& world, std::span<const Se2> goals, Answer& answer) const {
    OverLattice over = over_lattice(world, problem_.start, goals, answer);
    const LatticeSolution& found = over.found;
    answer.figures.push_back({"headings", std::uint64_t{lattice_options().headings}});
    answer.figures.push_back({"cell", over.cell});
    if (!found.found()) {
      if constexpr (has_gears) return by_ways_out(world, goals, answer);
      return {};
    }
    answer.ended_by = found.ended_by == "optimum" ? "lattice" : found.ended_by;  // others may be better
    answer.improvements = found.improvements;
    if (enum_named<StopReason>(found.ended_by)) answer.stop_reason = found.stop_reason;
    const auto bound = static_cast<double>(std::min(found.bound, found.path.cost));
    answer.figures.push_back({"lattice_cost", over.unit * static_cast<double>(found.path.cost)});
    answer.figures.push_back({"lattice_bound", over.unit * bound * (1.0 - 1e-6)});
    const auto cost = static_cast<double>(found.path.cost);
    answer.figures.push_back({"lattice_gap", cost > bound ? cost / bound - 1.0 : 0.0});
    return std::move(over.path);
  }
  /// Along the curve; the same both ways where it is one.
  MotionLength<Se2> price_motions(const World& world) const {
    if (!pose_prices_->is_priced()) return {};
    return [&world, &prices = *pose_prices_](const Se2& a, const Se2& b) {
      const bool is_turned = !Curve::one_way && std::tie(b.x, b.y, b.theta) < std::tie(a.x, a.y, a.theta);
      auto query = world.make_query();
      const SteeringCurve way = is_turned ? world.curve(b, a) : world.curve(a, b);
      const double gone = way.driven();
      const double length = Curve::turns_on_spot ? world.distance(a, b) : gone;  // the metric has turns on the spot
      return length + prices.over(world, gone, query, [&](double t) { return way.at_driven(t * gone); });
    };
  }
  /// Where places have prices by shortcuts that cost less, and not at all where all of it costs more then; else it is
  /// driven with fewer changes of gear, and less of it backwards, as their prices have it.
  Path<Se2> shortened(const World& world, Path<Se2> path, Answer& answer) const {
    if (pose_prices_->is_priced()) {
      Path<Se2> cut = shortcut(world, Path<Se2>(path), price_motions(world), answer);
      return paid(world, cut) < paid(world, path) ? cut : path;
    }
    const auto curve_length = [&](const Se2& a, const Se2& b) { return world.distance(a, b); };
    path = shortcut(world, std::move(path), curve_length, answer);
    if (is_length_alone()) return path;
    return redriven_path(PricedCar(world.body(), price()), std::move(path), {.seed = answer.seed}, execution_,
                         answer.counters);
  }
  void judge(const World& world, const Path<Se2>& path, Answer& answer) const {
    const std::vector<Se2> poses = joints(world, path);
    const StageTimer timer(execution_, "verify", answer.seconds.verify, poses.size());
    const Verification found = pose_judge().judged(poses, verify_options(problem_));
    take_poses(answer, found, poses);
    answer.path_figures.push_back({"steering", std::string(name_of(problem_.robot.steering))});
    answer.path_figures.push_back({"cusps", std::uint64_t{found.cusps}});
    answer.path_figures.push_back({"reversed_length", found.reversed});
    const bool weighs_driving = on_lattice_ || pose_prices_->is_priced();
    if (!weighs_driving) return;
    if (!options_.car.cusp_cost && !options_.car.reverse_cost && !options_.grid.turn_cost) return;
    answer.price = driving(found);
    answer.cost = found.length + answer.price->sum();
    answer.bound_of = "all";
  }
  /// Of how many trees.
  std::size_t paths_weighed() const { return is_length_alone() ? 1 : 4; }
  double price_once_shorter(const World& world, Path<Se2> path, Answer& answer) const {
    const auto curve_length = [&](const Se2& a, const Se2& b) { return length(world, a, b); };
    return PricedCar(world.body(), price()).price(shortcut(world, std::move(path), curve_length, answer));
  }

 private:
  static constexpr bool has_gears = !Curve::one_way && !Curve::turns_on_spot;  // that redriving has words for
  DrivingPrice price() const {
    const double usual_cusp = has_gears ? problem_.robot.turning_radius : 0.0;
    return {options_.car.cusp_cost.value_or(usual_cusp), options_.car.reverse_cost.value_or(1.0)};
  }
  /// Unasked, only what is driven anew has a price: where places have one, nothing is.
  DrivingPrice price_on_lattice() const {
    DrivingPrice on_lattice = price();
    if (!options_.car.cusp_cost && (!options_.optimise || pose_prices_->is_priced())) on_lattice.cusp = 0.0;
    return on_lattice;
  }
  PriceParts driving(const Verification& found) const {
    const DrivingPrice asked = price_on_lattice();
    return {.turning = options_.grid.turn_cost.value_or(0.0) * found.turn_rad,
            .cusps = asked.cusp * static_cast<double>(found.cusps),
            .reverse = (asked.reverse - 1.0) * found.reversed};
  }
  static std::vector<Se2> joints(const World& world, const Path<Se2>& path) {
    std::vector<Se2> poses = {path.front()};
    for (std::size_t i = 1; i < path.size(); ++i) append_joints(poses, world.curve(path[i - 1], path[i]));
    return poses;
  }
  /// As the judge has it.
  double paid(const World& world, const Path<Se2>& path) const {
    const std::vector<Se2> poses = joints(world, path);
    const Verification found = pose_judge().judged(poses, verify_options(problem_));
    const PriceParts price = verify_body_price(scene_, poses, problem_.robot, prices_, execution_);
    return found.length + driving(found).sum() + price.sum();
  }
  CarLatticeOptions lattice_options() const {
    CarLatticeOptions options;
    options.headings = options_.grid.headings.value_or(options.headings);
    options.cell = options_.grid.cell;
    if (!options.cell && scene_.grid) options.cell = scene_.grid->cell;
    options.clearance = problem_.clearance;
    options.price = price_on_lattice();
    // Where turning costs nothing a drive that turns on the spot would turn for nothing.
    options.turn_cost = options_.grid.turn_cost.value_or(Curve::turns_on_spot ? problem_.robot.turning_radius : 0.0);
    if (pose_prices_->is_priced()) options.prices = pose_prices_.get();
    return options;
  }
  OverLattice over_lattice(const World& world, const Se2& start, std::span<const Se2> goals, Answer& answer) const {
    const CarLatticeOptions options = lattice_options();
    std::optional<CarLattice> lattice;
    {
      const StageTimer timer(execution_, "stamps", answer.seconds.index);
      lattice.emplace(world.body(), scene_, problem_.robot, Curve::shortest, start, goals, options, execution_);
    }
    const StageTimer timer(execution_, "search", answer.seconds.search);
    LatticeSearchOptions search;
    search.gear_change = lattice->units_of(options.price.cusp);
    search.gap = options_.anytime.gap.value_or(search.gap);
    search.iterations = options_.anytime.iterations;
    search.unit = lattice->unit();
    search.judge_bytes = judge_bytes(scene_);
    OverLattice over{.path = {},
                     .found = LatticeSearch(*lattice, search, execution_).run(),
                     .cell = lattice->cell(),
                     .unit = search.unit};
    answer.counters.expanded += over.found.expanded;
    answer.counters.edges_checked += over.found.checked;
    answer.counters.edges_free += lattice->free_motions();
    answer.counters.refused += lattice->refused_motions();
    answer.iterations = over.found.rounds;
    if (over.found.found()) over.path = lattice->poses(over.found.path);
    return over;
  }
  Path<Se2> by_ways_out(const World& world, std::span<const Se2> goals, Answer& answer) const {
    constexpr std::size_t most_ends = 16;  // all are goals of one search
    constexpr std::size_t most_starts = 4;
    std::vector<Se2> ends(goals.begin(), goals.end());
    std::vector<Path<Se2>> ways_in;
    std::vector<Path<Se2>> starts;
    {
      const StageTimer timer(execution_, "ways out", answer.seconds.search);
      for (const Se2& goal : goals) {
        for (Path<Se2>& way : ways_out(world.body(), goal, most_ends, execution_)) {
          ends.push_back(way.back());
          std::ranges::reverse(way);
          ways_in.push_back(std::move(way));
        }
      }
      starts = ways_out(world.body(), problem_.start, most_starts, execution_);
    }
    if (!ways_in.empty()) starts.insert(starts.begin(), {problem_.start});
    for (Path<Se2>& path : starts) {
      const OverLattice over = over_lattice(world, path.back(), ends, answer);
      if (!over.found.found()) continue;
      std::uint64_t strokes = path.size() - 1;
      path.insert(path.end(), over.path.begin() + 1, over.path.end());
      if (const std::size_t end = over.found.path.shot.goal; end >= goals.size()) {
        const Path<Se2>& in = ways_in[end - goals.size()];
        path.insert(path.end(), in.begin() + 1, in.end());
        strokes += in.size() - 1;
      }
      answer.figures.push_back({"strokes", strokes});
      return std::move(path);
    }
    return {};
  }
  bool is_length_alone() const { return !has_gears || (price().cusp == 0.0 && price().reverse == 1.0); }

  const SolveOptions& options_;
  bool on_lattice_;
};

constexpr OptionSet shape_options{Option::steering, Option::turning_radius};
constexpr OptionSet curve_options = shape_options | OptionSet{Option::cusp_cost, Option::reverse_cost};
constexpr OptionSet lattice_options{Option::cell,     Option::headings,   Option::turn_cost,
                                    Option::optimise, Option::iterations, Option::gap};
constexpr AskedWords car_words = restriction_words | pose_choice_words;
constexpr PlannerChoice car_planners[] = {
    {PlannerKind::rrt_connect, rrt_connect_options | curve_options, car_words},
    {PlannerKind::rrt, rrt_options | curve_options, car_words},
    {PlannerKind::prm, prm_takes | curve_options, price_words | car_words},
    {PlannerKind::lazy_prm, lazy_prm_takes | curve_options, price_words | car_words},
    {PlannerKind::rrt_star, rrt_star_options | shape_options, car_words},
    {PlannerKind::informed_rrt_star, rrt_star_options | shape_options, car_words},
    {PlannerKind::anytime, anytime_options | shape_options, car_words},
    {PlannerKind::grid, lattice_options | curve_options, price_words | car_words}};

bool fits_car(const Scene&, const RobotSpec& robot) { return robot.kind == RobotKind::car; }

/// What `function` makes with the curve of the way it steers.
template <class Function>
auto by_steering(const SolveRequest& request, const Function& function) {
  const SteeringKind steering = car_problem(request.scene, request.question, request.options.car).robot.steering;
  if (steering == SteeringKind::dubins) return function.template operator()<DubinsCurve>();
  if (steering == SteeringKind::reeds_shepp) return function.template operator()<ReedsSheppCurve>();
  return function.template operator()<DifferentialCurve>();
}

Answer solve_car(const SolveRequest& request) {
  return by_steering(request, [&]<class Curve>() { return solve_sampled<Car<Curve>>(request); });
}

BuiltArrays build_for_car(const SolveRequest& request) {
  return by_steering(request, [&]<class Curve>() { return build_sampled<Car<Curve>>(request); });
}

std::unique_ptr<RoadmapSession> open_for_car(const SolveRequest& request, const RoadmapArrays& arrays,
                                             const ConnectionRule& rule) {
  return by_steering(request, [&]<class Curve>() { return open_sampled<Car<Curve>>(request, arrays, rule); });
}

}  // namespace

std::vector<GoalPlace> places_of_car(const SolveRequest& request) {
  return by_steering(request, [&]<class Curve>() {
    const Car<Curve> car(request);
    std::optional<typename Car<Curve>::World> world;
    car.index(world, SamplerKind::uniform);
    return car.places(*world, rule_of(request.scene, request.question), goals_of(request.scene, request.question));
  });
}

SolveKind car_kind() {
  return {"a car",   fits_car,      car_planners,  usually<PlannerKind::rrt_connect>,
          solve_car, recheck_poses, build_for_car, open_for_car};
}

}  // namespace warren
