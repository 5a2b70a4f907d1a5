// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/images/png_writer_io.hpp"

#include <png.h>

#include <cmath>
#include <csetjmp>
#include <exception>
#include <new>
#include <stdexcept>
#include <vector>

#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

/// libpng reports by longjmp, so nothing that needs a destructor may live between setjmp and the calls; an exception of
/// `write` is kept and rethrown after.
struct PngSink {
  const std::function<void(std::string_view)>& write;
  std::exception_ptr error;
};

void png_write(png_structp png, png_bytep bytes, png_size_t size) {
  auto* sink = static_cast<PngSink*>(png_get_io_ptr(png));
  try {
    sink->write({reinterpret_cast<const char*>(bytes), size});
    return;
  } catch (...) {
    sink->error = std::current_exception();
  }
  png_error(png, "stopped");
}

void png_flush(png_structp) {}
void png_fail(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void png_warn(png_structp, png_const_charp) {}

/// False when libpng gave up; rows are written while `sink` takes them.
bool encode(png_structp png, png_infop info, const PngRows& rows, PngSink& sink, const Execution& execution) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, &sink, png_write, png_flush);
  png_set_compression_level(png, rows.compression);
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  const bool has_palette = !rows.palette.empty();
  png_set_IHDR(png, info, rows.width, rows.height, has_palette ? 8 : 1,
               has_palette ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (has_palette) {
    png_color colors[PNG_MAX_PALETTE_LENGTH];
    for (std::size_t i = 0; i < rows.palette.size(); ++i) {
      colors[i] = {rows.palette[i][0], rows.palette[i][1], rows.palette[i][2]};
    }
    png_set_PLTE(png, info, colors, static_cast<int>(rows.palette.size()));
    if (!rows.alphas.empty())
      png_set_tRNS(png, info, rows.alphas.data(), static_cast<int>(rows.alphas.size()), nullptr);
  }
  if (rows.dpi > 0.0) {
    constexpr double inches_a_metre = 1.0 / 0.0254;
    const auto per_metre = static_cast<png_uint_32>(std::lround(rows.dpi * inches_a_metre));
    png_set_pHYs(png, info, per_metre, per_metre, PNG_RESOLUTION_METER);
  }
  png_write_info(png, info);
  for (std::size_t y = 0; y < rows.height; ++y) {
    if (execution.should_stop()) return true;
    png_write_row(png, rows.row(y));
  }
  png_write_end(png, info);
  return true;
}

}  // namespace

void write_png(const PngRows& rows, const Execution& execution, const std::function<void(std::string_view)>& write) {
  PngSink sink{write, nullptr};
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, png_fail, png_warn);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) {
    png_destroy_write_struct(&png, nullptr);
    throw std::bad_alloc();
  }
  const bool done = encode(png, info, rows, sink, execution);
  png_destroy_write_struct(&png, &info);
  if (sink.error) std::rethrow_exception(sink.error);
  execution.check();
  if (!done) throw std::bad_alloc();  // libpng takes all that is written here, so it has no memory
}

void write_map_png(const OccupancyMap& map, const std::string& path, const Execution& execution) {
  OutputFile file(path, execution);
  std::vector<std::uint8_t> bytes((map.width() + 7) / 8);
  const auto row = [&](std::size_t from_top) {
    const auto y = static_cast<std::uint32_t>(map.height() - 1 - from_top);
    bytes.assign(bytes.size(), 0);
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      if (!map.blocked.test(x, y)) bytes[x / 8] |= static_cast<std::uint8_t>(0x80U >> (x % 8));
    }
    return static_cast<const std::uint8_t*>(bytes.data());
  };
  write_png({.width = map.width(), .height = map.height(), .row = row}, execution,
            [&](std::string_view piece) { file.write(piece); });
  file.commit();
}

}  // namespace warren
