// SPDX-License-Identifier: BSD-3-Clause
// SVG 1.1, one merged path a layer (and a component's colour), so that files stay small: "M1 1h1" is a wall. In the
// group "world" coordinates are the world's, with at most three decimals; worlds that are tiny, huge or far from the
// origin are moved into a frame where that is enough. No attribute is longer than a megabyte, which some readers ask
// for; more lines than a screen can show are an image inside. Written in pieces: memory stays small whatever the world.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/plane/se2.hpp"
#include "pictures/formats/surface.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/picture.hpp"

namespace warren {

/// Where SVG's coordinates are those of the world, but for a move and a factor.
struct WorldFrame {
  explicit WorldFrame(const Box& box);
  Vec2 at(Vec2 p) const { return scale * (p - origin); }

  Vec2 origin;
  double scale = 1.0;
};

class SvgSurface : public Surface {
 public:
  SvgSurface(const Page& page, const Execution& execution, const Write& write)
      : page_(page), execution_(execution), write_(write), frame_(page.canvas.box) {}

  void open(const Picture& picture, std::string_view title);
  void close();

  void enter_world() override;
  void leave_world() override;
  void begin_group(std::string_view id, std::string_view label, const Pen& pen) override;
  void end_group() override;
  void take_pen(const Pen& pen) override;
  void segment(Vec2 a, Vec2 b) override;
  void chain(std::span<const Vec2> points, std::span<const double> turns, bool closed) override;
  void text(const PlacedText& text) override;
  bool takes_as_mask(std::size_t points) const override;
  void mask(const Mask& mask, Rgb color) override;
  double image_density() const override { return density_of_images; }
  void image(const Image& image, const Box& at) override;
  void moving_body(const MovingBody& body, double line_width) override;
  void moving_arm(const MovingArm& arm, double line_width) override;

 private:
  static constexpr double density_of_images = 2.0;  // sharp on most screens, and on paper
  Vec2 at(Vec2 p) const { return in_world_ ? frame_.at(p) : p; }
  /// Of a length on the page.
  double length(double pixels) const { return in_world_ ? pixels * frame_.scale / page_.view.scale : pixels; }
  std::string style(const Pen& pen) const;
  void open_path();
  void close_path();
  void command(char letter, Vec2 p);
  void leg_to(Vec2 from, Vec2 to, double turn);
  void split();
  void flush();

  const Page& page_;
  const Execution& execution_;
  const Write& write_;
  WorldFrame frame_;
  bool in_world_ = false;
  Pen group_pen_;
  Pen pen_;
  bool path_is_open_ = false;
  bool is_way_ = false;  // the group is "path": its last line has the id "way"
  std::size_t path_bytes_ = 0;
  std::size_t written_ = 0;  // bytes
  std::string text_;
};

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

/// The group "body". path_id: of the line that it follows; scale: picture units a world unit. Empty where the body
/// stands still.
std::string svg_moving_body(const MovingBody& body, std::string_view path_id, double scale, double line_width);

/// The group "arm": in each of its projections a line of that width. `at`: from the picture's world to where it is
/// written. Empty where it stands still.
std::string svg_moving_arm(const MovingArm& arm, double width, const std::function<Vec2(Vec2)>& at);

}  // namespace warren
