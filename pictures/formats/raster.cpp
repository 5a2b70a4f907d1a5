// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/raster.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "pictures/formats/surface.hpp"
#include "pictures/model/letters.hpp"
#include "scenes/files/image_io.hpp"

namespace warren {
namespace {

struct PixelRun {
  double low;
  double high;
};

/// A little more than where the points at height y lie that are at most r from the line through a and b.
PixelRun reach_in_row(Vec2 a, Vec2 b, double y, double r) {
  constexpr double everything = 1e9;
  const Vec2 along = b - a;
  if (std::abs(along.y) <= 1e-6 * std::abs(along.x) || along.y == 0.0) return {-everything, everything};
  const double middle = a.x + along.x / along.y * (y - a.y);
  const double half = r * norm(along) / std::abs(along.y) + 1.0;
  return {middle - half, middle + half};
}

/// Calls cover(x, y, share) for each pixel that the line covers a part of.
template <class Cover>
void cover_line(Vec2 a, Vec2 b, double width, std::size_t columns, std::size_t rows, const Cover& cover) {
  const double strength = std::min(1.0, width);
  const double radius = 0.5 * std::max(1.0, width);
  const Box reach = box_of({a, b}).grown(radius + 0.5);
  const Vec2 along = b - a;
  const double length_sq = dot(along, along);
  const double share_a_pixel = length_sq > 0.0 ? 1.0 / length_sq : 0.0;
  const double reach_sq = (radius + 0.5) * (radius + 0.5);
  const std::size_t right = pixel_at(std::ceil(reach.max.x), columns);
  const std::size_t bottom = pixel_at(std::ceil(reach.max.y), rows);
  for (std::size_t y = pixel_at(std::floor(reach.min.y), rows); y < bottom; ++y) {
    const auto [low, high] = reach_in_row(a, b, static_cast<double>(y) + 0.5, radius + 0.5);
    const std::size_t end = std::min(right, pixel_at(std::ceil(high), columns));
    for (std::size_t x = pixel_at(std::floor(std::max(reach.min.x, low)), columns); x < end; ++x) {
      const Vec2 from_a = Vec2{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5} - a;
      const Vec2 off = from_a - std::clamp(dot(from_a, along) * share_a_pixel, 0.0, 1.0) * along;
      const double distance_sq = dot(off, off);
      if (distance_sq < reach_sq) cover(x, y, strength * std::min(1.0, radius + 0.5 - std::sqrt(distance_sq)));
    }
  }
}

void blend(std::uint8_t* pixel, double alpha, Rgb color) {
  const auto weight = static_cast<int>(std::lround(alpha * 256.0));
  const int ink[] = {color.red, color.green, color.blue};
  for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>((pixel[c] * (256 - weight) + ink[c] * weight) >> 8);
}

void darken(std::uint8_t& pixel, double share) {
  pixel = static_cast<std::uint8_t>(pixel + std::lround((255 - pixel) * share));
}

/// Crossings of outlines with the sub-rows of pixel rows: four a row.
constexpr int sub_rows = 4;

/// Adds the part of each pixel that lies between the first crossing and the second, the third and the fourth, ... and
/// gives the pixels that may have some.
PixelRun add_cover(std::span<std::vector<double>> crossings, std::vector<double>& cover) {
  const auto width = static_cast<double>(cover.size() - 1);
  PixelRun run{width, 0.0};
  for (std::vector<double>& row : crossings) {
    std::sort(row.begin(), row.end());
    for (std::size_t i = 1; i < row.size(); i += 2) {
      const double from = std::clamp(row[i - 1], 0.0, width);
      const double to = std::clamp(row[i], 0.0, width);
      run.low = std::min(run.low, std::floor(from));
      run.high = std::max(run.high, std::ceil(to));
      for (double x = std::floor(from); x < to; ++x) {
        cover[static_cast<std::size_t>(x)] += (std::min(to, x + 1.0) - std::max(from, x)) / sub_rows;
      }
    }
  }
  return run;
}

/// Calls cover(x, y, share) for each pixel that has a part inside of the outlines, by the even-odd rule.
template <class Cover>
void cover_inside(const PolygonSet& outlines, std::size_t columns, std::size_t all_rows, const Execution& execution,
                  const Cover& cover) {
  execution.check();
  const Box box = box_around(outlines.corners);
  const double top = std::clamp(std::floor(box.min.y), 0.0, static_cast<double>(all_rows));
  const double bottom = std::clamp(std::ceil(box.max.y), 0.0, static_cast<double>(all_rows));
  if (!(top < bottom)) return;
  const auto first_row = static_cast<std::size_t>(top);
  const std::size_t rows = static_cast<std::size_t>(bottom) - first_row;
  std::vector<std::vector<double>> crossings(rows * sub_rows);
  const auto height_of = [&](std::size_t k) { return top + (static_cast<double>(k) + 0.5) / sub_rows; };
  const auto sub_row = [&](double y) {  // the first one at y or below
    const double k = std::ceil((y - top) * sub_rows - 0.5);
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(crossings.size())));
  };
  std::size_t sides = 0;
  const auto cross_rows = [&](Vec2 a, Vec2 b) {
    if (++sides % 256 == 0) execution.check();
    const auto [upper, lower] = a.y < b.y ? std::pair(a, b) : std::pair(b, a);
    for (std::size_t k = sub_row(upper.y); k < sub_row(lower.y); ++k) {
      crossings[k].push_back(upper.x + (lower.x - upper.x) / (lower.y - upper.y) * (height_of(k) - upper.y));
    }
  };
  for (std::size_t i = 0; i < outlines.size(); ++i) for_each_side(outlines[i], cross_rows);
  std::vector<double> shares(columns + 1);
  for (std::size_t k = 0; k < rows; ++k) {
    if (k % 64 == 63) execution.check();
    const PixelRun run = add_cover(std::span(crossings).subspan(k * sub_rows, sub_rows), shares);
    for (auto x = static_cast<std::size_t>(run.low); x < static_cast<std::size_t>(run.high); ++x) {
      cover(x, first_row + k, std::min(1.0, shares[x]));
      shares[x] = 0.0;
    }
  }
}

