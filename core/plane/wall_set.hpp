// SPDX-License-Identifier: BSD-3-Clause
// The walls of a world: N segments in memory, in the narrowest type that holds every coordinate exactly: those of a
// grid maze in 8 bytes each, others in floats (16) or doubles (32).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/packed_wall.hpp"

namespace warren {

/// One wall as files hold it: four numbers.
template <class T>
struct WallOf {
  using Number = T;  ///< of its coordinates
  T x1;              ///< of one end
  T y1;              ///< of one end
  T x2;              ///< of the other
  T y2;              ///< of the other
  /// As doubles; exact.
  Segment segment() const {
    return {{static_cast<double>(x1), static_cast<double>(y1)}, {static_cast<double>(x2), static_cast<double>(y2)}};
  }
  friend bool operator==(const WallOf&, const WallOf&) = default;
};
using FloatWall = WallOf<float>;    ///< a wall of 16 bytes
using DoubleWall = WallOf<double>;  ///< a wall of 32 bytes

/// A wall as numbers: itself, or what it was packed from.
template <class T>
const WallOf<T>& unpacked(const WallOf<T>& wall) {
  return wall;
}
/// As above; exact.
inline FloatWall unpacked(const PackedWall& wall) {
  constexpr float step = 1.0F / PackedWall::per_unit;
  const PackedWall::Ends e = wall.ends();
  return {step * static_cast<float>(e.x1), step * static_cast<float>(e.y1), step * static_cast<float>(e.x2),
          step * static_cast<float>(e.y2)};
}

/// Owns the walls. Immutable after construction, so any number of threads may read.
class WallSet {
 public:
  WallSet() = default;
  /// Takes them.
  explicit WallSet(RawVector<PackedWall> walls) : walls_(std::move(walls)) {}
  /// Takes them.
  explicit WallSet(RawVector<FloatWall> walls) : walls_(std::move(walls)) {}
  /// Takes them.
  explicit WallSet(RawVector<DoubleWall> walls) : walls_(std::move(walls)) {}

  /// Packs them where all fit, keeps floats where all coordinates are exact as float, doubles otherwise.
  static WallSet narrowest(std::span<const Segment> segments);

  /// Calls f with a span of PackedWall, FloatWall or DoubleWall, all of them const.
  template <class F>
  decltype(auto) visit(F&& f) const {
    if (const auto* packed = std::get_if<RawVector<PackedWall>>(&walls_))
      return f(std::span<const PackedWall>(*packed));
    if (const auto* floats = std::get_if<RawVector<FloatWall>>(&walls_)) return f(std::span<const FloatWall>(*floats));
    return f(std::span<const DoubleWall>(std::get<RawVector<DoubleWall>>(walls_)));
  }
  /// How many walls.
  std::size_t size() const {
    return visit([](auto walls) { return walls.size(); });
  }
  /// Are they held in 8 bytes each?
  bool holds_packed() const { return std::holds_alternative<RawVector<PackedWall>>(walls_); }
  /// Are they held as floats?
  bool holds_floats() const { return std::holds_alternative<RawVector<FloatWall>>(walls_); }
  /// Are they held as doubles?
  bool holds_doubles() const { return std::holds_alternative<RawVector<DoubleWall>>(walls_); }
  /// Memory of the walls.
  std::size_t bytes() const {
    return visit([](auto walls) { return walls.size_bytes(); });
  }
  /// Wall i as doubles; i < size().
  Segment segment(std::size_t i) const {
    return visit([i](auto walls) { return walls[i].segment(); });
  }

 private:
  std::variant<RawVector<PackedWall>, RawVector<FloatWall>, RawVector<DoubleWall>> walls_;
};

}  // namespace warren
