// SPDX-License-Identifier: BSD-3-Clause
#include "solve/paths/path_file_io.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <string_view>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/text/json_text.hpp"
#include "solve/question/question_of_arm.hpp"

namespace warren {
namespace {

struct Row : PathMoment {
  PathState state;
  double along = 0.0;
};

class Rows {
 public:
  Rows(const PathLegs& legs, const PathFileOptions& options, const Execution& execution)
      : legs_(legs), options_(options), execution_(execution) {
    if (options.limits) timed_.emplace(legs, *options.limits, execution);
    check_count();
  }

  std::optional<double> duration_s() const { return timed_ ? std::optional(timed_->duration_s()) : std::nullopt; }
  std::uint64_t visit(const std::function<void(const Row&)>& row) {
    visit_ = &row;
    written_ = 0;
    leg_ = 0;
    turned_ = {};
    options_.every_s ? by_time() : by_way();
    return written_;
  }

 private:
  /// Arcs are joined by straight lines where they are read: chords of at most 5 degrees.
  double parts(std::size_t leg) const {
    constexpr double most_rad = std::numbers::pi / 36.0;
    const double longest = std::min(options_.every.value_or(legs_.length(leg)), most_rad * legs_.radius(leg));
    return longest > 0.0 ? std::max(1.0, std::ceil(legs_.length(leg) / longest * (1.0 - 1e-12))) : 1.0;
  }
  void check_count() const {
    constexpr double most = 1e9;
    double places = 0.0;
    if (options_.every_s) {
      places = timed_->duration_s() / *options_.every_s;
    } else {
      for (std::size_t i = 0; i < legs_.leg_count(); ++i) {
        execution_.poll(i);
        places += parts(i);
      }
    }
    if (places > most) throw UsageError(fmt::format("@every: gives {:.2g} places, more than 1e9", places));
  }
  void by_way() {
    double along = 0.0;
    if (legs_.leg_count() == 0) tell(0, 0.0, 0.0);
    for (std::size_t i = 0; i < legs_.leg_count(); ++i) {
      const double count = parts(i);
      const double length = legs_.length(i);
      for (double k = i == 0 ? 0.0 : 1.0; k <= count; k += 1.0) tell(i, k / count, along + length * (k / count));
      along += length;
    }
  }
  void by_time() {
    double along = 0.0;  // up to the leg
    std::size_t leg = 0;
    for (double k = 0.0;; k += 1.0) {
      const double t = std::min(k * *options_.every_s, timed_->duration_s());
      const PathMoment moment = timed_->at(t);
      for (; leg < moment.leg; ++leg) {
        execution_.poll(leg);
        along += legs_.length(leg);
      }
      tell_at(moment, along + moment.share * legs_.length(leg));
      if (t >= timed_->duration_s()) return;
    }
  }
  void tell(std::size_t leg, double share, double along) {
    tell_at(timed_ ? timed_->at_share(leg, share) : PathMoment{leg, share}, along);
  }
  void tell_at(const PathMoment& moment, double along) {
    execution_.poll(++written_);
    for (; leg_ < moment.leg; ++leg_) add_turns(leg_, turned_);
    std::array<double, most_joints> turned = turned_;
    if (moment.share >= 1.0) add_turns(moment.leg, turned);  // whose end is the next state as it stands
    PathState state = legs_.at(moment.leg, moment.share);
    for (std::size_t k = 0; k < state.width; ++k) state.numbers[k] += turned[k];
    (*visit_)({moment, state, along});
  }
  /// Joints without end go the shorter way around: what is read as straight lines between rows must count on.
  void add_turns(std::size_t leg, std::array<double, most_joints>& turned) const {
    for (std::size_t k = 0; k < legs_.width(); ++k) turned[k] += legs_.whole_turns(leg, k);
  }

