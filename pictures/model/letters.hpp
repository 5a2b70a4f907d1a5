// SPDX-License-Identifier: BSD-3-Clause
// Text as areas, and how wide it is: the same on every machine. ASCII and Latin-1; any other character is a question
// mark.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/embedded_file.hpp"
#include "core/plane/polygon.hpp"

namespace warren {

/// The files of pictures/letters, which the build embeds: their licence, then the outlines.
std::span<const EmbeddedFile> letter_files();

/// Advance of a line of UTF-8 in letters of that size.
double text_width(std::string_view text, double size);

/// Outlines of the letters, each a contour, filled by the even-odd rule; the line begins at the origin and runs to the
/// right, y down.
PolygonSet text_outlines(std::string_view text, double size);

/// The line cut to what fits, with "..." where something is left out.
std::string fitting_text(const std::string& text, double size, double width);

/// The same, with "..." in its middle.
std::string fitting_ends(const std::string& text, double size, double width);

/// The text in as few lines as fit, cut behind commas and semicolons, and at other blanks only between two of those
/// that are further apart than a line.
std::vector<std::string> wrapped_text(const std::string& text, double size, double width);

/// The characters of ISO 8859-1, a byte each; others are question marks.
std::string latin1_text(std::string_view text);

}  // namespace warren
