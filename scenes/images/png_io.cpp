// SPDX-License-Identifier: BSD-3-Clause
// libpng reports errors by longjmp, so no object with a destructor lives in a frame that it may leave: buffers stand in
// PngInput, whose owner calls decode. Interlaced images are taken pass by pass as they come (a pass is a picture of
// every 8th, 4th, 2nd pixel), which spares the memory of a whole picture.
#include "scenes/images/png_io.hpp"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/scene/occupancy_map.hpp"

namespace warren {
namespace {

struct PngInput {
  std::string_view rest;
  const Execution& execution;
  std::string error;
  std::size_t bits_a_pixel = 0;        // as the file has them
  std::vector<png_byte> bytes;         // one row as libpng gives it
  std::vector<std::uint16_t> samples;  // the same, widened
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

/// Header and transformations; what is left are 8 or 16 bits a sample, 1 to 4 channels. False when libpng gave up.
bool begin(png_structp png, png_infop info, PngInput& input, ImageHeader& header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
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
  return true;
}

bool next_row(png_structp png, png_bytep to) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_row(png, to, nullptr);
  return true;
}

bool end(png_structp png) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_end(png, nullptr);
  return true;
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
class PngReader {
 public:
  explicit PngReader(PngInput& input)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, png_fail, png_warn)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) throw std::bad_alloc();
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
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

}  // namespace

void read_png(const InputFile& file, const ImageSink& sink, const Execution& execution) {
  PngInput input{
      .rest = file.bytes(), .execution = execution, .error = {}, .bits_a_pixel = 0, .bytes = {}, .samples = {}};
  const auto fail = [&] {
    execution.check();
    throw InputError(file.name(), "expected a whole PNG image: " + input.error);
  };
  const PngReader reader(input);
  ImageHeader header;
  if (!begin(reader.png(), reader.info(), input, header)) fail();
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
      if (!next_row(reader.png(), input.bytes.data())) fail();
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
  if (!end(reader.png())) fail();
}

}  // namespace warren
