// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/images/image_io.hpp"

#include "core/base/error.hpp"
#include "scenes/images/bmp_io.hpp"
#include "scenes/images/pgm_io.hpp"
#include "scenes/images/png_io.hpp"

namespace warren {

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG"); }

bool is_bmp(std::string_view bytes) {
  return bytes.size() > 17 && bytes.starts_with("BM") && bytes.substr(15, 3) == std::string_view("\0\0\0", 3);
}

bool is_pgm(std::string_view bytes) {
  return bytes.size() > 2 && (bytes.starts_with("P5") || bytes.starts_with("P2")) &&
         std::string_view(" \t\r\n#").find(bytes[2]) != std::string_view::npos;
}

void read_image(const InputFile& file, const ImageSink& sink, const Execution& execution) {
  if (is_png(file.bytes())) return read_png(file, sink, execution);
  if (is_pgm(file.bytes())) return read_pgm(file, sink, execution);
  if (is_bmp(file.bytes())) return read_bmp(file, sink, execution);
  throw InputError(file.name(), "expected a PNG, PGM (magic P5 or P2) or BMP image");
}

}  // namespace warren
