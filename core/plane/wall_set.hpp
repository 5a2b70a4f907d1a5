// SPDX-License-Identifier: BSD-3-Clause
// The walls of a world: N segments in memory, in the narrowest type that holds every coordinate exactly: those of a
// grid maze in 8 bytes each, others in floats (16) or doubles (32).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <variant>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"

namespace warren {

/// A level or upright wall in one word of 64 bits: what walls of grids are, at half of what floats take. Coordinates
/// are multiples of 1/4 below 2^18. Bits 0 to 20 are x of the first end, bits 32 to 52 its y, in quarters and 2^20
/// more, so that they are never below 0; bits 21 to 31, and above them 53 to 62, say how far the second end lies to the
/// right, as x does; bit 63 says that it lies above instead. One wall has one word: a wall of length zero is level. The
/// halves are read alike, by shifts and masks of 32 bits without a branch, so loops over walls become vector code.
class PackedWall {
 public:
  using Number = float;                                ///< in which its coordinates are exact
  static constexpr std::int32_t per_unit = 4;          ///< steps of the coordinates
  static constexpr std::int32_t most = (1 << 20) - 1;  ///< steps that a coordinate may have, and a length

  /// Its ends in steps.
  struct Ends {
    std::int32_t x1;  ///< of the first end
    std::int32_t y1;  ///< of the first end
    std::int32_t x2;  ///< of the second end
    std::int32_t y2;  ///< of the second end
  };

  PackedWall() = default;
  /// Of a wall that fits, in steps.
  static constexpr PackedWall level(std::int32_t x, std::int32_t y, std::int32_t length) {
    const std::uint64_t far = field(length);
    return PackedWall(field(x) | far % (1U << low_bits) << field_bits | field(y) << 32 |
                      far >> low_bits << (32 + field_bits));
  }
  /// As level(), upwards.
  static constexpr PackedWall upright(std::int32_t x, std::int32_t y, std::int32_t length) {
    return PackedWall(level(x, y, length).word_ | std::uint64_t{length != 0} << 63);
  }
  /// Is there a word for this wall, to the sign of each zero?
  template <class T>
  static bool fits(T x1, T y1, T x2, T y2) {
    const unsigned all_steps =
        unsigned{is_step(x1)} & unsigned{is_step(y1)} & unsigned{is_step(x2)} & unsigned{is_step(y2)};
    return all_steps != 0 && (x1 == x2 || y1 == y2) && std::abs(x1 - x2) + std::abs(y1 - y2) <= T{most} / per_unit;
  }
  /// Of a wall that fits().
  template <class T>
  static PackedWall of(T x1, T y1, T x2, T y2) {
    const auto steps = [](T x) { return static_cast<std::int32_t>(x * per_unit); };
    return y1 == y2 ? level(steps(x1), steps(y1), steps(x2 - x1)) : upright(steps(x1), steps(y1), steps(y2 - y1));
  }

  /// The whole wall.
  std::uint64_t word() const { return word_; }
  /// The first end, x in the lower half and y in the upper one, each in steps and `most` + 1 more.
  std::uint64_t raised_end() const { return word_ & (std::uint64_t{field_mask} << 32 | field_mask); }
  /// Steps from the first end to the second, to the right or upwards.
  std::int32_t length() const {
    const auto low = static_cast<std::uint32_t>(word_);
    const auto high = static_cast<std::uint32_t>(word_ >> 32);
    return signed_of(low >> field_bits | (high >> (field_bits - low_bits) & high_mask));
  }
  /// Is the second end above or below the first?
  bool is_upright() const { return word_ >> 63 != 0; }
  /// Exact.
  Ends ends() const {
    const auto high = static_cast<std::uint32_t>(word_ >> 32);
    const std::int32_t x = signed_of(static_cast<std::uint32_t>(word_) & field_mask);
    const std::int32_t y = signed_of(high & field_mask);
    const std::int32_t up = static_cast<std::int32_t>(high) >> 31;
    return {x, y, x + (length() & ~up), y + (length() & up)};
  }
  /// As doubles; exact.
  Segment segment() const {
    constexpr double step = 1.0 / per_unit;
    const Ends e = ends();
    return {{step * e.x1, step * e.y1}, {step * e.x2, step * e.y2}};
  }
  friend bool operator==(const PackedWall&, const PackedWall&) = default;

