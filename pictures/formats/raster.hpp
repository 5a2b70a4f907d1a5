// SPDX-License-Identifier: BSD-3-Clause
// Pixels in memory, and lines and areas drawn on them with even edges. A line thinner than a pixel is drawn a pixel
// wide and fainter instead: many of them add up to a shade, so that a picture stays readable at any scale.
//
// Cairo (libcairo2 1.16) was weighed in place of this, of the letters and of libharu, and left: at most 787 lines go
// for it, before a surface for both formats, masks, images, a font by FreeType and a table of the letters' widths come,
// by which pages of all formats are laid out. Its images end at 32,767 pixels a side (5 m at 250 dpi have 49,213), it
// took 2.1 to 2.6 times as long for 300,000 short lines, and a path, once begun, asks no clock. Its pixels were the
// same on x86-64 and arm64, 333 million of them, and so were the bytes of a PDF whose date is given.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/colors.hpp"
#include "pictures/model/picture.hpp"

namespace warren {

/// Of a place along an axis, the pixel there, at most `most`.
inline std::size_t pixel_at(double place, std::size_t most) {
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(most)));
}

/// Row 0 is the top row; 3 bytes a pixel.
class Image {
 public:
  /// All paper.
  Image(std::size_t width, std::size_t height, const Execution& execution);

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  const std::uint8_t* row(std::size_t y) const { return pixels_.data() + 3 * width_ * y; }
  std::uint8_t* row(std::size_t y) { return pixels_.data() + 3 * width_ * y; }

  /// A line with round ends; coordinates in pixels from the upper left corner, y down. O(pixels covered + rows).
  void draw_line(Vec2 a, Vec2 b, double width, Rgb color, double opacity = 1.0);
  /// The inside of outlines, by the even-odd rule, with even edges. O(pixels covered + crossed rows).
  /// Throws Stopped.
  void fill(const PolygonSet& outlines, Rgb color, double opacity, const Execution& execution);

 private:
  std::size_t width_;
  std::size_t height_;
  RawVector<std::uint8_t> pixels_;
};

/// How much of each pixel is covered by what has one colour: a byte a pixel, row 0 on top.
class Mask {
 public:
  Mask(std::size_t width, std::size_t height, const Execution& execution);

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  std::span<const std::uint8_t> pixels() const { return {pixels_.data(), width_ * height_}; }
  /// As Image's.
  void draw_line(Vec2 a, Vec2 b, double width, double opacity = 1.0);
  void fill(const PolygonSet& outlines, double opacity, const Execution& execution);

 private:
  std::size_t width_;
  std::size_t height_;
  RawVector<std::uint8_t> pixels_;
};

// Solids in perspective (solid_raster.cpp): whatever is nearest to the eye is seen, however the solids lie among each
// other.

/// Those of the parts that are shown. O(solids + pixels that each may cover). Throws Stopped.
Image draw_solids(const SolidView& view, Parts parts, std::size_t width, std::size_t height,
                  const Execution& execution);

/// How far from the eye a ray of length 1 enters the solid; infinite where it passes by; < 0 where it is behind.
double enter_solid(const Vec3& eye, const Vec3& ray, const SeenSolid& s);

/// Outwards, of length 1, at a place on its surface.
Vec3 normal_at(const Vec3& p, const SeenSolid& s);

// Pixels as PNG with a palette: the most frequent colours of an image; a mask in sixteen shades of one colour.

/// dpi is told to those who print. Throws Stopped between rows.
void write_png_file(const Image& image, double dpi, const Execution& execution, const Write& write);

/// Transparent where nothing is covered.
void write_png_file(const Mask& mask, Rgb color, const Execution& execution, const Write& write);

}  // namespace warren
