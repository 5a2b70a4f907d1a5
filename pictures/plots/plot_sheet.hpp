// SPDX-License-Identifier: BSD-3-Clause
// What all plots are written on: one <svg> element of plot_size with its title, and lines and words on it. Places are
// pixels, y down.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/types.hpp"

namespace warren {

class PlotSheet {
 public:
  /// The title above the frame, the axes' names below it and, unless empty, upright at `y_label_at`.
  void begin(const std::string& title, const Box& frame, const std::string& x_label, const std::string& y_label,
             double y_label_at);
  /// more: attributes, each after a blank.
  void label(double x, double y, std::string_view anchor, std::string_view text, std::string_view more = "");
  void line(Vec2 from, Vec2 to, std::string_view style);
  void box(const Box& box, std::string_view style);
  /// SVG as it is.
  void add(std::string_view svg) { text_ += svg; }
  /// The element whole.
  std::string take() { return std::move(text_) + "</svg>\n"; }

 private:
  std::string text_;
};

/// "#0072b2": of the i-th series; after the eighth they come again.
std::string series_color(std::size_t i);

inline constexpr std::string_view faint_line = "stroke=\"#e2e2e2\"";
inline constexpr std::string_view frame_line = "fill=\"none\" stroke=\"#888888\"";

}  // namespace warren
