// SPDX-License-Identifier: BSD-3-Clause
// A car's world as planners/grid/motion_lattice.hpp searches it: on a map its cells, motions looked up by stamps
// (worlds/poses/motion_set.hpp); among walls and polygons cells of a given size around the start, motions certified
// one by one. Start and goal are any poses, joined to states around them by the car's own curves, which are certified
// against the obstacles. The estimate is the larger of two: a field of steps between cells where the disc around the
// reference point that the body holds fits, and, near a single goal, the length of the car's curve without obstacles.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/base/whole.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "planners/grid/motion_lattice.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "spatial/maps/free_cells.hpp"
#include "worlds/poses/car_world.hpp"
#include "worlds/poses/motion_set.hpp"

namespace warren {

struct CarLatticeOptions {
  std::uint32_t headings = 16;         ///< 16 or 32
  std::optional<double> cell;          ///< distance of states, > 0; none: the usual one; a map has its own
  double clearance = 0.0;              ///< room around the body; >= 0
  DrivingPrice price;                  ///< of gears
  double turn_cost = 0.0;              ///< of a radian, in units of length; >= 0
  const PosePrices* prices = nullptr;  ///< of places; nullptr: all cost their length
};

/// Refers to body and execution. One search at a time.
class CarLattice {
 public:
  using ShortestWord = SteeringWord (*)(const Se2& a, const Se2& b, double turning_radius) noexcept;

