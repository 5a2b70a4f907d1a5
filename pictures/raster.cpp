// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/raster.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plane/geometry.hpp"
#include "scenes/images/png_writer_io.hpp"

namespace warren {

Image::Image(std::size_t width, std::size_t height, Rgb paper, const Execution& execution)
    : width_(width), height_(height), pixels_(3 * width * height) {
  constexpr std::size_t pixels_per_poll = std::size_t{1} << 18;
  for (std::size_t i = 0; i < width * height; ++i) {
    if (i % pixels_per_poll == 0) execution.check();
    pixels_[3 * i] = paper.red;
    pixels_[3 * i + 1] = paper.green;
    pixels_[3 * i + 2] = paper.blue;
  }
}

void Image::blend(std::size_t x, std::size_t y, double alpha, Rgb color) {
  std::uint8_t* pixel = pixels_.data() + 3 * (width_ * y + x);
  const auto weight = static_cast<int>(std::lround(alpha * 256.0));
  const int ink[] = {color.red, color.green, color.blue};
  for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>((pixel[c] * (256 - weight) + ink[c] * weight) >> 8);
}

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

/// Crossings of an outline with the sub-rows of pixel rows: four a row.
constexpr int sub_rows = 4;

}  // namespace

void Image::fill(std::span<const Vec2> outline, Rgb color, const Execution& execution) {
  if (outline.size() < 3) return;
  execution.check();
  Box box;
  for (const Vec2 p : outline) box.include(p);
  const double top = std::clamp(std::floor(box.min.y), 0.0, static_cast<double>(height_));
  const double bottom = std::clamp(std::ceil(box.max.y), 0.0, static_cast<double>(height_));
  if (!(top < bottom)) return;
  const auto first_row = static_cast<std::size_t>(top);
  const std::size_t rows = static_cast<std::size_t>(bottom) - first_row;
  std::vector<std::vector<double>> crossings(rows * sub_rows);
  const auto height_of = [&](std::size_t k) { return top + (static_cast<double>(k) + 0.5) / sub_rows; };
  const auto sub_row = [&](double y) {  // the first one at y or below
    const double k = std::ceil((y - top) * sub_rows - 0.5);
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(crossings.size())));
  };
  Vec2 a = outline.back();
  std::size_t sides = 0;
  for (const Vec2 b : outline) {
    if (++sides % 256 == 0) execution.check();
    const auto [upper, lower] = a.y < b.y ? std::pair(a, b) : std::pair(b, a);
    for (std::size_t k = sub_row(upper.y); k < sub_row(lower.y); ++k) {
      crossings[k].push_back(upper.x + (lower.x - upper.x) / (lower.y - upper.y) * (height_of(k) - upper.y));
    }
    a = b;
  }
  std::vector<double> cover(width_ + 1);
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % 64 == 63) execution.check();
    fill_row(first_row + row, std::span(crossings).subspan(row * sub_rows, sub_rows), cover, color);
  }
}

/// The part of each pixel that lies between the first crossing and the second, the third and the fourth, ...
void Image::fill_row(std::size_t y, std::span<std::vector<double>> crossings, std::vector<double>& cover, Rgb color) {
  const auto width = static_cast<double>(width_);
  double low = width;
  double high = 0.0;
  for (std::vector<double>& row : crossings) {
    std::sort(row.begin(), row.end());
    for (std::size_t i = 1; i < row.size(); i += 2) {
      const double from = std::clamp(row[i - 1], 0.0, width);
      const double to = std::clamp(row[i], 0.0, width);
      low = std::min(low, std::floor(from));
      high = std::max(high, std::ceil(to));
      for (double x = std::floor(from); x < to; ++x) {
        cover[static_cast<std::size_t>(x)] += (std::min(to, x + 1.0) - std::max(from, x)) / sub_rows;
      }
    }
  }
  for (auto x = static_cast<std::size_t>(std::min(low, width)); x < static_cast<std::size_t>(high); ++x) {
    blend(x, y, std::min(1.0, cover[x]), color);
    cover[x] = 0.0;
  }
}

void Image::draw_line(Vec2 a, Vec2 b, double width, Rgb color) {
  const double strength = std::min(1.0, width);
  const double radius = 0.5 * std::max(1.0, width);
  const Box reach = box_of({a, b}).grown(radius + 0.5);
  const auto clamped = [](double v, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(size)));
  };
  const std::size_t right = clamped(std::ceil(reach.max.x), width_);
  const std::size_t bottom = clamped(std::ceil(reach.max.y), height_);
  for (std::size_t y = clamped(std::floor(reach.min.y), height_); y < bottom; ++y) {
    const auto [low, high] = reach_in_row(a, b, static_cast<double>(y) + 0.5, radius + 0.5);
    const std::size_t end = std::min(right, clamped(std::ceil(high), width_));
    for (std::size_t x = clamped(std::floor(std::max(reach.min.x, low)), width_); x < end; ++x) {
      const Vec2 centre{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
      const double cover = radius + 0.5 - distance(centre, Segment{a, b});
      if (cover > 0.0) blend(x, y, strength * std::min(1.0, cover), color);
    }
  }
}

void write_png_image(const Image& image, const Execution& execution, const Write& write) {
  write_png({.width = static_cast<std::uint32_t>(image.width()),
             .height = static_cast<std::uint32_t>(image.height()),
             .is_colour = true,
             .row = [&](std::size_t y) { return image.row(y); }},
            execution, write);
}

}  // namespace warren