// Colours are counted in boxes of 8 x 8 x 8 values; a box's colour is its mean, white stays white. The 255 boxes with
// most pixels make the palette, each other box takes the nearest of them.

constexpr std::size_t most_colors = 256;
constexpr std::size_t box_count = std::size_t{1} << 15U;

std::size_t box_of_pixel(const std::uint8_t* p) {
  return static_cast<std::size_t>(p[0] >> 3) << 10U | static_cast<std::size_t>(p[1] >> 3) << 5U | p[2] >> 3;
}

using Color = std::array<std::uint8_t, 3>;

/// How often the colours of a box occur, and their sums.
struct ColorBox {
  std::uint64_t count = 0;
  std::array<std::uint64_t, 3> sums = {};
  Color mean() const {
    Color color;
    for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<std::uint8_t>((sums[c] + count / 2) / count);
    return color;
  }
};

std::uint8_t nearest(const Color& color, const std::vector<Color>& palette) {
  std::size_t best = 0;
  int least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < palette.size(); ++i) {
    int square = 0;
    for (std::size_t c = 0; c < 3; ++c) square += (color[c] - palette[i][c]) * (color[c] - palette[i][c]);
    if (square < least) {
      least = square;
      best = i;
    }
  }
  return static_cast<std::uint8_t>(best);
}

struct ImagePalette {
  std::vector<Color> colors;
  std::vector<std::uint8_t> of_box;
};

ImagePalette palette_of(const Image& image, const Execution& execution) {
  std::vector<ColorBox> all(box_count);
  for (std::size_t y = 0; y < image.height(); ++y) {
    if (y % 64 == 0) execution.check();
    const std::uint8_t* row = image.row(y);
    for (std::size_t x = 0; x < image.width(); ++x) {
      const std::uint8_t* pixel = row + 3 * x;
      ColorBox& box = all[box_of_pixel(pixel)];
      ++box.count;
      for (std::size_t c = 0; c < 3; ++c) box.sums[c] += pixel[c];
    }
  }
  std::vector<std::size_t> boxes;
  for (std::size_t box = 0; box < box_count; ++box) {
    if (all[box].count > 0) boxes.push_back(box);
  }
  std::stable_sort(boxes.begin(), boxes.end(),
                   [&](std::size_t a, std::size_t b) { return all[a].count > all[b].count; });
  constexpr Color white{255, 255, 255};
  ImagePalette palette{{white}, std::vector<std::uint8_t>(box_count, 0)};
  for (const std::size_t box : boxes) {
    if (box == box_count - 1) continue;  // white's
    const bool has_room = palette.colors.size() < most_colors;
    if (has_room) palette.colors.push_back(all[box].mean());
    palette.of_box[box] =
        has_room ? static_cast<std::uint8_t>(palette.colors.size() - 1) : nearest(all[box].mean(), palette.colors);
  }
  return palette;
}

/// A PNG with the palette that is given: fill_row(y, row) sets the numbers of a row's colours in it.
template <class Pixels, class FillRow>
void write_indexed(PngRows png, const Pixels& pixels, const FillRow& fill_row, const Execution& execution,
                   const Write& write) {
  std::vector<std::uint8_t> row(pixels.width());
  png.width = static_cast<std::uint32_t>(pixels.width());
  png.height = static_cast<std::uint32_t>(pixels.height());
  png.row = [&](std::size_t y) {
    fill_row(y, row);
    return static_cast<const std::uint8_t*>(row.data());
  };
  write_png(png, execution, write);
}

// The picture in pixels, drawn by our own rasteriser; its words are outlines, filled.

