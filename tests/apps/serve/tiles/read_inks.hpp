// SPDX-License-Identifier: BSD-3-Clause
// The pixels of a tile that lies above the world's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/serve/tiles/web_tile.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren::test {

/// Red, green, blue, opacity.
using InkPixel = std::array<unsigned, 4>;

inline std::vector<InkPixel> read_inks(const std::string& png) {
  std::vector<InkPixel> pixels(std::size_t{serve::TileGrid::pixels} * serve::TileGrid::pixels, {0, 0, 0, 0});
  ImageHeader header;
  const ImageSink sink{[&](const ImageHeader& h) { header = h; },
                       [&](const PixelRun& run) {
                         for (std::size_t i = 0; i * header.channels < run.samples.size(); ++i) {
                           InkPixel& pixel = pixels.at(run.y * serve::TileGrid::pixels + run.first_x + i * run.step_x);
                           for (std::size_t c = 0; c < header.channels && c < 4; ++c) {
                             pixel[c] = static_cast<unsigned>(run.samples[i * header.channels + c]);
                           }
                         }
                       }};
  read_image(InputFile::of_bytes("tile", png), sink, {});
  return pixels;
}

}  // namespace warren::test
