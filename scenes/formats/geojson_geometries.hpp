// SPDX-License-Identifier: BSD-3-Clause
// What GeoJSON's geometries mean for a world: outlines are obstacles, lines walls, points nothing, unless the feature
// around them says that they are start, goal or bounds. That is known when the feature ends, so geometries wait here.
// Polygons with holes are cut (scenes/scene/holes_cut_open.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/asked_growth.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/growing_walls.hpp"

namespace warren {

/// Refers to the file's name, which must outlive it. All that is wrong throws InputError with file and line.
class GeojsonPieces {
 public:
  enum class Kind : std::uint8_t { polygon, wall, point };

  GeojsonPieces(const std::string& file, const Execution& execution)
      : file_(file), execution_(execution), walls_(execution) {}

  /// How many wait.
  std::size_t size() const { return waiting_.size(); }
  /// Rings are not closed.
  void add(Kind kind, std::vector<Vec2> points, std::size_t line) {
    push_asked(waiting_, {kind, std::move(points), line, {}}, execution_);
  }
  /// Of the polygon that was added last.
  void add_hole(std::vector<Vec2> ring) { push_asked(waiting_.back().holes, std::move(ring), execution_); }
  /// Takes those that wait, from the one of that number on, into the world. role: "start", "goal", "bounds", or else
  /// they are obstacles.
  void settle(std::size_t first, const std::string& role);
  /// The world; once.
  Scene finish();

 private:
  struct Piece {
    Kind kind;
    std::vector<Vec2> points;
    std::size_t line;
    std::vector<std::vector<Vec2>> holes;
  };

  [[noreturn]] void fail_at(std::size_t line, std::string_view what) const;
  void settle_role(const Piece& piece, const std::string& role);
  void settle_obstacle(Piece& piece);

  const std::string& file_;
  const Execution& execution_;
  Scene scene_;
  WallCollector walls_;
  std::vector<Piece> waiting_;
};

}  // namespace warren
