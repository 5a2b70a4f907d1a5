// SPDX-License-Identifier: BSD-3-Clause
// A path as a file that others drive along: CSV, ROS nav_msgs/Path as YAML, GeoJSON, NumPy array. docs/file_formats.md,
// "Paths".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "scenes/text/output_file_io.hpp"
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

struct PathFileAccount {
  std::uint64_t places = 0;
  std::optional<double> duration_s;
};

/// Throws UsageError for a format that paths of this body can't be written in, or moments, for limits of another body,
/// and for moments without limits.
void check_path_file(const RobotSpec& robot, const std::string& file, const PathFileOptions& options);

/// A path of points as .npy, written while it is made: nobody holds it.
class PathArrayFile : public PathTaker {
 public:
  /// file: path_format() npy; empty: none is written. Nothing is opened yet.
  PathArrayFile(std::string file, const Execution& execution) : name_(std::move(file)), execution_(execution) {}
  /// Throws WriteError, Stopped, as all that follow.
  void begin(std::uint64_t points) override;
  void add(std::span<const Vec2> piece) override;
  /// Puts the file into its place; without it there is none.
  void commit() { file_->commit(); }

 private:
  std::string name_;
  Execution execution_;
  std::optional<OutputFile> file_;
  std::uint64_t left_ = 0;  // points that have not come
  bool is_first_ = true;
};

/// answer: has a path. Throws UsageError as check_path_file does, and for more than 1e9 places; WriteError, Stopped.
PathFileAccount write_path_file(const Answer& answer, const std::string& file, const PathFileOptions& options,
                                const Execution& execution);
/// The same into `out`, which the caller puts into its place; `file` names the format.
PathFileAccount write_path(const Answer& answer, const std::string& file, const PathFileOptions& options,
                           const Execution& execution, OutputFile& out);

}  // namespace warren
