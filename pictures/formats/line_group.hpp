// SPDX-License-Identifier: BSD-3-Clause
// Many lines or areas of one kind as a group on a surface. Where their ink would cover much of the page they become
// thinner and fainter; where a file of them would be too large they are drawn as pixels.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/formats/surface.hpp"
#include "pictures/model/page.hpp"

namespace warren {

class LineGroup {
 public:
  LineGroup(Surface& surface, const Page& page, const Execution& execution, const Pen& pen)
      : surface_(surface), page_(page), execution_(execution), pen_(pen) {}

  /// Before the group begins: what its lines are to cover; a point twice is a dot.
  void measure(std::span<const Vec2> chain);
  /// The pen that covers no more than a share of the page with what was measured; the group takes it.
  Pen thinned();
  /// points: how many will follow, at least.
  void begin(std::string_view id, std::string_view label, std::size_t points);
  void take_color(Rgb color);
  /// Throws Stopped.
  void segment(Vec2 a, Vec2 b);
  /// As Surface's, with this share of the opacity.
  void chain(std::span<const Vec2> points, std::span<const double> turns, bool closed, double opacity = 1.0);
  void end();

  /// Are they visibly thinner than they were to be? Are they pixels?
  bool is_thin() const { return thin_; }
  bool is_mask() const { return mask_.has_value(); }

 private:
  Vec2 in_mask(Vec2 p) const { return density_ * (page_.view.at(p) - page_.data.min); }
  void count();

  Surface& surface_;
  const Page& page_;
  const Execution& execution_;
  Pen pen_;
  double ink_ = 0.0;  // square pixels of the page
  std::size_t drawn_ = 0;
  bool thin_ = false;
  std::optional<Mask> mask_;
  double density_ = 1.0;  // pixels of the mask a pixel of the page
};

}  // namespace warren
