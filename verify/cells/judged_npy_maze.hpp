// SPDX-License-Identifier: BSD-3-Clause
// The walls of a maze as the judge reads them from a .npy array, once, window by window: what the planner's reader
// takes wrong, this one has not from it. Two bits a cell stay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "verify/cells/judged_grid_lines.hpp"

namespace warren {

class JudgedNpyMaze : public JudgedGridLines {
 public:
  /// Called for bytes first .. last - 1 that have been looked at.
  using Forget = std::function<void(std::size_t first, std::size_t last)>;

  /// held: rows of cells whose walls are kept. Throws InputError for what is no array (n, 4) of <f4 or <f8, and for
  /// walls that are none of such a maze; Stopped.
  JudgedNpyMaze(const std::string& name, std::string_view bytes, std::uint32_t rows, std::uint32_t cols, Range held,
                const Forget& forget, const Execution& execution);

 private:
  template <class T>
  void take_all(const std::string& name, std::string_view numbers, const Execution& execution);
};

}  // namespace warren
