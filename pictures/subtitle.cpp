// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/subtitle.hpp"

#include <fmt/format.h>

#include "scenes/scene/unit_of.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/answer/world_account.hpp"

namespace warren {
namespace {

/// Words apart by commas.
class Words {
 public:
  void add(std::string_view word) {
    if (word.empty()) return;
    if (!text_.empty()) text_ += ", ";
    text_ += word;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string body_text(const RobotSpec& robot, std::string_view metres) {
  switch (robot.kind) {
    case RobotKind::point:
      return "a point";
    case RobotKind::polygon:
      return fmt::format("a body of {} corners", robot.outline.size());
    case RobotKind::car:
      return fmt::format("a car, turning radius {}{}", human_number(robot.turning_radius), metres);
    case RobotKind::disc:
      return fmt::format("a disc of radius {}{}", human_number(robot.radius), metres);
    default:
      return fmt::format("{}, links of radius {}", name_of(robot.kind), human_number(robot.radius));
  }
}

std::string outcome_text(const Answer& answer, std::string_view metres) {
  if (answer.refuted) return fmt::format("refuted, length {}{}", human_number(answer.refuted->length), metres);
  if (!answer.verified) return std::string(name_of(answer.outcome));
  return fmt::format("length {}{}{}, clearance {}{}", human_number(answer.length), metres,
                     answer.optimal ? " (the shortest)" : "", human_number(answer.min_clearance), metres);
}

}  // namespace

std::string title_of(const Scene& scene) { return scene.source.substr(scene.source.rfind('/') + 1); }

std::string subtitle_of(const Scene& scene, const RobotSpec& robot) {
  return description_of(scene) + "; " + body_text(robot, metres_behind(unit_of(scene)));
}

std::string subtitle_of(const Scene& scene, const Answer& answer) {
  Words words;
  words.add(answer.planner);
  words.add(answer.sampler);
  words.add(answer.search);
  if (answer.roadmap.samples > 0) words.add(counted(answer.roadmap.samples, "sample", "samples"));
  if (answer.roadmap.milestones > 0) words.add(counted(answer.roadmap.milestones, "milestone", "milestones"));
  words.add(outcome_text(answer, metres_behind(unit_of(scene))));
  if (!answer.sampler.empty()) words.add(fmt::format("seed {}", answer.seed));
  return subtitle_of(scene, answer.problem.robot) + "\n" + words.take();
}

std::string subtitle_of(const Scene& scene, const RecordedAnswer& answer) {
  const std::string world = subtitle_of(scene, robot_of(scene, answer.problem));
  return answer.length
             ? fmt::format("{}\nlength {}{}", world, human_number(*answer.length), metres_behind(unit_of(scene)))
             : world;
}

}  // namespace warren
