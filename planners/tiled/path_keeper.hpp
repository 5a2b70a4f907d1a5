// SPDX-License-Identifier: BSD-3-Clause
// Holds a path that comes in pieces: the taker of those who need all of its points.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/path.hpp"
#include "core/base/path_taker.hpp"
#include "parallel/first_touch.hpp"

namespace warren {

/// Appends to an empty path, which must outlive it. begin() asks for the memory: Stopped.
class PathKeeper : public PathTaker {
 public:
  PathKeeper(Path<Vec2>& path, const Execution& execution) : path_(path), execution_(execution) {}

  void begin(std::uint64_t points) override { reserve_touched(path_, points, execution_); }
  void add(std::span<const Vec2> piece) override {
    const std::span<const Vec2> rest = path_.empty() ? piece : piece.subspan(1);
    path_.insert(path_.end(), rest.begin(), rest.end());
  }

 private:
  Path<Vec2>& path_;
  const Execution& execution_;
};

}  // namespace warren
