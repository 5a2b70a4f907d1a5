// SPDX-License-Identifier: BSD-3-Clause
// Is a closed outline simple: does it neither cross nor touch itself? Small ones by comparing all sides, others by a
// sweep (scenes/scene/ring_sweep), which stops at the first contact: O(n log n), exact, whatever the shape.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// Two sides that meet where they must not; side i begins in corner i.
struct SideContact {
  std::size_t first;
  std::size_t second;
};

/// At least three corners, no two in a row equal. Sides that follow each other may meet in their corner alone. Throws
/// Stopped.
std::optional<SideContact> self_contact(std::span<const Vec2> corners, const Execution& execution);

}  // namespace warren
