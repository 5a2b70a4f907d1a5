// SPDX-License-Identifier: BSD-3-Clause
// A path as a file that others drive along: CSV, ROS nav_msgs/Path as YAML, GeoJSON, NumPy array. docs/file_formats.md,
// "Paths".
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "parallel/execution.hpp"
#include "solve/answer/answer.hpp"
#include "solve/paths/timed_path.hpp"

namespace warren {

enum class PathFormat : std::uint8_t { csv, yaml, geojson, npy };

/// By the ending; "-" is CSV. Throws UsageError, which names the endings there are.
PathFormat path_format(const std::string& file);

struct PathFileOptions {
  std::optional<double> every = {};         ///< places at most so far apart along the legs, beside the path's own; > 0
  std::optional<double> every_s = {};       ///< places so many seconds apart, and the goal, instead; needs limits; > 0
  std::optional<TravelLimits> limits = {};  ///< say when; none: a file without times
  std::string frame = "map";                ///< what YAML and GeoJSON call the coordinates' frame
};

/// What was written.
struct PathFileAccount {
  std::uint64_t places = 0;
  std::optional<double> duration_s;
};

/// Throws UsageError for a format that paths of this body can't be written in, or moments, for limits of another body,
/// and for moments without limits.
void check_path_file(const RobotSpec& robot, const std::string& file, const PathFileOptions& options);

/// answer: has a path. Throws UsageError as check_path_file does, and for more than 1e9 places; WriteError, Stopped.
PathFileAccount write_path_file(const Answer& answer, const std::string& file, const PathFileOptions& options,
                                const Execution& execution);

}  // namespace warren
