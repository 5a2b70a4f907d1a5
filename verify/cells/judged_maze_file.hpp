// SPDX-License-Identifier: BSD-3-Clause
// The walls of a .maze file as its judge reads them, by docs/file_formats.md and nothing else: what the planner's
// reader takes wrong, this one has not from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/plane/cell_walls.hpp"

namespace warren {

/// Refers to the file's bytes. Cost: some ns a cell.
class JudgedMazeFile : public CellWallSource {
 public:
  /// Called for bytes first .. last - 1 that a reader has looked at.
  using Forget = std::function<void(std::size_t first, std::size_t last)>;

  /// name: of the file. Throws InputError for what is no .maze file of version 1, or has another size.
  JudgedMazeFile(const std::string& name, std::string_view bytes, Forget forget = {});
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;
  /// Does the wall right of a cell stand, or above it?
  bool stands(std::uint64_t col, std::uint64_t row, bool above) const;

  std::string_view bytes_;
  Forget forget_;
};

}  // namespace warren
