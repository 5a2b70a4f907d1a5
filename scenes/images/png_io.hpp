// SPDX-License-Identifier: BSD-3-Clause
// PNG in, by libpng: every colour type, depth and interlacing, row by row.
#pragma once

#include "scenes/images/image_io.hpp"

namespace warren {

/// As read_image, for a PNG.
void read_png(const InputFile& file, const ImageSink& sink, const Execution& execution);

}  // namespace warren
