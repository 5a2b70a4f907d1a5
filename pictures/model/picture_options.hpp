// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a picture: its size, its title, and which parts are shown.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/enum_names.hpp"

namespace warren {

/// A part of pictures that can be left out.
enum class Part : std::uint8_t { world, roadmap, search, path, body, axes, legend };
constexpr auto enum_names(Part) {
  return std::array<std::string_view, 7>{"world", "roadmap", "search", "path", "body", "axes", "legend"};
}

/// Which parts a picture shows.
using Parts = EnumSet<Part>;

/// What sizes of pages are given in.
enum class LengthUnit : std::uint8_t { px, mm };
constexpr auto enum_names(LengthUnit) { return std::array<std::string_view, 2>{"px", "mm"}; }

/// How large a picture is.
struct PageSize {
  double width = 0.0;                ///< 40 .. 20,000 px or 10 .. 5,000 mm
  double height = 0.0;               ///< the same
  LengthUnit unit = LengthUnit::px;  ///< a px is a pixel of a PNG, elsewhere 1/dpi inch
};

/// How a picture looks.
struct PictureOptions {
  std::optional<PageSize> size = {};      ///< none: as large as the world asks for
  std::optional<double> dpi = {};         ///< pixels an inch, 10 .. 2400; none: 96, in a PNG what the world asks for
  std::optional<std::string> title = {};  ///< none: the world and how it was solved; empty: no title
  Parts parts = Parts::all();             ///< those that are shown
  /// Of a body that turns, radians: the places without room for it at that heading are shown, and states as arrows.
  std::optional<double> heading = {};

  /// Throws UsageError for a size that no page has: 40 .. 20,000 px or 10 .. 5,000 mm a side, dpi outside its range.
  void validate() const;
};

}  // namespace warren
