// SPDX-License-Identifier: BSD-3-Clause
// The walls of a maze in a roadmap's file, where they stand wherever its lattice has no passage, as the judge reads
// them: by docs/file_formats.md and nothing else, so that what the planner's reader takes wrong, this one has not from
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "verify/cells/looked_up_walls.hpp"

namespace warren {

class JudgedPassages : public LookedUpWalls {
 public:
  /// right, up: the words of the sections passages.right and passages.up, referred to. Throws InputError naming `where`
  /// for another number of them.
  JudgedPassages(const std::string& where, std::uint32_t rows, std::uint32_t cols, std::span<const std::uint64_t> right,
                 std::span<const std::uint64_t> up);
  unsigned walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const override;
  /// Reads whole words.
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;
  std::span<const std::uint64_t> right_;
  std::span<const std::uint64_t> up_;
  std::size_t words_a_row_;
};

}  // namespace warren
