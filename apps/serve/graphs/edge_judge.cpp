// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/graphs/edge_judge.hpp"

#include <fmt/format.h>

#include <memory>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/plane/se2.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren::serve {
namespace {

std::vector<Se2> poses_along(const DrawnEdge& edge) {
  const Vec2 way = edge.to.at - edge.from.at;
  const double along = portable::atan2(way.y, way.x);
  std::vector<Se2> path;
  for (const EdgePlace& end : {edge.from, edge.to}) {
    if (end.theta) {
      path.push_back({end.at.x, end.at.y, *end.theta});
    } else {  // all round and back, in legs that can be read one way only
      constexpr int parts = 3;
      for (int i = 0; i <= parts; ++i) {
        path.push_back({end.at.x, end.at.y, along + i * 2.0 * std::numbers::pi / parts});
      }
    }
  }
  return path;
}

EdgeVerdict verdict_of(const Verification& found, double needed) {
  if (found.verified) return {.free = true, .clearance = found.min_clearance};
  EdgeVerdict verdict{.needed = needed};
  if (found.first_violation) {
    verdict.by = found.first_violation->obstacle;
    verdict.distance = found.first_violation->distance;
  }
  return verdict;
}

}  // namespace

void check_drives_edges(const RobotSpec& robot) {
  if (robot.kind == RobotKind::point || robot.kind == RobotKind::disc || robot.kind == RobotKind::polygon) return;
  throw UsageError(robot.kind == RobotKind::car
                       ? "a car drives curves, and the edges of a route graph are straight; serve the world with "
                         "--robot of its body alone"
                       : "route graphs are for bodies of the plane");
}

EdgeJudge::EdgeJudge(const Scene& scene, const Box& room, RobotSpec robot, double clearance)
    : scene_(scene), room_(room), robot_(std::move(robot)), clearance_(clearance) {}

std::vector<EdgeVerdict> EdgeJudge::judge(const std::vector<DrawnEdge>& edges, const Execution& execution) const {
  check_drives_edges(robot_);
  execution.reserve(edges.size() * sizeof(EdgeVerdict));
  const ObstacleIndex* near = edges.empty() ? nullptr : index(execution);
  std::vector<EdgeVerdict> verdicts;
  for (const DrawnEdge& edge : edges) {
    execution.check();
    verdicts.push_back(judge(edge, near, execution));
  }
  return verdicts;
}

const ObstacleIndex* EdgeJudge::index(const Execution& execution) const {
  if (scene_.map) return nullptr;
  return &index_.get(execution, [&] { return std::make_unique<ObstacleIndex>(scene_, execution); });
}

double EdgeJudge::clearance_at(const EdgePlace& place, const Execution& execution) const {
  if (state_size(robot_) > 3) throw UsageError("an arm has no place in the plane");
  if (!robot_.outline.empty()) {
    const Se2 pose{place.at.x, place.at.y, place.theta.value()};
    const PoseVerifyOptions options{.clearance = clearance_};
    return verify_se2(scene_, robot_.outline, {&pose, 1}, options, execution, index(execution)).min_clearance;
  }
  const VerifyOptions options{.radius = robot_.radius, .clearance = clearance_};
  return verify_path(scene_, {&place.at, 1}, options, execution, index(execution)).min_clearance;
}

EdgeVerdict EdgeJudge::judge(const DrawnEdge& edge, const ObstacleIndex* index, const Execution& execution) const {
  for (const EdgePlace& end : {edge.from, edge.to}) {  // judges need not walk to where nothing is
    if (!room_.contains(end.at)) return {.by = fmt::format("{}, {} lies outside of the world", end.at.x, end.at.y)};
  }
  if (robot_.kind == RobotKind::polygon) {
    const PoseVerifyOptions options{.clearance = clearance_};
    return verdict_of(verify_se2(scene_, robot_.outline, poses_along(edge), options, execution, index), clearance_);
  }
  const VerifyOptions options{.radius = robot_.radius, .clearance = clearance_};
  const Vec2 path[] = {edge.from.at, edge.to.at};
  return verdict_of(verify_path(scene_, path, options, execution, index), options.reach());
}

std::string words_of(const EdgeVerdict& verdict) {
  if (verdict.free) return "free";
  if (verdict.needed > 0.0 && verdict.distance > 0.0) {
    return fmt::format("{} is {:.3g} away, and {:.3g} is needed", verdict.by, verdict.distance, verdict.needed);
  }
  return verdict.distance == 0.0 && verdict.by.find("outside") != std::string::npos ? verdict.by
                                                                                    : "it meets " + verdict.by;
}

}  // namespace warren::serve
