// SPDX-License-Identifier: BSD-3-Clause
// Tile summaries as bytes, for files and other processes.
#pragma once

#include "core/base/packed_values.hpp"
#include "planners/tiles/lattice_tile_reduction.hpp"

namespace warren {

void pack_summary(const TileSummary& tile, ValuePacker& to);
/// Throws InputError where the bytes are no summary of a tile of this side.
TileSummary unpack_summary(ValueUnpacker& from, std::uint32_t side);

}  // namespace warren
