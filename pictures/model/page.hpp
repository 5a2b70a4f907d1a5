// SPDX-License-Identifier: BSD-3-Clause
// A picture's place on its page: title, axes, legend and scale bar around the world, all laid out in pixels of the page
// (1/96 inch, y down) before anything is drawn, so that all formats agree.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "pictures/model/colors.hpp"
#include "pictures/model/picture.hpp"

namespace warren {
// What a legend says of a picture: an entry for everything that is really drawn.

struct LegendEntry {
  std::string label;
  std::vector<Rgb> lines = {};         ///< pieces of a line, each in one colour
  double width = 0.0;                  ///< of the line, pixels
  std::optional<Rgb> fill = {};        ///< of an area, outlined by the first of `lines`
  std::optional<Rgb> dot = {};         ///< on the line
  std::optional<MarkShape> mark = {};  ///< alone, filled with `fill`
  double opacity = 1.0;                ///< of an area
  Vec2 at = {};                        ///< left end of the swatch, in the middle of the line
};

enum class Anchor : std::uint8_t { start, middle, end };
/// As SVG says it.
constexpr auto enum_names(Anchor) { return std::array<std::string_view, 3>{"start", "middle", "end"}; }

struct PlacedText {
  Vec2 at;  ///< on the base line
  std::string text;
  double size;
  Anchor anchor = Anchor::start;
  bool bold = false;
  bool upright = false;  ///< turned by a quarter, reads upwards
};

/// From the world to the page.
struct View {
  double scale = 1.0;  ///< pixels a unit of the world
  Vec2 origin;         ///< the page's point of the world's (0, 0)
  Vec2 at(Vec2 p) const { return {origin.x + scale * p.x, origin.y - scale * p.y}; }
  /// The world's, of a box of the page.
  Box box_of(const Box& on_page) const {
    return {{(on_page.min.x - origin.x) / scale, (origin.y - on_page.max.y) / scale},
            {(on_page.max.x - origin.x) / scale, (origin.y - on_page.min.y) / scale}};
  }
};

struct Page {
  double width = 0.0;
  double height = 0.0;
  std::optional<PageSize> asked = {};  ///< what was asked for
  double dpi = 96.0;                   ///< pixels of a PNG an inch
  View view;
  Canvas canvas;
  Box data;  ///< the part that shows the world
  std::vector<PlacedText> texts;
  std::vector<Segment> frame;  ///< around the data, and ticks
  std::vector<Segment> ink;    ///< the scale bar
  std::vector<LegendEntry> legend;

  /// Factor of the widths of lines: 1 where a unit has twenty pixels.
  double thickness() const;
  /// Pixels of a PNG a pixel of the page.
  double density() const { return dpi / 96.0; }
};

inline constexpr double swatch_width = 26.0;

/// A line in the margin below all, cut to what fits.
PlacedText foot_of(const Page& page, const std::string& words);

/// Throws Stopped.
Page page_of(const Picture& picture, const PictureOptions& options, bool in_pixels, const Execution& execution);

}  // namespace warren