  const PathLegs& legs_;
  const PathFileOptions& options_;
  const Execution& execution_;
  std::optional<TimedPath> timed_;
  const std::function<void(const Row&)>* visit_ = nullptr;
  std::size_t leg_ = 0;                       // of the last row
  std::array<double, most_joints> turned_{};  // up to this leg, of joints without end
  std::uint64_t written_ = 0;
};

std::uint64_t write_csv(Rows& rows, const PathLegs& legs, OutputFile& file) {
  const bool timed = rows.duration_s().has_value();
  std::string text = timed ? "t,s," : "s,";
  if (legs.shape() == LegShape::joints) {
    for (std::size_t k = 1; k <= legs.width(); ++k) text += fmt::format("{}q{}", k > 1 ? "," : "", k);
  } else {
    text += legs.width() == 3 ? "x,y,theta" : "x,y";
  }
  file.write(text + (timed ? ",speed\n" : "\n"));
  return rows.visit([&](const Row& row) {
    text.clear();
    const auto out = std::back_inserter(text);
    if (timed) fmt::format_to(out, "{},", row.time_s);
    fmt::format_to(out, "{}", row.along);
    for (const double x : row.state.used()) fmt::format_to(out, ",{}", x);
    if (timed) fmt::format_to(out, ",{}", row.speed);
    file.write(text += '\n');
  });
}

/// Of what has no heading: that of the way.
double heading(const PathLegs& legs, const Row& row) {
  if (legs.width() == 3) return row.state.numbers[2];
  if (legs.leg_count() == 0) return 0.0;
  std::size_t leg = row.leg;
  while (leg > 0 && !(legs.length(leg) > 0.0)) --leg;
  const PathState from = legs.at(leg, 0.0);
  const PathState to = legs.at(leg, 1.0);
  return portable::atan2(to.numbers[1] - from.numbers[1], to.numbers[0] - from.numbers[0]);
}

std::uint64_t write_yaml(Rows& rows, const PathLegs& legs, const std::string& frame, OutputFile& file) {
  const std::string named = json_string(frame);
  const auto header = [&](double time_s) {
    double seconds = std::floor(time_s);
    double nanoseconds = std::round((time_s - seconds) * 1e9);
    if (nanoseconds >= 1e9) seconds += 1.0, nanoseconds = 0.0;
    return fmt::format("{{stamp: {{sec: {:.0f}, nanosec: {:.0f}}}, frame_id: {}}}", seconds, nanoseconds, named);
  };
  file.write(fmt::format("header: {}\nposes:\n", header(0.0)));
  return rows.visit([&](const Row& row) {
    const auto [sine, cosine] = portable::sin_and_cos(0.5 * heading(legs, row));
    file.write(fmt::format(
        "- header: {}\n  pose: {{position: {{x: {}, y: {}, z: 0.0}}, orientation: {{x: 0.0, y: 0.0, z: {}, w: {}}}}}\n",
        header(row.time_s), row.state.numbers[0], row.state.numbers[1], sine, cosine));
  });
}

std::uint64_t write_geojson_line(Rows& rows, const PathLegs& legs, const Answer& answer, const std::string& frame,
                                 OutputFile& file) {
  file.write("{\"type\": \"Feature\",\n \"geometry\": {\"type\": \"LineString\", \"coordinates\": [");
  std::string_view comma;
  std::string last;
  const std::uint64_t places = rows.visit([&](const Row& row) {
    last = fmt::format("[{}, {}]", row.state.numbers[0], row.state.numbers[1]);
    file.write(fmt::format("{}\n  {}", comma, last));
    comma = ",";
  });
  if (places == 1) file.write(",\n  " + last);  // a line has two ends
  file.write(fmt::format("]}},\n \"properties\": {{\"frame\": {}, \"length\": {}, \"planner\": {}", json_string(frame),
                         answer.length, json_string(answer.planner)));
  const auto list = [&](std::string_view name, const std::function<double(const Row&)>& number) {
    file.write(fmt::format(",\n  \"{}\": [", name));
    comma = "";
    double end = 0.0;
    rows.visit([&](const Row& row) {
      file.write(fmt::format("{}{}", comma, end = number(row)));
      comma = ", ";
    });
    file.write(places == 1 ? fmt::format(", {}]", end) : "]");
  };
  if (legs.width() == 3) list("theta", [](const Row& row) { return row.state.numbers[2]; });
  if (rows.duration_s()) {
    list("t", [](const Row& row) { return row.time_s; });
    list("speed", [](const Row& row) { return row.speed; });
  }
  file.write("}}\n");
  return places;
}

std::string header_of_array(std::uint64_t places, std::uint64_t width) {
  return npy_header("<f8", std::array{places, width});
}
std::string_view bytes_of(std::span<const double> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};  // NOLINT: the numbers' bytes
}

/// Places alone, as doubles: x and y, with the heading where there is one, or an arm's joints.
std::uint64_t write_array(Rows& rows, const PathLegs& legs, OutputFile& file) {
  file.write(header_of_array(rows.visit([](const Row&) {}), legs.width()));
  return rows.visit([&](const Row& row) { file.write(bytes_of(row.state.used())); });
}

/// The speeds that the arm's file gives its joints, where these are asked for.
PathFileOptions with_own_speeds(const Answer& answer, const PathLegs& legs, PathFileOptions options) {
  if (!options.limits || options.limits->joint_speed.empty()) return options;
  std::vector<double>& speeds = options.limits->joint_speed;
  if (speeds.size() == 1 && speeds.front() == speed_of_file) {
    const auto& files = answer.problem.robot.files;
    if (!files || !files->read) throw UsageError("@joint_speed: 'file' is for an arm of a URDF, which has its speeds");
    speeds.clear();
    for (const ArmVariable& variable : files->read->variables) {
      if (!(variable.speed > 0.0)) {
        throw UsageError(fmt::format("@joint_speed: the file gives joint '{}' no speed; say numbers", variable.name));
      }
      speeds.push_back(variable.speed);
    }
  }
  for (const auto& [name, each] :
       {std::pair{"@joint_speed", speeds}, std::pair{"@joint_acceleration", options.limits->joint_acceleration}}) {
    if (each.size() <= 1 || each.size() == legs.width()) continue;
    throw UsageError(
        fmt::format("{}: expected one number, or {} for this arm (found: {})", name, legs.width(), each.size()));
  }
  return options;
}

}  // namespace

