// SPDX-License-Identifier: BSD-3-Clause
// Pixels in memory, and lines drawn on them with even edges. A line thinner than a pixel is drawn a pixel wide and
// fainter instead: many of them add up to a shade, so that a picture stays readable at any scale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/picture.hpp"

namespace warren {

/// Row 0 is the top row; 3 bytes a pixel.
class Image {
 public:
  Image(std::size_t width, std::size_t height, Rgb paper, const Execution& execution);

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  const std::uint8_t* row(std::size_t y) const { return pixels_.data() + 3 * width_ * y; }

  /// A line with round ends; coordinates in pixels from the upper left corner, y down. O(pixels covered + rows).
  void draw_line(Vec2 a, Vec2 b, double width, Rgb color);
  /// The inside of an outline, by the even-odd rule, with even edges. O(pixels covered + crossed rows).
  /// Throws Stopped.
  void fill(std::span<const Vec2> outline, Rgb color, const Execution& execution);

 private:
  void fill_row(std::size_t y, std::span<std::vector<double>> crossings, std::vector<double>& cover, Rgb color);
  void blend(std::size_t x, std::size_t y, double alpha, Rgb color);

  std::size_t width_;
  std::size_t height_;
  RawVector<std::uint8_t> pixels_;
};

/// Encodes with libpng. Throws Stopped between rows.
void write_png_image(const Image& image, const Execution& execution, const Write& write);

}  // namespace warren
