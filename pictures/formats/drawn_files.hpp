// SPDX-License-Identifier: BSD-3-Clause
// Pages as files of pixels or of PDF, whatever draws on them: pictures of worlds and plots.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/formats/surface.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/page.hpp"

namespace warren {

/// Draws all there is on a surface, and says what was drawn otherwise than usual, a line each.
using DrawOn = std::function<std::vector<std::string>(Surface&)>;

/// What a document says of itself.
struct DocumentWords {
  std::string title;
  std::string subject;
};

/// Both return what `draw` returns; they throw Stopped, and what `draw` and `write` throw.
std::vector<std::string> draw_png(const Page& page, const DrawOn& draw, const Execution& execution, const Write& write);
/// Throws UsageError where can_write_pdf() is false, and for pages too large.
std::vector<std::string> draw_pdf(const Page& page, const DocumentWords& words, const DrawOn& draw,
                                  const Execution& execution, const Write& write);

}  // namespace warren
