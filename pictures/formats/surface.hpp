// SPDX-License-Identifier: BSD-3-Clause
// What pictures are drawn on, whatever the format: lines, areas and words in groups. paint() draws; each format has a
// surface that writes it down.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "pictures/formats/raster.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/colors.hpp"
#include "pictures/model/page.hpp"

namespace warren {

/// How lines and areas look.
struct Pen {
  std::optional<Rgb> stroke = {};
  double width = 1.0;  ///< of lines, pixels of the page
  std::optional<Rgb> fill = {};
  double opacity = 1.0;
  bool crisp = false;  ///< rectangles that tile: no seams may show
  friend bool operator==(const Pen&, const Pen&) = default;
};

/// Groups are not nested. Within enter_world() and leave_world() points are the world's, else the page's; widths are
/// always the page's.
class Surface : NotCopied {
 public:
  virtual ~Surface() = default;

  virtual void enter_world() { in_world_ = true; }
  virtual void leave_world() { in_world_ = false; }
  /// label: what the legend calls it; may be empty.
  virtual void begin_group(std::string_view id, std::string_view label, const Pen& pen) = 0;
  virtual void end_group() = 0;
  /// For what follows in the group.
  virtual void take_pen(const Pen& pen) = 0;
  /// With round ends, also where both are the same point.
  virtual void segment(Vec2 a, Vec2 b) = 0;
  /// Outlines with a fill, drawn one after the other with one pen, are filled where any of them is; all of them run the
  /// same way round. turns as in PictureLayer.
  virtual void chain(std::span<const Vec2> points, std::span<const double> turns, bool closed) = 0;
  virtual void text(const PlacedText& text) = 0;
  /// Lines and areas of so many points as one Mask over the data's part of the page; false: they are to be drawn.
  virtual bool takes_as_mask(std::size_t /*points*/) const { return false; }
  virtual void mask(const Mask&, Rgb /*color*/) {}
  /// Pixels of an image a pixel of the page, where it is to look as sharp as the page can.
  virtual double image_density() const = 0;
  /// Over that part of the page, in a group outside of the world; it may be of any size.
  virtual void image(const Image& image, const Box& at) = 0;
  /// What moves in a picture, after the path, as far as its part is shown; only where the format moves.
  virtual void moving(const Picture&, Parts, double /*line_width*/) {}

 protected:
  bool in_world_ = false;  ///< between enter_world() and leave_world()
};

/// Draws a picture part by part from back to front (painter.cpp). Groups polygons, walls, edges, search_tree,
/// milestones, path, start, goal and those of the layers, in the world; frame, legend and title around it. Returns what
/// was drawn otherwise than usual, a line each: the picture says it, too, where it has a legend. Throws Stopped.
std::vector<std::string> paint(const Picture& picture, Parts parts, const Page& page, Surface& surface,
                               const Execution& execution);

// Pages as files of pixels or of PDF, whatever draws on them: pictures of worlds and plots.

/// Draws all there is on a surface, and says what was drawn otherwise than usual, a line each.
using DrawOn = std::function<std::vector<std::string>(Surface&)>;

/// Both return what `draw` returns; they throw Stopped, and what `draw` and `write` throw.
std::vector<std::string> draw_png(const Page& page, const DrawOn& draw, const Execution& execution, const Write& write);
/// title, subject: what the document says of itself. Throws UsageError where can_write_pdf() is false, and for pages
/// too large.
std::vector<std::string> draw_pdf(const Page& page, const std::string& title, std::string subject, const DrawOn& draw,
                                  const Execution& execution, const Write& write);

// A body that moves along the path of an SVG picture: SMIL, no script, nothing from elsewhere. It follows the path's
// own line (arcs stay arcs) and turns as its poses say; where it turns on the spot, time goes on. A renderer without
// animation shows none.

/// The moment, in 0 .. 1, at which each pose is reached, and the share of the way that is behind then. Time goes with
/// the way of the body's farthest point.
struct Timetable {
  std::vector<double> moments;
  std::vector<double> shares;
};
Timetable timetable_of(const MovingBody& body);

/// The group "body"; it follows the line "way". scale: picture units a world unit. Empty where the body stands still.
std::string svg_moving_body(const MovingBody& body, double scale, double line_width);

/// The group "arm": in each of its projections a line of that width. `at`: from the picture's world to where it is
/// written. Empty where it stands still.
std::string svg_moving_arm(const MovingArm& arm, double width, const std::function<Vec2(Vec2)>& at);

}  // namespace warren
