// SPDX-License-Identifier: BSD-3-Clause
// Axes around a part of a page, and the scale bar.
#pragma once

#include <optional>
#include <string_view>

#include "pictures/model/page.hpp"

namespace warren {

inline constexpr double page_text_size = 12.5;  ///< of all but the title
inline constexpr double tick_length = 4.0;
inline constexpr double swatch_gap = 8.0;  ///< between a swatch and its words

/// Frame, ticks and names around `at`; the page's view is there. name_at: where the name of the upright axis stands;
/// none: both names stand inside.
void add_axes(Page& page, const AxesPanel& panel, Box at, std::optional<double> name_at);

/// A round length with its ends marked, from `at` to the right.
void add_scale_bar(Page& page, Vec2 at, std::string_view unit);

}  // namespace warren
