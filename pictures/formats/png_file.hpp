// SPDX-License-Identifier: BSD-3-Clause
// Pixels as PNG with a palette: the most frequent colours of an image; a mask in sixteen shades of one colour.
#pragma once

#include "parallel/execution.hpp"
#include "pictures/formats/raster.hpp"
#include "pictures/formats/write_picture.hpp"

namespace warren {

/// dpi is told to those who print. Throws Stopped between rows.
void write_png_file(const Image& image, double dpi, const Execution& execution, const Write& write);

/// Transparent where nothing is covered.
void write_png_file(const Mask& mask, Rgb color, const Execution& execution, const Write& write);

}  // namespace warren