class PngSurface : public Surface {
 public:
  PngSurface(const Page& page, const Execution& execution)
      : page_(page),
        execution_(execution),
        density_(page.density()),
        image_(pixels(page.width), pixels(page.height), execution) {}

  const Image& image() const { return image_; }

  void begin_group(std::string_view, std::string_view, const Pen& pen) override { pen_ = pen; }
  void end_group() override {}
  void take_pen(const Pen& pen) override { pen_ = pen; }
  void segment(Vec2 a, Vec2 b) override { line(at(a), at(b)); }
  void chain(std::span<const Vec2> points, std::span<const double> turns, bool closed) override {
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

  void text(const PlacedText& text) override {
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

  double image_density() const override { return density_; }
  /// Each pixel takes the nearest one.
  void image(const Image& image, const Box& at) override {
    const Vec2 low = density_ * at.min;
    const Vec2 size = density_ * (at.max - at.min);
    const std::size_t right = pixel_at(std::round(low.x + size.x), image_.width());
    const std::size_t bottom = pixel_at(std::round(low.y + size.y), image_.height());
    for (std::size_t y = pixel_at(std::round(low.y), image_.height()); y < bottom; ++y) {
      execution_.check();
      const double v = (static_cast<double>(y) + 0.5 - low.y) / size.y * static_cast<double>(image.height());
      for (std::size_t x = pixel_at(std::round(low.x), image_.width()); x < right; ++x) {
        const double u = (static_cast<double>(x) + 0.5 - low.x) / size.x * static_cast<double>(image.width());
        std::copy_n(image.row(pixel_at(v, image.height() - 1)) + 3 * pixel_at(u, image.width() - 1), 3,
                    image_.row(y) + 3 * x);
      }
    }
  }

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
};

}  // namespace

Image::Image(std::size_t width, std::size_t height, const Execution& execution) : width_(width), height_(height) {
  static_assert(colors::paper == Rgb{255, 255, 255});
  execution.reserve(3 * width * height);
  pixels_.resize(3 * width * height);
  for (std::size_t y = 0; y < height; ++y) {
    if (y % 64 == 0) execution.check();
    std::fill_n(row(y), 3 * width, std::uint8_t{255});
  }
}

void Image::fill(const PolygonSet& outlines, Rgb color, double opacity, const Execution& execution) {
  cover_inside(outlines, width_, height_, execution,
               [&](std::size_t x, std::size_t y, double share) { blend(row(y) + 3 * x, opacity * share, color); });
}

void Image::draw_line(Vec2 a, Vec2 b, double width, Rgb color, double opacity) {
  cover_line(a, b, width, width_, height_,
             [&](std::size_t x, std::size_t y, double share) { blend(row(y) + 3 * x, opacity * share, color); });
}

Mask::Mask(std::size_t width, std::size_t height, const Execution& execution) : width_(width), height_(height) {
  execution.reserve(width * height);
  pixels_.resize(width * height);
  for (std::size_t y = 0; y < height; ++y) {
    if (y % 64 == 0) execution.check();
    std::fill_n(pixels_.data() + width * y, width, std::uint8_t{0});
  }
}

void Mask::draw_line(Vec2 a, Vec2 b, double width, double opacity) {
  cover_line(a, b, width, width_, height_,
             [&](std::size_t x, std::size_t y, double share) { darken(pixels_[width_ * y + x], opacity * share); });
}

void Mask::fill(const PolygonSet& outlines, double opacity, const Execution& execution) {
  cover_inside(outlines, width_, height_, execution,
               [&](std::size_t x, std::size_t y, double share) { darken(pixels_[width_ * y + x], opacity * share); });
}

void write_png_file(const Image& image, double dpi, const Execution& execution, const Write& write) {
  const ImagePalette palette = palette_of(image, execution);
  const auto fill_row = [&](std::size_t y, std::vector<std::uint8_t>& row) {
    const std::uint8_t* pixels = image.row(y);
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = palette.of_box[box_of_pixel(pixels + 3 * x)];
  };
  write_indexed({.palette = palette.colors, .dpi = dpi, .row = {}}, image, fill_row, execution, write);
}

void write_png_file(const Mask& mask, Rgb color, const Execution& execution, const Write& write) {
  constexpr std::size_t shades = 16;
  std::vector<std::uint8_t> alphas(shades);
  for (std::size_t i = 0; i < shades; ++i) alphas[i] = static_cast<std::uint8_t>(17 * i);
  const std::vector<Color> palette(shades, Color{color.red, color.green, color.blue});
  const auto fill_row = [&](std::size_t y, std::vector<std::uint8_t>& row) {
    const std::uint8_t* pixels = mask.pixels().data() + y * mask.width();
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = static_cast<std::uint8_t>((pixels[x] + 8) / 17);
  };
  write_indexed({.palette = palette, .alphas = alphas, .row = {}}, mask, fill_row, execution, write);
}

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
