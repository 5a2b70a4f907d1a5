// SPDX-License-Identifier: BSD-3-Clause
// Pictures as files: SVG, PNG, PDF, HTML, the same in all of them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "pictures/model/picture.hpp"

namespace warren {

using Write = std::function<void(std::string_view)>;

/// One SVG 1.1 document. Returns what is drawn otherwise than usual, being so many, a line each. Throws Stopped, and
/// what `write` throws; so do the others.
std::vector<std::string> write_svg(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                   const Write& write);
/// A page of its own with the SVG inline; drag moves, the wheel zooms.
std::vector<std::string> write_html(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                    const Write& write);
/// In pixels: what is smaller than a pixel becomes a shade, the path stays strong.
std::vector<std::string> write_png(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                   const Write& write);
/// One page, its words in Helvetica. Throws UsageError where can_write_pdf() is false, and for pages too large.
std::vector<std::string> write_pdf(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                   const Write& write);

/// Was libharu there when this was built?
bool can_write_pdf();

/// ".svg" of "a.SVG", in lower case; "" where there is none.
std::string ending_of(const std::string& file);

/// The endings that write_picture knows: ".svg .png .pdf .html".
inline constexpr std::string_view picture_endings = ".svg .png .pdf .html";
bool is_picture(std::string_view ending);

/// By the file's ending: .png, .pdf, .html, and SVG for all others. Throws UsageError for options that no picture can
/// have, WriteError, Stopped.
std::vector<std::string> write_picture(const std::string& file, const Picture& picture, const PictureOptions& options,
                                       const Execution& execution);

}  // namespace warren
