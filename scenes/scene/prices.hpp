// SPDX-License-Identifier: BSD-3-Clause
// What a path costs beside its length, as plain data; what planners and judges of prices have in common. For a path of
// the reference point, by arc length s:
//
//   cost = integral of f ds + P * integral of phi(delta / D) ds + turning + cusps + reversing
//
// f is the greatest factor of the open areas, the mask's cells and the unknown cells around the place, else 1. delta is
// the distance of the body (of a disc: of its rim) to what it may not touch, phi(u) = (1 - u)^2 where u < 1, else 0.
// So P reads: a metre in touch with an obstacle costs P metres more, from D on nothing. Cost is at least length, adds
// up over the pieces of a path and depends on no cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

/// No price or factor is above: sums of whole numbers hold it.
inline constexpr double largest_price = 1000.0;

/// P and D above.
struct ClearancePrice {
  double price = 0.0;  ///< a unit of length in touch with an obstacle costs so much more; 0 .. largest_price
  std::optional<double> reach = {};  ///< from so far on nothing is paid, > 0; none: the body's least width
};

/// A simple polygon as its file gives it.
struct ScenePolygon {
  std::vector<Vec2> corners;  ///< in order, either orientation, the last joined to the first
  std::size_t line = 0;       ///< of its file, from 1; 0: none
};

/// A simple polygon whose open inside has a price.
struct PricedArea {
  double factor = 1.0;        ///< of length in it, 1 .. largest_price
  std::vector<Vec2> corners;  ///< in order, either orientation, the last joined to the first
  std::size_t line = 0;       ///< of its file, from 1; 0: none
};

/// The cells of a mask as map server reads them.
struct MaskCells {
  std::uint32_t width = 0;          ///< columns
  std::uint32_t height = 0;         ///< rows
  std::vector<std::int8_t> values;  ///< width * height, the bottom row first: 0 free .. 100 occupied, -1 unknown
  double cell = 1.0;                ///< side of a cell, world units; > 0
  Vec2 origin;                      ///< lower left corner of cell (0, 0)
  double yaw_rad = 0.0;             ///< turned about its origin, counter-clockwise
  std::string image = {};           ///< path of the image that the YAML names
};

/// areas: values 1 .. 99 are factors. speed: values are limits of speed, factors of time. keep_out: 100 is blocked.
enum class MaskKind : std::uint8_t { areas, speed, keep_out };

/// A map beside the map.
struct PriceMask {
  MaskKind kind = MaskKind::areas;     ///< what its values mean
  std::string file;                    ///< its path
  std::optional<double> factor = {};   ///< areas: of value 100 on its scale; keep_out: passable at, none: blocked
  double base = 100.0;                 ///< speed: the limit is base + multiplier * value, per cent
  double multiplier = -1.0;            ///< speed
  std::optional<MaskCells> read = {};  ///< what the file holds, where somebody has read it
};

/// All prices of a question, or of a world's file.
struct Prices {
  std::optional<ClearancePrice> clearance = {};  ///< none: nearness costs nothing
  std::vector<PricedArea> areas = {};            ///< the greatest factor counts where several lie
  std::vector<PriceMask> masks = {};             ///< the same
  std::vector<ScenePolygon> keep_out = {};       ///< whose open insides nothing may touch
  /// Factor of unknown cells, 1 .. largest_price; infinite: blocked, whatever is said elsewhere; none: blocked.
  std::optional<double> unknown = {};

  /// Is anything said?
  bool empty() const { return !clearance && areas.empty() && masks.empty() && keep_out.empty() && !opens_unknown(); }
  /// May a path lead over unknown cells?
  bool opens_unknown() const { return unknown && *unknown != std::numeric_limits<double>::infinity(); }
  /// What a metre over them costs, where one may; else 1.
  double unknown_factor() const { return opens_unknown() ? *unknown : 1.0; }
};

/// What a path costs beyond its length, part by part; all in the world's unit, >= 0.
struct PriceParts {
  double clearance = 0.0;  ///< P * integral of phi
  double areas = 0.0;      ///< integral of f - 1
  double turning = 0.0;    ///< of turning on the way
  double cusps = 0.0;      ///< of changes of gear
  double reverse = 0.0;    ///< of driving backwards
  double error = 0.0;      ///< the sum may be off by so much at most; 0 where it is a closed form

  /// What is added to the length.
  double sum() const { return clearance + areas + turning + cusps + reverse; }
};

}  // namespace warren
