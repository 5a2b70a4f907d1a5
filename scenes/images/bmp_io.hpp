// SPDX-License-Identifier: BSD-3-Clause
// BMP in: uncompressed, of 1, 4 or 8 bits with a palette, 24, or 32 whose fourth byte is alpha, as Nav2's map saver
// writes them and its server reads them.
#pragma once

#include "scenes/images/image_io.hpp"

namespace warren {

/// As read_image, for a BMP.
void read_bmp(const InputFile& file, const ImageSink& sink, const Execution& execution);

}  // namespace warren