  /// body: of this robot in this scene. goals: poses any of which will do, at least one. Throws UsageError where the
  /// world has more cells of that size than are searched, and Stopped.
  CarLattice(const CarBody& body, const Scene& scene, const RobotSpec& robot, ShortestWord shortest, const Se2& start,
             std::span<const Se2> goals, const CarLatticeOptions& options, const Execution& execution)
      : body_(body),
        execution_(execution),
        shortest_(shortest),
        radius_(robot.turning_radius),
        start_(start),
        goals_(goals.begin(), goals.end()),
        cell_(cell_of(scene, box_of(body, start), start, robot.turning_radius, options)),
        motions_({.headings = options.headings,
                  .turning_radius = robot.turning_radius / cell_,
                  .reverses = robot.steering != SteeringKind::dubins,
                  .turns_on_spot = robot.steering == SteeringKind::differential,
                  .reverse_cost = options.price.reverse,
                  .turn_cost = options.turn_cost / cell_},
                 execution),
        query_(body.make_query()),
        prices_(options.prices) {
    lay_out(scene, start);
    if (prices_ != nullptr) {
      const std::size_t states = std::size_t{width_} * height_ * headings();
      execution.reserve(states * sizeof(float));
      assign_polled(dear_, states, -1.0F, [&] { execution.check(); });
    }
    const double disc = held_radius(robot).value_or(0.0) + options.clearance - MotionSet::slack * cell_;
    if (scene.map) {
      if (disc > 0.0) no_middle_ = blocked_for_disc(scene.map->blocked, disc / cell_ * (1.0 - 1e-9), execution);
      index_map(*scene.map, robot, options.clearance);
    } else if (disc > 0.0) {
      disc_.emplace(scene, CarOptions{.turning_radius = radius_, .radius = disc * (1.0 - 1e-6)}, execution);
      disc_query_ = disc_->make_query();
    }
    join_reach_ = 2.0 * motions_.turning_radius() + 2.0;
    for (const Se2& goal : goals_) goal_cells_.push_back(in_cells(goal));
    const auto fits = [this](Cell cell) {
      if (no_middle_) return !no_middle_->test(cell.x, cell.y);
      return !disc_ || disc_->clearance(pose_of(cell, 0), 0.0, *disc_query_) > 0.0;
    };
    field_.emplace(width_, height_, motions_.relaxed_ratio(), fits, execution);
    seed_field();
    join_start(start);
  }

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint32_t headings() const { return motions_.headings(); }
  std::span<const LatticeMotion> motions_from(std::uint32_t heading) const { return motions_.from(heading); }
  bool is_free(Cell from, const LatticeMotion& motion) {
    const bool free = stamps_ ? stamps_->is_free(*free_, from, motion) : is_free_curve(from, motion);
    free_motions_ += free ? 1 : 0;
    return free;
  }
  /// What places make dear: nearness by the mean of both ends, areas by places a quarter of a cell apart.
  std::uint64_t extra(Cell from, std::uint32_t heading, const LatticeMotion& motion) {
    if (prices_ == nullptr) return 0;
    const Cell to = end_of(from, motion);
    const double length = radius_ * motion.word.driven();
    double dear = 0.5 * (dear_at(from, heading) + dear_at(to, motion.to));
    if (prices_->has_areas()) {  // they have borders, between which a motion would slip through
      const SteeringCurve way{pose_of(from, heading), pose_of(to, motion.to), motion.word, radius_};
      const double count = std::ceil(4.0 * length / cell_);
      for (double i = 0.5; i < count; ++i)
        dear += prices_->area_at(way.at_driven(i / count * length).position()) / count;
    }
    return units_of(length * dear);
  }
  std::uint64_t at_least(Cell cell, std::uint32_t heading) {
    constexpr double finest = CellField::unit / MotionSet::cost_unit;
    constexpr double near = 6.0;  // turning radii: farther away the estimate is that far, whatever the curve
    if (goals_.empty()) return 0;
    const std::uint32_t steps = field_->at(cell);
    if (steps == CellField::never) return LatticeSearch<CarLattice>::no_way;
    const std::uint64_t by_steps = steps * static_cast<std::uint64_t>(finest);
    if (goals_.size() != 1) return by_steps;
    const double most = near * motions_.turning_radius();
    double cells = most;
    if (distance(Vec2{1.0 * cell.x, 1.0 * cell.y}, goal_cells_.front()) < most) {
      const SteeringWord word = shortest_(pose_of(cell, heading), goals_.front(), radius_);
      cells = std::min(most, word.driven() * motions_.turning_radius());
    }
    const auto by_curve = static_cast<std::uint64_t>(cells * (1.0 - 1e-6) / MotionSet::cost_unit);
    return std::max(by_steps, by_curve);
  }
  std::span<const LatticeStart> starts() const { return starts_; }
  bool is_free_start(std::size_t number) {
    const LatticeStart& start = starts_[number];
    return body_.is_free_curve(curve(start_, pose_of(start.cell, start.heading)), query_);
  }
  bool joins(Cell cell) const {
    return std::ranges::any_of(goal_cells_, [&](Vec2 goal) {
      return distance(Vec2{1.0 * cell.x, 1.0 * cell.y}, goal) <= join_reach_;
    });
  }
  /// So many states are expanded between two shots.
  std::uint64_t shot_pause(std::uint64_t at_least) const {
    return static_cast<std::uint64_t>(static_cast<double>(at_least) * MotionSet::cost_unit / motions_.turning_radius());
  }
  std::optional<LatticeShot> shot(Cell cell, std::uint32_t heading, std::int8_t gear, std::uint64_t most,
                                  std::uint64_t gear_change) {
    return shot_from(pose_of(cell, heading), gear, most, gear_change);
  }
  std::optional<LatticeShot> direct_shot(std::uint64_t most, std::uint64_t gear_change) {
    return shot_from(start_, 0, most, gear_change);
  }

