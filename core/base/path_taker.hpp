// SPDX-License-Identifier: BSD-3-Clause
// Where the points of a path go that is too long to be held: they are handed on as they are made.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/types.hpp"

namespace warren {

class PathTaker {
 public:
  PathTaker() = default;
  virtual ~PathTaker() = default;
  PathTaker(const PathTaker&) = delete;
  PathTaker& operator=(const PathTaker&) = delete;
  /// Once, before the first piece: the number of points in all, at least one.
  virtual void begin(std::uint64_t points) = 0;
  /// The points that follow; each piece but the first begins with the last point of the one before.
  virtual void add(std::span<const Vec2> piece) = 0;
};

}  // namespace warren
