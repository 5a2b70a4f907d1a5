// SPDX-License-Identifier: BSD-3-Clause
// The walls of a maze as the judge reads them from a .npy array, once, window by window: what the planner's reader
// takes wrong, this one has not from it. Two bits a cell stay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/raw_vector.hpp"
#include "core/plane/cell_walls.hpp"
#include "parallel/execution.hpp"

namespace warren {

class JudgedNpyMaze : public CellWallSource {
 public:
  /// Called for bytes first .. last - 1 that have been looked at.
  using Forget = std::function<void(std::size_t first, std::size_t last)>;

  /// Throws InputError for what is no array (n, 4) of <f4 or <f8, and for walls that are none of such a maze; Stopped.
  JudgedNpyMaze(const std::string& name, std::string_view bytes, std::uint32_t rows, std::uint32_t cols,
                const Forget& forget, const Execution& execution);
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;
  template <class T>
  void take(const std::string& name, std::string_view numbers, const Execution& execution);
  void take(const std::string& name, double x1, double y1, double x2, double y2);

  // A line of the grid has a bit for each unit of it: lines x = 0.5, 1.5, ... by column, and y = 0.5, ... by row.
  RawVector<std::uint64_t> upright_;
  RawVector<std::uint64_t> level_;
};

}  // namespace warren
