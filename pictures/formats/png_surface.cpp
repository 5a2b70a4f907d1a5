// SPDX-License-Identifier: BSD-3-Clause
// The picture in pixels, drawn by our own rasteriser; its words are outlines, filled.
#include <algorithm>
#include <array>
#include <cmath>

#include "pictures/formats/drawn_files.hpp"
#include "pictures/formats/painter.hpp"
#include "pictures/formats/png_file.hpp"
#include "pictures/model/letters.hpp"

namespace warren {
namespace {

class PngSurface : public Surface {
 public:
  PngSurface(const Page& page, const Execution& execution)
      : page_(page),
        execution_(execution),
        density_(page.density()),
        image_(pixels(page.width), pixels(page.height), colors::paper, execution) {}

  const Image& image() const { return image_; }

  void enter_world() override { in_world_ = true; }
  void leave_world() override { in_world_ = false; }
  void begin_group(std::string_view, std::string_view, const Pen& pen) override { pen_ = pen; }
  void end_group() override {}
  void take_pen(const Pen& pen) override { pen_ = pen; }
  void segment(Vec2 a, Vec2 b) override { line(at(a), at(b)); }
  void chain(std::span<const Vec2> points, std::span<const double> turns, bool closed) override;
  void text(const PlacedText& text) override;
  bool takes_as_mask(std::size_t) const override { return false; }
  void mask(const Mask&, Rgb) override {}
  double image_density() const override { return density_; }
  void image(const Image& image, const Box& at) override;

 private:
  std::size_t pixels(double length) const {
    return std::max<std::size_t>(static_cast<std::size_t>(std::lround(length * density_)), 1);
  }
  Vec2 at(Vec2 p) const { return density_ * (in_world_ ? page_.view.at(p) : p); }
  void line(Vec2 a, Vec2 b) { image_.draw_line(a, b, density_ * pen_.width, *pen_.stroke, pen_.opacity); }

  const Page& page_;
  const Execution& execution_;
  double density_;  // pixels a pixel of the page
  Image image_;
  Pen pen_;
  bool in_world_ = false;
};

void PngSurface::chain(std::span<const Vec2> points, std::span<const double> turns, bool closed) {
  execution_.check();
  std::vector<Vec2> all = without_arcs(points, turns);
  for (Vec2& p : all) p = at(p);
  if (pen_.fill && all.size() > 2) {
    // Rectangles that tile end at whole pixels, where they are large enough.
    const Box box = box_of({all[0], all[2]});
    if (pen_.crisp && std::min(box.width(), box.height()) >= 1.0) {
      for (Vec2& p : all) p = {std::round(p.x), std::round(p.y)};
    }
    PolygonSet outline;
    outline.add(all);
    image_.fill(outline, *pen_.fill, pen_.opacity, execution_);
  }
  if (!pen_.stroke) return;
  if (all.size() == 1) line(all[0], all[0]);
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (i % 64 == 0) execution_.check();
    line(all[i - 1], all[i]);
  }
  if (closed && all.size() > 2) line(all.back(), all.front());
}

void PngSurface::text(const PlacedText& text) {
  const double size = density_ * text.size;
  const double width = text_width(text.text, size);
  const double back = text.anchor == Anchor::start ? 0.0 : text.anchor == Anchor::middle ? 0.5 * width : width;
  PolygonSet outlines = text_outlines(text.text, size);
  const Vec2 from = density_ * text.at;
  for (Vec2& p : outlines.corners) {
    p.x -= back;
    p = from + (text.upright ? Vec2{p.y, -p.x} : p);
  }
  const Rgb ink = pen_.fill.value_or(colors::text);
  image_.fill(outlines, ink, 1.0, execution_);
  if (!text.bold) return;
  constexpr double stroke = 0.055;  // of the size
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    Vec2 a = outlines[i].back();
    for (const Vec2 b : outlines[i]) {
      image_.draw_line(a, b, stroke * size, ink);
      a = b;
    }
  }
}

/// Each pixel takes the nearest one.
void PngSurface::image(const Image& image, const Box& at) {
  const Vec2 low = density_ * at.min;
  const Vec2 size = density_ * (at.max - at.min);
  const auto place = [](double v, std::size_t most) {
    return static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(most)));
  };
  const std::size_t right = place(std::round(low.x + size.x), image_.width());
  const std::size_t bottom = place(std::round(low.y + size.y), image_.height());
  for (std::size_t y = place(std::round(low.y), image_.height()); y < bottom; ++y) {
    execution_.check();
    const double v = (static_cast<double>(y) + 0.5 - low.y) / size.y * static_cast<double>(image.height());
    for (std::size_t x = place(std::round(low.x), image_.width()); x < right; ++x) {
      const double u = (static_cast<double>(x) + 0.5 - low.x) / size.x * static_cast<double>(image.width());
      std::copy_n(image.row(place(v, image.height() - 1)) + 3 * place(u, image.width() - 1), 3, image_.row(y) + 3 * x);
    }
  }
}

}  // namespace

std::vector<std::string> draw_png(const Page& page, const DrawOn& draw, const Execution& execution,
                                  const Write& write) {
  PngSurface surface(page, execution);
  std::vector<std::string> notes = draw(surface);
  write_png_file(surface.image(), page.dpi, execution, write);
  return notes;
}

std::vector<std::string> write_png(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                   const Write& write) {
  const Page page = page_of(picture, options, true, execution);
  return draw_png(
      page, [&](Surface& surface) { return paint(picture, options.parts, page, surface, execution); }, execution,
      write);
}

}  // namespace warren
