// SPDX-License-Identifier: BSD-3-Clause
// Colours are counted in boxes of 8 x 8 x 8 values; a box's colour is its mean, white stays white. The 255 boxes with
// most pixels make the palette, each other box takes the nearest of them.
#include "pictures/formats/png_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "scenes/images/png_writer_io.hpp"

namespace warren {
namespace {

constexpr std::size_t most_colors = 256;
constexpr std::size_t box_count = std::size_t{1} << 15U;

std::size_t box_of_pixel(const std::uint8_t* p) {
  return static_cast<std::size_t>(p[0] >> 3) << 10U | static_cast<std::size_t>(p[1] >> 3) << 5U | p[2] >> 3;
}

using Color = std::array<std::uint8_t, 3>;

/// Means of the boxes and how often they occur.
class ColorCount {
 public:
  ColorCount(const Image& image, const Execution& execution) : sums_(box_count), counts_(box_count, 0) {
    for (std::size_t y = 0; y < image.height(); ++y) {
      if (y % 64 == 0) execution.check();
      const std::uint8_t* row = image.row(y);
      for (std::size_t x = 0; x < image.width(); ++x) {
        const std::uint8_t* pixel = row + 3 * x;
        const std::size_t box = box_of_pixel(pixel);
        ++counts_[box];
        for (std::size_t c = 0; c < 3; ++c) sums_[box][c] += pixel[c];
      }
    }
  }
  std::uint64_t count(std::size_t box) const { return counts_[box]; }
  Color mean(std::size_t box) const {
    Color color;
    for (std::size_t c = 0; c < 3; ++c) {
      color[c] = static_cast<std::uint8_t>((sums_[box][c] + counts_[box] / 2) / counts_[box]);
    }
    return color;
  }

 private:
  std::vector<std::array<std::uint64_t, 3>> sums_;
  std::vector<std::uint64_t> counts_;
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

/// A palette, and where in it the colours of each box are.
struct ImagePalette {
  std::vector<Color> colors;
  std::vector<std::uint8_t> of_box;
};

ImagePalette palette_of(const Image& image, const Execution& execution) {
  const ColorCount count(image, execution);
  std::vector<std::size_t> boxes;
  for (std::size_t box = 0; box < box_count; ++box) {
    if (count.count(box) > 0) boxes.push_back(box);
  }
  std::stable_sort(boxes.begin(), boxes.end(),
                   [&](std::size_t a, std::size_t b) { return count.count(a) > count.count(b); });
  constexpr Color white{255, 255, 255};
  ImagePalette palette{{white}, std::vector<std::uint8_t>(box_count, 0)};
  for (const std::size_t box : boxes) {
    if (box == box_count - 1) continue;  // white's
    const bool has_room = palette.colors.size() < most_colors;
    if (has_room) palette.colors.push_back(count.mean(box));
    palette.of_box[box] =
        has_room ? static_cast<std::uint8_t>(palette.colors.size() - 1) : nearest(count.mean(box), palette.colors);
  }
  return palette;
}

}  // namespace

void write_png_file(const Image& image, double dpi, const Execution& execution, const Write& write) {
  const ImagePalette palette = palette_of(image, execution);
  std::vector<std::uint8_t> row(image.width());
  write_png({.width = static_cast<std::uint32_t>(image.width()),
             .height = static_cast<std::uint32_t>(image.height()),
             .palette = palette.colors,
             .dpi = dpi,
             .row =
                 [&](std::size_t y) {
                   const std::uint8_t* pixels = image.row(y);
                   for (std::size_t x = 0; x < row.size(); ++x) row[x] = palette.of_box[box_of_pixel(pixels + 3 * x)];
                   return static_cast<const std::uint8_t*>(row.data());
                 }},
            execution, write);
}

void write_png_file(const Mask& mask, Rgb color, const Execution& execution, const Write& write) {
  constexpr std::size_t shades = 16;
  std::vector<std::uint8_t> alphas(shades);
  for (std::size_t i = 0; i < shades; ++i) alphas[i] = static_cast<std::uint8_t>(17 * i);
  std::vector<std::uint8_t> row(mask.width());
  write_png({.width = static_cast<std::uint32_t>(mask.width()),
             .height = static_cast<std::uint32_t>(mask.height()),
             .palette = std::vector<Color>(shades, Color{color.red, color.green, color.blue}),
             .alphas = alphas,
             .row =
                 [&](std::size_t y) {
                   const std::uint8_t* pixels = mask.pixels().data() + y * mask.width();
                   for (std::size_t x = 0; x < row.size(); ++x)
                     row[x] = static_cast<std::uint8_t>((pixels[x] + 8) / 17);
                   return static_cast<const std::uint8_t*>(row.data());
                 }},
            execution, write);
}

}  // namespace warren
