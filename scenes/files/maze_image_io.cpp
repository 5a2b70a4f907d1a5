// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/maze_image_io.hpp"

#include <numeric>
#include <optional>

#include "scenes/files/image_io.hpp"

namespace warren {
namespace {

/// Sets the bits of dark pixels.
class Darkness {
 public:
  Darkness(const ImageHeader& header, Bitmap& dark) : header_(header), dark_(dark) {}

  void row(const PixelRun& run) const {
    const std::uint32_t y = header_.height - 1 - run.y;
    if (header_.channels == 1 && run.step_x == 1) return grey_row(run.samples, dark_.row(y));
    std::uint32_t x = run.first_x;
    for (const std::uint16_t* pixel = run.samples.data(); pixel != run.samples.data() + run.samples.size();
         pixel += header_.channels, x += run.step_x) {
      if (is_dark(pixel)) dark_.set(x, y);
    }
  }

 private:
  /// Below 128 of 255: 255 v < 128 maximum.
  bool is_dark(std::uint64_t sum, std::uint64_t maximum) const { return 255 * sum < 128 * maximum; }

  bool is_dark(const std::uint16_t* pixel) const {
    const unsigned colours = header_.channels - (header_.has_alpha() ? 1 : 0);
    const std::uint64_t sum = std::accumulate(pixel, pixel + colours, std::uint64_t{0});
    const std::uint64_t brightest = std::uint64_t{colours} * header_.maximum;
    if (!header_.has_alpha()) return is_dark(sum, brightest);
    const std::uint64_t alpha = pixel[colours];
    return is_dark(alpha * sum + (header_.maximum - alpha) * brightest, header_.maximum * brightest);
  }

  void grey_row(std::span<const std::uint16_t> samples, std::span<std::uint64_t> words) const {
    for (std::size_t w = 0; w < words.size(); ++w) {
      const auto part = samples.subspan(w * 64, std::min<std::size_t>(64, samples.size() - w * 64));
      std::uint64_t word = 0;
      for (std::size_t i = 0; i < part.size(); ++i) {
        word |= std::uint64_t{is_dark(part[i], header_.maximum)} << i;
      }
      words[w] = word;
    }
  }

  ImageHeader header_;
  Bitmap& dark_;
};

/// The middle of the only free cell of a row.
std::optional<Vec2> opening(const OccupancyMap& map, std::uint32_t y) {
  std::optional<Vec2> found;
  for (std::uint32_t x = 0; x < map.width(); ++x) {
    if (map.blocked.test(x, y)) continue;
    if (found) return std::nullopt;
    found = cell_centre(map, {x, y});
  }
  return found;
}

}  // namespace

OccupancyMap read_maze_image(const InputFile& file, const Execution& execution) {
  OccupancyMap map;
  map.format = MapFormat::image;
  map.source = file.name();
  std::optional<Darkness> darkness;
  const auto begin = [&](const ImageHeader& header) {
    map.blocked = cell_bitmap(header.width, header.height, execution);
    darkness.emplace(header, map.blocked);
  };
  read_image(file, {begin, [&](const PixelRun& run) { darkness->row(run); }}, execution);
  map.occupied = map.blocked.count();
  map.free = map.blocked.size() - map.occupied;
  map.start = opening(map, map.height() - 1);
  if (map.height() > 1) map.goal = opening(map, 0);
  return map;
}

}  // namespace warren
