// SPDX-License-Identifier: BSD-3-Clause
// Rows of lattice points among walls, asked wall by wall: a wall clears the bits of the few points and steps near it.
// The same answers as WallIndex::keeps_clearance for each alone.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// Clears the points outside the closed box.
void keep_points_in_box(const Box& box, const LatticeRows& rows, std::span<std::uint64_t> bits) noexcept;

/// Clears the points that are nearer than r to a wall, r = 0: on one; and the same of the segments from each point to
/// the next one on the right and to the one above, where these two are not empty.
void keep_off_walls(const WallIndex& walls, double r, const LatticeRows& rows, std::span<std::uint64_t> points,
                    std::span<std::uint64_t> right, std::span<std::uint64_t> up) noexcept;

}  // namespace warren