void PathArrayFile::begin(std::uint64_t points) {
  if (name_.empty()) return;
  file_.emplace(name_, execution_);
  file_->write(header_of_array(points, 2));
  left_ = points;
}

void PathArrayFile::add(std::span<const Vec2> piece) {
  static_assert(sizeof(Vec2) == 2 * sizeof(double));
  if (!file_) return;
  const std::span<const Vec2> rest = is_first_ ? piece : piece.subspan(1);
  is_first_ = false;
  if (!rest.empty()) file_->write(bytes_of({&rest.front().x, 2 * rest.size()}));
  left_ -= rest.size();
  if (left_ == 0) file_->complete();
}

PathFormat path_format(const std::string& file) {
  if (file == "-" || file.ends_with(".csv")) return PathFormat::csv;
  if (file.ends_with(".yaml") || file.ends_with(".yml")) return PathFormat::yaml;
  if (file.ends_with(".geojson")) return PathFormat::geojson;
  if (file.ends_with(".npy")) return PathFormat::npy;
  throw UsageError(
      fmt::format("@path: writes .csv, .yaml (nav_msgs/Path), .geojson and .npy by ending (found: {})", file));
}

void check_path_file(const RobotSpec& robot, const std::string& file, const PathFileOptions& options) {
  const bool has_joints = is_arm(robot);
  const PathFormat format = path_format(file);
  if (has_joints && format != PathFormat::csv && format != PathFormat::npy) {
    throw UsageError("@path: the joints of an arm are written as .csv or .npy");
  }
  if (format == PathFormat::npy && options.limits) {
    throw UsageError(fmt::format("@path: .npy holds places alone; {}",
                                 has_joints ? ".csv says when" : ".csv, .yaml and .geojson say when"));
  }
  if (options.every_s && !options.limits) {
    throw UsageError(fmt::format("@every: moments need {}", has_joints ? "@joint_speed" : "@speed"));
  }
  if (!options.limits) return;
  const TravelLimits& limits = *options.limits;
  if (has_joints && limits.joint_speed.empty())
    throw UsageError("@speed: of an arm it is @joint_speed that is limited");
  if (!has_joints && !limits.joint_speed.empty()) throw UsageError("@joint_speed: this body has no joints; say @speed");
  if (robot.kind != RobotKind::car && std::isfinite(limits.lateral_acceleration)) {
    throw UsageError("@lateral_acceleration: is for cars; other bodies stop at corners and drive no arcs");
  }
}

PathFileAccount write_path_file(const Answer& answer, const std::string& file, const PathFileOptions& options,
                                const Execution& execution) {
  check_path_file(answer.problem.robot, file, options);
  OutputFile out(file, execution);
  const PathFileAccount account = write_path(answer, file, options, execution, out);
  out.commit();
  return account;
}

PathFileAccount write_path(const Answer& answer, const std::string& file, const PathFileOptions& options,
                           const Execution& execution, OutputFile& out) {
  check_path_file(answer.problem.robot, file, options);
  const PathLegs legs(answer);
  const PathFileOptions resolved = with_own_speeds(answer, legs, options);
  Rows rows(legs, resolved, execution);
  const PathFormat format = path_format(file);
  const std::uint64_t places = format == PathFormat::csv    ? write_csv(rows, legs, out)
                               : format == PathFormat::yaml ? write_yaml(rows, legs, options.frame, out)
                               : format == PathFormat::npy  ? write_array(rows, legs, out)
                                                           : write_geojson_line(rows, legs, answer, options.frame, out);
  return {places, rows.duration_s()};
}

}  // namespace warren
