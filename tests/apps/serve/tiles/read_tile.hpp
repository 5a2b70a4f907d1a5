// SPDX-License-Identifier: BSD-3-Clause
// A tile's PNG as the darkness of its pixels.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/serve/tiles/web_tile.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren::test {

class GreyTile {
 public:
  bool empty() const { return pixels_.empty(); }
  /// 0 paper .. 1 black.
  double darkness(std::size_t x, std::size_t y) const { return pixels_.at(y * serve::TileGrid::pixels + x); }
  std::vector<double>& pixels() { return pixels_; }

 private:
  std::vector<double> pixels_;
};

inline GreyTile read_tile(const std::string& png) {
  GreyTile tile;
  tile.pixels().assign(std::size_t{serve::TileGrid::pixels} * serve::TileGrid::pixels, -1.0);
  ImageHeader header;
  const ImageSink sink{[&](const ImageHeader& h) { header = h; },
                       [&](const PixelRun& run) {
                         for (std::size_t i = 0; i * header.channels < run.samples.size(); ++i) {
                           double light = 0.0;
                           const std::size_t colors = header.channels - (header.has_alpha() ? 1 : 0);
                           for (std::size_t c = 0; c < colors; ++c) light += run.samples[i * header.channels + c];
                           tile.pixels()[run.y * serve::TileGrid::pixels + run.first_x + i * run.step_x] =
                               1.0 - light / static_cast<double>(colors * header.maximum);
                         }
                       }};
  read_image(InputFile::of_bytes("tile", png), sink, {});
  return tile;
}

}  // namespace warren::test
