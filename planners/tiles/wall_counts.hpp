// SPDX-License-Identifier: BSD-3-Clause
// How many walls of each chunk of the list go to each tile: with that, any tiles can be filed by themselves, each wall
// where it would stand if all were, and chunks that have nothing for them are passed over. One pass over the walls.
// Borders of chunks depend on the number of walls alone. Memory: 4 bytes a chunk and tile, twice where walls are wide.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "core/plane/wall_set.hpp"
#include "parallel/chunks.hpp"
#include "parallel/execution.hpp"
#include "planners/tiles/wall_filer.hpp"

namespace warren {

/// Of the narrow or of the wide walls. Immutable after its construction.
class ChunkCounts {
 public:
  ChunkCounts() = default;
  ChunkCounts(std::size_t chunks, std::size_t tiles) : chunks_(chunks), tiles_(tiles), before_((chunks + 1) * tiles) {}

  /// A chunk's counts, to be filled in.
  std::uint32_t* counts(std::size_t chunk) { return before_.data() + (chunk + 1) * tiles_; }
  /// When all are filled in.
  void add_up();

  /// Walls of the tile in the chunks before this one.
  std::uint32_t before(std::size_t chunk, std::size_t tile) const { return before_[chunk * tiles_ + tile]; }
  std::uint32_t of(std::size_t chunk, std::size_t tile) const { return before(chunk + 1, tile) - before(chunk, tile); }
  std::uint32_t of_tile(std::size_t tile) const { return chunks_ == 0 ? 0 : before(chunks_, tile); }

 private:
  std::size_t chunks_ = 0;
  std::size_t tiles_ = 0;
  RawVector<std::uint32_t> before_;  // first row: nothing; then counts, at last what they sum up to
};

class WallCounts {
 public:
  /// Throws Stopped.
  WallCounts(const WallSet& walls, const WallFiler& filer, std::size_t tiles, const Execution& execution);

  std::size_t tiles() const { return tiles_; }
  std::size_t chunks() const { return chunk_count(walls_, grain_); }
  /// Its walls.
  Range chunk(std::size_t number) const;
  const ChunkCounts& narrow() const { return narrow_; }
  const ChunkCounts& wide() const { return wide_; }
  bool has(std::size_t chunk, std::size_t tile) const {
    return narrow_.of(chunk, tile) > 0 || (any_wide_ && wide_.of(chunk, tile) > 0);
  }
  bool any_wide() const { return any_wide_; }
  /// Of all walls.
  const Box& box() const { return box_; }

 private:
  template <class Wall>
  void count(std::span<const Wall> walls, const WallFiler& filer, const Execution& execution);

  std::size_t walls_;
  std::size_t grain_;
  std::size_t tiles_;
  ChunkCounts narrow_;
  ChunkCounts wide_;  // empty where no wall is
  bool any_wide_ = false;
  Box box_;
};

}  // namespace warren
