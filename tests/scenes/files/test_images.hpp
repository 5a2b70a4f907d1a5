// SPDX-License-Identifier: BSD-3-Clause
// PNG files made by libpng for the readers' tests: any colour type, depth and interlacing, samples by a function.
#pragma once

#include <png.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace warren {

struct PngForm {
  int color_type = PNG_COLOR_TYPE_GRAY;
  int depth = 8;
  bool interlaced = false;
  std::vector<png_color> palette = {};
  std::vector<png_byte> palette_alpha = {};
};

/// sample(x, y, channel), row 0 at the top, below 2^depth.
using SampleAt = std::function<unsigned(unsigned, unsigned, unsigned)>;

inline unsigned channels_of(int color_type) {
  switch (color_type) {
    case PNG_COLOR_TYPE_RGB:
      return 3;
    case PNG_COLOR_TYPE_RGB_ALPHA:
      return 4;
    case PNG_COLOR_TYPE_GRAY_ALPHA:
      return 2;
    default:
      return 1;
  }
}

inline std::vector<png_byte> packed_row(const PngForm& form, unsigned width, unsigned y, const SampleAt& sample) {
  const unsigned channels = channels_of(form.color_type);
  const auto depth = static_cast<unsigned>(form.depth);
  std::vector<png_byte> row((width * channels * depth + 7) / 8, 0);
  for (unsigned i = 0; i < width * channels; ++i) {
    const unsigned value = sample(i / channels, y, i % channels);
    if (depth == 16) {
      row[2 * i] = static_cast<png_byte>(value >> 8);
      row[2 * i + 1] = static_cast<png_byte>(value & 255U);
    } else {
      const unsigned bit = i * depth;
      row[bit / 8] = static_cast<png_byte>(row[bit / 8] | value << (8 - depth - bit % 8));
    }
  }
  return row;
}

inline std::string png_bytes(const PngForm& form, unsigned width, unsigned height, const SampleAt& sample) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, std::size_t size) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(data), size);
      },
      [](png_structp) {});
  png_set_compression_level(png, 1);
  png_set_IHDR(png, info, width, height, form.depth, form.color_type,
               form.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (!form.palette.empty()) png_set_PLTE(png, info, form.palette.data(), static_cast<int>(form.palette.size()));
  if (!form.palette_alpha.empty()) {
    png_set_tRNS(png, info, form.palette_alpha.data(), static_cast<int>(form.palette_alpha.size()), nullptr);
  }
  png_write_info(png, info);
  std::vector<std::vector<png_byte>> rows;
  std::vector<png_bytep> pointers;
  for (unsigned y = 0; y < height; ++y) rows.push_back(packed_row(form, width, y, sample));
  for (auto& row : rows) pointers.push_back(row.data());
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace warren
