// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/formats/geojson_geometries.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "scenes/scene/holes_cut_open.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

void GeojsonPieces::fail_at(std::size_t line, std::string_view what) const {
  scene_text::Place{file_, line}.fail(what, {});
}

void GeojsonPieces::settle(std::size_t first, const std::string& role) {
  for (std::size_t i = first; i < waiting_.size(); ++i) {
    if (role == "start" || role == "goal" || role == "bounds") {
      settle_role(waiting_[i], role);
    } else {
      settle_obstacle(waiting_[i]);
    }
  }
  waiting_.resize(first);
}

void GeojsonPieces::settle_role(const Piece& piece, const std::string& role) {
  const bool wants_point = role != "bounds";
  if ((piece.kind == Kind::point) != wants_point || piece.kind == Kind::wall) {
    fail_at(piece.line, fmt::format("the role \"{}\" is that of a {}", role, wants_point ? "Point" : "Polygon"));
  }
  if (wants_point) {
    std::vector<double>& state = role == "start" ? scene_.start : scene_.goal;
    if (!state.empty() || piece.points.size() != 1) fail_at(piece.line, fmt::format("a second \"{}\"", role));
    state = {piece.points[0].x, piece.points[0].y};
    return;
  }
  if (scene_.bounds) fail_at(piece.line, "a second \"bounds\"");
  Box box;
  for (const Vec2 p : piece.points) box.include(p);
  if (!(box.width() > 0.0) || !(box.height() > 0.0)) fail_at(piece.line, "the bounds have no area");
  scene_.bounds = box;
}

void GeojsonPieces::settle_obstacle(Piece& piece) {
  if (piece.kind == Kind::point) return;  // a mark on a map blocks nothing
  if (piece.kind == Kind::wall) {
    for (std::size_t i = 1; i < piece.points.size(); ++i) {
      walls_.add(piece.points[i - 1].x, piece.points[i - 1].y, piece.points[i].x, piece.points[i].y);
    }
    return;
  }
  if (piece.holes.empty()) {
    push_asked(scene_.polygons, {std::move(piece.points), piece.line}, execution_);
  } else if (!add_without_holes(scene_, piece.line, piece.points, piece.holes, execution_)) {
    fail_at(piece.line, misplaced_hole);
  }
}

Scene GeojsonPieces::finish() {
  scene_.walls = walls_.take();
  scene_.source = file_;
  if (scene_.walls.size() == 0 && scene_.polygons.empty() && !scene_.bounds) {
    throw InputError(file_, "there is no polygon and no line in it; expected GeoJSON with some");
  }
  return std::move(scene_);
}

}  // namespace warren
