// SPDX-License-Identifier: BSD-3-Clause
// libpng reports errors by longjmp, so no object with a destructor lives in a frame that it may leave: buffers stand in
// PngInput, whose owner calls decode. Interlaced images are taken pass by pass as they come (a pass is a picture of
// every 8th, 4th, 2nd pixel), which spares the memory of a whole picture.

#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <new>

#include "core/base/error.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

struct PngInput {
  std::string_view rest;
  const Execution& execution;
  std::string error = {};
  std::size_t bits_a_pixel = 0;             // as the file has them
  std::vector<png_byte> bytes = {};         // one row as libpng gives it
  std::vector<std::uint16_t> samples = {};  // the same, widened
};

void png_take(png_structp png, png_bytep to, std::size_t size) {
  auto* input = static_cast<PngInput*>(png_get_io_ptr(png));
  if (input->execution.should_stop()) png_error(png, "stopped");  // at most 8 KiB are taken, 8 MiB inflated, at once
  if (size > input->rest.size()) png_error(png, "the file ends too early");
  std::memcpy(to, input->rest.data(), size);
  input->rest.remove_prefix(size);
}

void png_fail(png_structp png, png_const_charp why) {
  static_cast<PngInput*>(png_get_error_ptr(png))->error = why;
  png_longjmp(png, 1);
}
void png_warn(png_structp, png_const_charp) {}

/// False when libpng gave up.
template <class Call>
bool succeeds(png_structp png, const Call& call) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  call();
  return true;
}

/// Header and transformations; what is left are 8 or 16 bits a sample, 1 to 4 channels.
void begin(png_structp png, png_infop info, PngInput& input, ImageHeader& header) {
  png_set_read_fn(png, &input, png_take);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // texts, profiles, times: none is looked at
  png_read_info(png, info);
  input.bits_a_pixel = std::size_t{png_get_bit_depth(png, info)} * png_get_channels(png, info);
  png_set_expand(png);
  png_read_update_info(png, info);
  header.width = png_get_image_width(png, info);
  header.height = png_get_image_height(png, info);
  header.channels = png_get_channels(png, info);
  header.maximum = png_get_bit_depth(png, info) == 16 ? 65535 : 255;
}

void widen(const ImageHeader& header, std::size_t count, PngInput& input) {
  const png_byte* from = input.bytes.data();
  std::uint16_t* to = input.samples.data();
  if (header.maximum == 255) {
    for (std::size_t i = 0; i < count; ++i) to[i] = from[i];
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::uint16_t>(from[2 * i] << 8 | from[2 * i + 1]);
  }
}

/// Owns libpng's two structs.
class PngReader : NotCopied {
 public:
  explicit PngReader(PngInput& input)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, png_fail, png_warn)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) throw std::bad_alloc();
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  png_structp png() const { return png_; }
  png_infop info() const { return info_; }

 private:
  png_structp png_;
  png_infop info_;
};

/// Before anybody makes room for the pixels: deflate makes at most 1032 bytes of one.
void check_pixels_are_there(const InputFile& file, const ImageHeader& header, std::size_t bits_a_pixel) {
  constexpr std::uint64_t most_inflated = 1032;
  const std::uint64_t bytes = std::uint64_t{header.width} * header.height * bits_a_pixel / 8;
  if (bytes / most_inflated <= file.bytes().size()) return;
  throw InputError(file.name(), "expected a whole PNG image: no " + std::to_string(file.bytes().size()) +
                                    " bytes hold " + std::to_string(header.width) + " x " +
                                    std::to_string(header.height) + " pixels");
}

/// An exception of `write` is kept and rethrown after.
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
void give_up(png_structp png, png_const_charp) { png_longjmp(png, 1); }

/// Rows are written while `sink` takes them.
void encode(png_structp png, png_infop info, const PngRows& rows, PngSink& sink, const Execution& execution) {
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
    if (execution.should_stop()) return;
    png_write_row(png, rows.row(y));
  }
  png_write_end(png, info);
}

}  // namespace

void read_png(const InputFile& file, const ImageSink& sink, const Execution& execution) {
  PngInput input{file.bytes(), execution};
  const auto fail = [&] {
    execution.check();
    throw InputError(file.name(), "expected a whole PNG image: " + input.error);
  };
  const PngReader reader(input);
  ImageHeader header;
  if (!succeeds(reader.png(), [&] { begin(reader.png(), reader.info(), input, header); })) fail();
  check_map_size(file.name(), header.width, header.height);
  check_pixels_are_there(file, header, input.bits_a_pixel);
  sink.begin(header);
  const std::size_t row_samples = std::size_t{header.width} * header.channels;
  execution.reserve(8 * row_samples);  // two of libpng's rows, of two bytes a sample, and our two
  input.bytes.resize(png_get_rowbytes(reader.png(), reader.info()));
  input.samples.resize(row_samples);
  const bool interlaced = png_get_interlace_type(reader.png(), reader.info()) == PNG_INTERLACE_ADAM7;
  for (int pass = 0; pass < (interlaced ? PNG_INTERLACE_ADAM7_PASSES : 1); ++pass) {
    const std::uint32_t cols = interlaced ? PNG_PASS_COLS(header.width, pass) : header.width;
    const std::uint32_t rows = interlaced ? PNG_PASS_ROWS(header.height, pass) : header.height;
    if (cols == 0) continue;
    for (std::uint32_t r = 0; r < rows; ++r) {
      execution.check();
      if (!succeeds(reader.png(), [&] { png_read_row(reader.png(), input.bytes.data(), nullptr); })) fail();
      const std::size_t count = std::size_t{cols} * header.channels;
      widen(header, count, input);
      const std::span<const std::uint16_t> samples(input.samples.data(), count);
      if (!interlaced) {
        sink.row({r, 0, 1, samples});
        continue;
      }
      const auto y = static_cast<std::uint32_t>(PNG_ROW_FROM_PASS_ROW(r, pass));
      const auto first_x = static_cast<std::uint32_t>(PNG_PASS_START_COL(pass));
      sink.row({y, first_x, std::uint32_t{1} << PNG_PASS_COL_SHIFT(pass), samples});
    }
  }
  if (!succeeds(reader.png(), [&] { png_read_end(reader.png(), nullptr); })) fail();
}

void write_png(const PngRows& rows, const Execution& execution, const std::function<void(std::string_view)>& write) {
  PngSink sink{write, nullptr};
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, give_up, png_warn);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) {
    png_destroy_write_struct(&png, nullptr);
    throw std::bad_alloc();
  }
  const bool done = succeeds(png, [&] { encode(png, info, rows, sink, execution); });
  png_destroy_write_struct(&png, &info);
  if (sink.error) std::rethrow_exception(sink.error);
  execution.check();
  if (!done) throw std::bad_alloc();  // libpng takes all that is written here, so it has no memory
}

void write_map_png(const OccupancyMap& map, const std::string& path, const Execution& execution) {
  OutputFile file(path, execution);
  execution.reserve(map.width() / 8);
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
