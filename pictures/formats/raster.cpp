// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/raster.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace warren {

Image::Image(std::size_t width, std::size_t height, Rgb paper, const Execution& execution)
    : width_(width), height_(height) {
  execution.reserve(3 * width * height);
  pixels_.resize(3 * width * height);
  constexpr std::size_t pixels_per_poll = std::size_t{1} << 18;
  for (std::size_t i = 0; i < width * height; ++i) {
    if (i % pixels_per_poll == 0) execution.check();
    pixels_[3 * i] = paper.red;
    pixels_[3 * i + 1] = paper.green;
    pixels_[3 * i + 2] = paper.blue;
  }
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
  const auto clamped = [](double v, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(v, 0.0, static_cast<double>(size)));
  };
  const std::size_t right = clamped(std::ceil(reach.max.x), columns);
  const std::size_t bottom = clamped(std::ceil(reach.max.y), rows);
  for (std::size_t y = clamped(std::floor(reach.min.y), rows); y < bottom; ++y) {
    const auto [low, high] = reach_in_row(a, b, static_cast<double>(y) + 0.5, radius + 0.5);
    const std::size_t end = std::min(right, clamped(std::ceil(high), columns));
    for (std::size_t x = clamped(std::floor(std::max(reach.min.x, low)), columns); x < end; ++x) {
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
  Box box;
  for (const Vec2 p : outlines.corners) box.include(p);
  if (box.empty()) return;
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
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    Vec2 a = outlines[i].back();
    for (const Vec2 b : outlines[i]) {
      if (++sides % 256 == 0) execution.check();
      const auto [upper, lower] = a.y < b.y ? std::pair(a, b) : std::pair(b, a);
      for (std::size_t k = sub_row(upper.y); k < sub_row(lower.y); ++k) {
        crossings[k].push_back(upper.x + (lower.x - upper.x) / (lower.y - upper.y) * (height_of(k) - upper.y));
      }
      a = b;
    }
  }
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

}  // namespace

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

void Mask::cover(std::size_t x, std::size_t y, double share) {
  std::uint8_t& pixel = pixels_[width_ * y + x];
  pixel = static_cast<std::uint8_t>(pixel + std::lround((255 - pixel) * share));
}

void Mask::draw_line(Vec2 a, Vec2 b, double width, double opacity) {
  cover_line(a, b, width, width_, height_,
             [&](std::size_t x, std::size_t y, double share) { cover(x, y, opacity * share); });
}

void Mask::fill(const PolygonSet& outlines, double opacity, const Execution& execution) {
  cover_inside(outlines, width_, height_, execution,
               [&](std::size_t x, std::size_t y, double share) { cover(x, y, opacity * share); });
}

}  // namespace warren