 private:
  static constexpr unsigned field_bits = 21;             // of a coordinate, and of the length
  static constexpr unsigned low_bits = 32 - field_bits;  // of the length, beside x; the others are beside y
  static constexpr std::uint32_t field_mask = (1U << field_bits) - 1;
  static constexpr std::uint32_t high_mask = field_mask & ~((1U << low_bits) - 1);

  explicit constexpr PackedWall(std::uint64_t word) : word_(word) {}
  static constexpr std::uint64_t field(std::int32_t steps) { return static_cast<std::uint32_t>(steps + most + 1); }
  static constexpr std::int32_t signed_of(std::uint32_t field) { return static_cast<std::int32_t>(field) - (most + 1); }
  template <class T>
  static bool is_step(T x) {
    const T steps = x * per_unit;
    const bool is_small = std::abs(steps) <= T{most};
    const auto whole = static_cast<std::int32_t>(is_small ? steps : T{0});
    return is_small && static_cast<T>(whole) == steps && !(whole == 0 && std::signbit(x));
  }

  std::uint64_t word_;
};

/// Is the number finite and exact as a float?
template <class T>
bool exact_as_float(T x) {
  return std::abs(x) <= std::numeric_limits<float>::max() && static_cast<T>(static_cast<float>(x)) == x;
}

/// One wall as files hold it: four numbers.
template <class T>
struct WallOf {
  using Number = T;  ///< of its coordinates
  T x1;              ///< of one end
  T y1;              ///< of one end
  T x2;              ///< of the other
  T y2;              ///< of the other
  /// With each coordinate as a T.
  static WallOf of(double x1, double y1, double x2, double y2) {
    return {static_cast<T>(x1), static_cast<T>(y1), static_cast<T>(x2), static_cast<T>(y2)};
  }
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
  /// Takes them: packed, floats or doubles.
  template <class Wall>
  explicit WallSet(RawVector<Wall> walls) : walls_(std::move(walls)) {}

  /// Packs them where all fit, keeps floats where all coordinates are exact as float, doubles otherwise.
  static WallSet narrowest(std::span<const Segment> segments) {
    const auto all = [&](const auto& fits) {
      return std::all_of(segments.begin(), segments.end(),
                         [&](const Segment& s) { return fits(s.a.x, s.a.y, s.b.x, s.b.y); });
    };
    if (all(PackedWall::fits<double>)) return held_as<PackedWall>(segments);
    const bool floats = all([](auto... x) { return (exact_as_float(x) && ...); });
    return floats ? held_as<FloatWall>(segments) : held_as<DoubleWall>(segments);
  }

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
  /// Memory of the walls.
  std::size_t bytes() const {
    return visit([](auto walls) { return walls.size_bytes(); });
  }
  /// Wall i as doubles; i < size().
  Segment segment(std::size_t i) const {
    return visit([i](auto walls) { return walls[i].segment(); });
  }

 private:
  template <class Wall>
  static WallSet held_as(std::span<const Segment> segments) {
    RawVector<Wall> walls(segments.size());
    std::transform(segments.begin(), segments.end(), walls.begin(),
                   [](const Segment& s) { return Wall::of(s.a.x, s.a.y, s.b.x, s.b.y); });
    return WallSet(std::move(walls));
  }

  std::variant<RawVector<PackedWall>, RawVector<FloatWall>, RawVector<DoubleWall>> walls_;
};

}  // namespace warren
