// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/line_group.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace warren {

void LineGroup::measure(std::span<const Vec2> chain) {
  constexpr std::size_t chains_per_poll = 1 << 14;
  if (++drawn_ % chains_per_poll == 0) execution_.check();
  for (std::size_t i = 1; i < chain.size(); ++i) {
    ink_ += pen_.width * (page_.view.scale * distance(chain[i - 1], chain[i]) + pen_.width);
  }
}

Pen LineGroup::thinned() {
  constexpr double most_cover = 0.3;
  constexpr double least_width = 0.4;
  constexpr double least_opacity = 0.25;
  const double allowed = most_cover * page_.data.width() * page_.data.height();
  if (ink_ > allowed) {
    constexpr double visibly = 0.9;
    const double share = std::sqrt(allowed / ink_);
    thin_ = share < visibly;
    pen_.width = std::min(pen_.width, std::max(pen_.width * share, least_width));
    pen_.opacity *= std::max(share, least_opacity);
  }
  return pen_;
}

void LineGroup::begin(std::string_view id, std::string_view label, std::size_t points) {
  surface_.begin_group(id, label, pen_);
  drawn_ = 0;
  if (!surface_.takes_as_mask(points)) return;
  constexpr double most_pixels = 3072.0;
  density_ = most_pixels / std::max(page_.data.width(), page_.data.height());
  mask_.emplace(static_cast<std::size_t>(std::ceil(density_ * page_.data.width())),
                static_cast<std::size_t>(std::ceil(density_ * page_.data.height())), execution_);
}

void LineGroup::take_color(Rgb color) {
  if (mask_) return;  // has one
  pen_.stroke = color;
  surface_.take_pen(pen_);
}

void LineGroup::count() {
  constexpr std::size_t lines_per_poll = 64;  // each may run across the whole picture
  if (++drawn_ % lines_per_poll == 0) execution_.check();
}

void LineGroup::segment(Vec2 a, Vec2 b) {
  count();
  if (!mask_) return surface_.segment(a, b);
  mask_->draw_line(in_mask(a), in_mask(b), density_ * pen_.width, pen_.opacity);
}

void LineGroup::chain(std::span<const Vec2> points, std::span<const double> turns, bool closed, double opacity) {
  count();
  if (!mask_) {
    Pen pen = pen_;
    pen.opacity *= opacity;
    surface_.take_pen(pen);
    return surface_.chain(points, turns, closed);
  }
  std::vector<Vec2> all = without_arcs(points, turns);
  for (Vec2& p : all) p = in_mask(p);
  if (pen_.fill) {
    PolygonSet outline;
    outline.add(all);
    return mask_->fill(outline, pen_.opacity * opacity, execution_);
  }
  if (closed) all.push_back(all.front());
  for (std::size_t i = 1; i < all.size(); ++i) {
    mask_->draw_line(all[i - 1], all[i], density_ * pen_.width, pen_.opacity * opacity);
  }
}

void LineGroup::end() {
  if (mask_) surface_.mask(*mask_, pen_.fill ? *pen_.fill : *pen_.stroke);
  surface_.end_group();
}

}  // namespace warren
