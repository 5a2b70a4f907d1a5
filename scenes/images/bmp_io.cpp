// SPDX-License-Identifier: BSD-3-Clause
// Offsets are those of BITMAPFILEHEADER (14 bytes) and BITMAPINFOHEADER (40 and more); numbers are little-endian. A row
// is as many whole words of 32 bits as its pixels need, the lowest row first unless the height is negative.
#include "scenes/images/bmp_io.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/base/error.hpp"
#include "scenes/scene/occupancy_map.hpp"

namespace warren {
namespace {

constexpr std::size_t file_header_bytes = 14;

std::uint32_t number_at(std::string_view bytes, std::size_t at, unsigned size = 4) {
  std::uint32_t number = 0;
  while (size-- > 0) number = number << 8U | static_cast<unsigned char>(bytes[at + size]);
  return number;
}

struct Layout {
  ImageHeader header;
  unsigned bits = 0;  ///< of a pixel
  bool is_top_down = false;
  std::string_view palette;  ///< four bytes a colour: blue, green, red, nothing
  std::size_t row_bytes = 0;
  std::string_view rows;
};

/// What the bits of a pixel are; false: another kind of BMP.
bool read_kind(std::string_view bytes, Layout& layout) {
  const std::uint32_t coding = number_at(bytes, 30);
  layout.bits = number_at(bytes, 28, 2);
  bool has_alpha = layout.bits == 32;
  if (coding == 3 && layout.bits == 32 && bytes.size() >= 70) {  // its masks must be those of blue, green, red, alpha
    has_alpha = number_at(bytes, 14) >= 56 && number_at(bytes, 66) == 0xff000000;
    if (number_at(bytes, 54) != 0xff0000 || number_at(bytes, 58) != 0xff00 || number_at(bytes, 62) != 0xff)
      return false;
  } else if (coding != 0) {
    return false;
  }
  layout.header.channels = has_alpha ? 4 : 3;
  return layout.bits == 1 || layout.bits == 4 || layout.bits == 8 || layout.bits == 24 || layout.bits == 32;
}

/// Without masks the fourth byte of pixels means nothing, and is 0, but where a writer has put alpha there.
bool has_fourth_bytes(const Layout& layout, const Execution& execution) {
  constexpr std::size_t bytes_a_look = 1 << 16;
  for (std::size_t at = 3; at < layout.row_bytes * layout.header.height; at += 4) {
    if (at % bytes_a_look == 3) execution.check();
    if (layout.rows[at] != 0) return true;
  }
  return false;
}

Layout layout_of(const InputFile& file, const Execution& execution) {
  const std::string_view bytes = file.bytes();
  Layout layout;
  if (bytes.size() < file_header_bytes + 40 || number_at(bytes, 14) < 40 || !read_kind(bytes, layout)) {
    throw InputError(file.name(), "expected a BMP of 1, 4, 8, 24 or 32 bits a pixel that is not compressed");
  }
  const auto width = static_cast<std::int32_t>(number_at(bytes, 18));
  const std::int64_t height = static_cast<std::int32_t>(number_at(bytes, 22));
  layout.is_top_down = height < 0;
  check_map_size(file.name(), static_cast<std::uint64_t>(std::max(width, 0)),
                 static_cast<std::uint64_t>(std::abs(height)));
  layout.header.width = static_cast<std::uint32_t>(width);
  layout.header.height = static_cast<std::uint32_t>(std::abs(height));
  layout.row_bytes = (std::size_t{layout.bits} * layout.header.width + 31) / 32 * 4;
  const std::size_t first = std::min<std::size_t>(number_at(bytes, 10), bytes.size());
  layout.rows = bytes.substr(first);
  if (layout.rows.size() / layout.row_bytes < layout.header.height) {
    throw InputError(file.name(),
                     fmt::format("expected {} x {} pixels, {} bytes after the header", layout.header.width,
                                 layout.header.height, layout.row_bytes * layout.header.height),
                     fmt::format("{} bytes", layout.rows.size()));
  }
  const bool has_masks = number_at(bytes, 30) != 0;
  if (layout.bits == 32 && !has_masks && !has_fourth_bytes(layout, execution)) layout.header.channels = 3;
  if (layout.bits > 8) return layout;
  const std::size_t head = file_header_bytes + std::size_t{number_at(bytes, 14)};
  const std::size_t colours = number_at(bytes, 46) == 0 ? std::size_t{1} << layout.bits : number_at(bytes, 46);
  layout.palette = head < first ? bytes.substr(head, std::min(4 * colours, first - head)) : std::string_view();
  return layout;
}

/// Blue, green, red and, where there is alpha, alpha of a pixel.
std::string_view pixel_of(const Layout& layout, std::string_view row, std::size_t x, const InputFile& file) {
  if (layout.bits > 8) return row.substr(x * layout.bits / 8, layout.bits / 8);
  const std::size_t bit = x * layout.bits;
  const unsigned shift = 8U - layout.bits - static_cast<unsigned>(bit % 8);  // the leftmost pixel stands highest
  const std::size_t colour = (number_at(row, bit / 8, 1) >> shift) & ((1U << layout.bits) - 1U);
  if (4 * colour + 4 > layout.palette.size()) {
    throw InputError(file.name(), fmt::format("expected pixels of the palette's {} colours", layout.palette.size() / 4),
                     fmt::format("{}", colour));
  }
  return layout.palette.substr(4 * colour, 4);
}

}  // namespace

void read_bmp(const InputFile& file, const ImageSink& sink, const Execution& execution) {
  constexpr std::size_t pixels_a_look = 1 << 14;
  const Layout layout = layout_of(file, execution);
  const auto& [width, height, channels, maximum] = layout.header;
  sink.begin(layout.header);
  execution.reserve(sizeof(std::uint16_t) * channels * width);
  std::vector<std::uint16_t> samples(std::size_t{channels} * width);
  for (std::uint32_t i = 0; i < height; ++i) {
    const std::string_view row = layout.rows.substr(i * layout.row_bytes, layout.row_bytes);
    for (std::size_t x = 0; x < width; ++x) {
      if (x % pixels_a_look == 0) execution.check();
      const std::string_view pixel = pixel_of(layout, row, x, file);
      std::uint16_t* const to = samples.data() + channels * x;
      for (const unsigned c : {0U, 1U, 2U}) to[c] = static_cast<unsigned char>(pixel[2 - c]);
      if (channels == 4) to[3] = static_cast<unsigned char>(pixel[3]);
    }
    sink.row({layout.is_top_down ? i : height - 1 - i, 0, 1, samples});
  }
}

}  // namespace warren