  /// Of a unit of cost, in the world's.
  double unit() const { return cell_ * MotionSet::cost_unit; }
  std::uint64_t units_of(double length) const { return static_cast<std::uint64_t>(std::llround(length / unit())); }
  double cell() const { return cell_; }
  const MotionSet& motions() const { return motions_; }
  Se2 pose_of(Cell cell, std::uint32_t heading) const {
    const Vec2 in_frame{cell_ * cell.x, cell_ * cell.y};
    const Vec2 p = origin_ + (yaw_rad_ == 0.0 ? in_frame : Rotation(yaw_rad_)(in_frame));
    return {p.x, p.y, wrapped_angle(motions_.heading_rad(heading) + yaw_rad_)};
  }
  /// Every leg is a straight or an arc of at most a quarter turn.
  Path<Se2> poses(const LatticePath& path) const {
    std::vector<Se2> poses{start_};
    const auto is_there = [&](const Se2& pose) {
      return distance(poses.back().position(), pose.position()) <= exactly * cell_ &&
             std::abs(turn_between(poses.back().theta, pose.theta)) <= exactly;
    };
    const auto drive = [&](const SteeringCurve& way) {
      if (!is_there(way.joint(way.piece_count()))) append_joints(poses, way);
    };
    if (path.is_direct) {
      drive(curve(start_, goals_[path.shot.goal]));
      return {poses.begin(), poses.end()};
    }
    const LatticeStep& first = path.steps.empty() ? path.last : path.steps.front();
    drive(curve(start_, pose_of(first.cell, first.heading)));
    for (std::size_t i = 0; i < path.steps.size(); ++i) {
      const LatticeStep& next = i + 1 < path.steps.size() ? path.steps[i + 1] : path.last;
      const LatticeMotion& motion = motions_.from(path.steps[i].heading)[path.steps[i].motion];
      drive(
          {pose_of(path.steps[i].cell, path.steps[i].heading), pose_of(next.cell, next.heading), motion.word, radius_});
    }
    drive(curve(poses.back(), goals_[path.shot.goal]));
    // Straights that follow each other are one.
    Path<Se2> fewer;
    for (const Se2& pose : poses) {
      const auto goes_on = [&](const Se2& a, const Se2& b) {
        return std::abs(turn_between(a.theta, b.theta)) <= 1e-12 &&
               std::abs(turn_between(b.theta, pose.theta)) <= 1e-12 &&
               dot(b.position() - a.position(), pose.position() - b.position()) > 0.0;
      };
      while (fewer.size() > 1 && goes_on(fewer[fewer.size() - 2], fewer.back())) fewer.pop_back();
      fewer.push_back(pose);
    }
    return fewer;
  }
  /// Of the motions that were asked about.
  std::uint64_t free_motions() const { return free_motions_; }
  std::uint64_t refused_motions() const { return refused_motions_; }

 private:
  bool is_free_curve(Cell from, const LatticeMotion& motion) {
    const Se2 end = pose_of(end_of(from, motion), motion.to);
    Se2 begin = pose_of(from, 0);
    double turn = 0.0;
    for (const SteeringPiece& piece : motion.word.used()) turn += side_of(piece.steer) * piece.length;
    begin.theta = wrapped_angle(end.theta - turn);
    const std::uint64_t before = query_.refused;
    const bool free = body_.is_free_curve({begin, end, motion.word, radius_}, query_);
    refused_motions_ += query_.refused - before;
    return free;
  }
  static Cell end_of(Cell from, const LatticeMotion& motion) {
    return {static_cast<std::uint32_t>(std::int64_t{from.x} + motion.dx),
            static_cast<std::uint32_t>(std::int64_t{from.y} + motion.dy)};
  }
  static constexpr double exactly = 1e-10;  // cells and radians: what is so near to a state is it
  static Box box_of(const CarBody& body, const Se2& start) {
    Box box = body.box();
    box.include(start.position());
    return box;
  }
  /// Cells on two sides of the start, and in all.
  struct Extent {
    double left, below, wide, high;
  };
  static Extent extent_of(const Box& box, const Se2& start, double cell) {
    const auto cells = [&](double length) { return std::ceil(length / cell) + 1.0; };
    const double left = cells(start.x - box.min.x);
    const double below = cells(start.y - box.min.y);
    return {left, below, left + cells(box.max.x - start.x) + 1.0, below + cells(box.max.y - start.y) + 1.0};
  }
  /// Throws UsageError before any motion is made of cells that are too many.
  static double cell_of(const Scene& scene, const Box& box, const Se2& start, double turning_radius,
                        const CarLatticeOptions& options) {
    constexpr double share = 0.125;
    constexpr double cells_a_side = 2000.0;
    const double usual = std::max(share * turning_radius, std::max(box.width(), box.height()) / cells_a_side);
    if (scene.map) return scene.map->cell;
    const double cell = options.cell.value_or(usual);
    const Extent extent = extent_of(box, start, cell);
    constexpr double most = 1e8;
    if (extent.wide * extent.high <= most) return cell;
    throw UsageError(
        fmt::format("@cell: {} is too small: the world has {:.6g} x {:.6g} such cells, and {:.0e} are the "
                    "most that a lattice of a car has",
                    cell, extent.wide, extent.high, most));
  }
  /// Of the last piece that is driven; a curve of none ends forwards.
  static std::int8_t last_gear(const SteeringWord& word) {
    std::int8_t gear = 1;
    for (const SteeringPiece& piece : word.used()) {
      if (!is_on_spot(piece.steer)) gear = piece.length >= 0.0 ? 1 : -1;
    }
    return gear;
  }
  /// The middle of cell (0, 0) is (0, 0).
  Vec2 in_cells(const Se2& pose) const { return (1.0 / cell_) * Rotation(-yaw_rad_)(pose.position() - origin_); }
  SteeringCurve curve(const Se2& a, const Se2& b) const { return {a, b, shortest_(a, b, radius_), radius_}; }
  /// Among walls and polygons the start is in the middle of a cell, so that what lies far from the origin is planned as
  /// it would be near; one cell lies beyond the box all around.
  void lay_out(const Scene& scene, const Se2& start) {
    if (scene.map) {
      width_ = scene.map->width();
      height_ = scene.map->height();
      yaw_rad_ = scene.map->yaw_rad;
      origin_ = scene.map->origin + Rotation(yaw_rad_)(Vec2{0.5 * cell_, 0.5 * cell_});
      return;
    }
    const Extent extent = extent_of(box_of(body_, start), start, cell_);
    width_ = static_cast<std::uint32_t>(extent.wide);
    height_ = static_cast<std::uint32_t>(extent.high);
    origin_ = start.position() - cell_ * Vec2{extent.left, extent.below};
  }
  /// Planning keeps beyond the clearance what worlds/poses/car_world keeps, and what coordinates are rounded by.
  void index_map(const OccupancyMap& map, const RobotSpec& robot, double clearance) {
    constexpr double more = 1e-9;
    constexpr double ulps = 16.0 * std::numeric_limits<double>::epsilon();
    const double farthest = std::abs(map.origin.x) + std::abs(map.origin.y) + cell_ * (1.0 * width_ + height_);
    const double reach = (clearance + robot.radius) * (1.0 + more) + more * radius_ + ulps * farthest;
    std::vector<Vec2> outline;
    for (const Vec2 p : robot.outline) outline.push_back((1.0 / cell_) * p);
    if (outline.empty()) outline.push_back({});
    free_.emplace(map.blocked);
    stamps_.emplace(motions_, outline, reach / cell_, execution_);
  }
  /// From these cells a goal is joined: by a way no shorter than straight on.
  void seed_field() {
    for (const Vec2 goal : goal_cells_) {
      const auto within = [](double x, std::uint32_t end) { return bounded_whole<std::uint32_t>(x, 0.0, end); };
      const std::uint32_t top = within(goal.y + join_reach_ + 1.0, height_);
      const std::uint32_t right = within(goal.x + join_reach_ + 1.0, width_);
      for (std::uint32_t y = within(goal.y - join_reach_, height_); y < top; ++y) {
        execution_.check();
        for (std::uint32_t x = within(goal.x - join_reach_, width_); x < right; ++x) {
          const double apart = distance(Vec2{1.0 * x, 1.0 * y}, goal);
          if (apart <= join_reach_) field_->seed({x, y}, apart * (1.0 - 1e-9));
        }
      }
    }
  }
  /// A start on the lattice is its state. Any other is joined to states in a disc around it, up to a quarter turn away.
  void join_start(const Se2& start) {
    constexpr double cells_tried = 120.0;
    constexpr std::uint64_t far = 3;  // turning radii that a join takes
    const Vec2 at = in_cells(start);
    const double heading = start.theta - yaw_rad_;
    const std::uint32_t nearest = motions_.nearest_heading(heading);
    const Vec2 middle{std::round(at.x), std::round(at.y)};
    const auto is_inside = [&](double x, double y) { return x >= 0.0 && y >= 0.0 && x < width_ && y < height_; };
    const auto cell_at = [](double x, double y) {
      return Cell{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
    };
    if (is_inside(middle.x, middle.y) && distance(at, middle) <= exactly &&
        std::abs(turn_between(heading, motions_.heading_rad(nearest))) <= exactly) {
      starts_.push_back({cell_at(middle.x, middle.y), nearest, 0, 0});
      return;
    }
    const double reach = 2.0 * motions_.turning_radius() + 1.5;
    const double stride = std::max(1.0, std::floor(reach * std::sqrt(std::numbers::pi / cells_tried)));
    const std::uint64_t most = units_of(far * radius_ + 4.0 * cell_);
    const std::uint32_t quarter = headings() / 4;
    for (double y = middle.y - stride * std::floor(reach / stride); y <= at.y + reach; y += stride) {
      for (double x = middle.x - stride * std::floor(reach / stride); x <= at.x + reach; x += stride) {
        if (!is_inside(x, y) || distance({x, y}, at) > reach) continue;
        execution_.check();
        for (std::uint32_t i = 0; i <= 2 * quarter; ++i) {
          const std::uint32_t k = (nearest + headings() - quarter + i) % headings();
          const Cell cell = cell_at(x, y);
          const SteeringWord word = shortest_(start, pose_of(cell, k), radius_);
          const std::uint64_t cost = motions_.cost_of(word);
          const std::int8_t gear = last_gear(word);
          if (cost > most) continue;
          starts_.push_back({cell, k, cost + extra(curve(start, pose_of(cell, k))), gear});
        }
      }
    }
  }
  double dear_at(Cell cell, std::uint32_t heading) {
    float& dear = dear_[(std::size_t{cell.y} * width_ + cell.x) * headings() + heading];
    if (dear < 0.0F) dear = static_cast<float>(prices_->nearness_at(body_, pose_of(cell, heading), query_));
    return dear;
  }
  std::uint64_t extra(const SteeringCurve& way) {
    if (prices_ == nullptr) return 0;
    const double length = way.driven();
    return units_of(prices_->over(body_, length, query_, [&](double t) { return way.at_driven(t * length); }));
  }
  std::uint64_t curve_cost(const SteeringWord& word, std::uint64_t gear_change, LatticeShot& shot) const {
    std::uint64_t cost = motions_.cost_of(word);
    std::int8_t gear = 0;
    for (const SteeringPiece& piece : word.used()) {
      if (std::abs(piece.length) < SteeringCurve::nothing || is_on_spot(piece.steer)) continue;
      const std::int8_t next = piece.length < 0.0 ? -1 : 1;
      if (gear == 0) shot.first_gear = next;
      if (gear == -next) cost += gear_change;
      gear = next;
    }
    return cost;
  }
  std::optional<LatticeShot> shot_from(const Se2& from, std::int8_t gear, std::uint64_t most,
                                       std::uint64_t gear_change) {
    std::optional<LatticeShot> best;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      const SteeringWord word = shortest_(from, goals_[i], radius_);
      LatticeShot found{.goal = i};
      found.cost = curve_cost(word, gear_change, found);
      if (gear != 0 && found.first_gear == -gear) found.cost += gear_change;
      const SteeringCurve way{from, goals_[i], word, radius_};
      if (found.cost >= most || !body_.is_free_curve(way, query_)) continue;
      found.cost += extra(way);
      if (found.cost >= most) continue;
      most = found.cost;
      best = found;
    }
    return best;
  }

  const CarBody& body_;
  const Execution& execution_;
  ShortestWord shortest_;
  double radius_;  // of turning
  Se2 start_;
  std::vector<Se2> goals_;
  std::vector<Vec2> goal_cells_;
  double cell_ = 1.0;
  Vec2 origin_;  // of the middle of cell (0, 0)
  double yaw_rad_ = 0.0;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  MotionSet motions_;
  CarBody::Query query_;
  std::uint64_t free_motions_ = 0;
  std::uint64_t refused_motions_ = 0;
  const PosePrices* prices_;
  RawVector<float> dear_;              // what nearness costs at states, a unit of length; below 0: nobody has asked
  std::optional<FreeCells> free_;      // maps
  std::optional<SweptStamps> stamps_;  // maps
  std::optional<Bitmap> no_middle_;    // maps: where the disc does not fit
  std::optional<CarBody> disc_;        // among walls and polygons: the disc
  std::optional<CarBody::Query> disc_query_;
  std::optional<CellField> field_;
  double join_reach_ = 0.0;  // in cells
  std::vector<LatticeStart> starts_;
};

}  // namespace warren
