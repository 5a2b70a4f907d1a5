// SPDX-License-Identifier: BSD-3-Clause
// Draws how far the work is on standard error: stage, per cent, rate, time left. Nothing is drawn for work that ends
// within a second; at most ten times a second after that; the line is cleared at the end. Plain mode writes a line of
// its own every two seconds and never erases.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "parallel/execution.hpp"
#include "parallel/ticker.hpp"
#include "tools/screen/terminal.hpp"

namespace warren {

class ProgressBar {
 public:
  /// Watches `progress` until destroyed. Mode none draws nothing and starts no thread.
  ProgressBar(const Progress& progress, ProgressMode mode);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

 private:
  void draw();

  const Progress& progress_;
  ProgressMode mode_;
  const char* stage_ = nullptr;  // of the last drawing; rate and time left start anew with each stage
  std::chrono::steady_clock::time_point stage_begin_;
  std::uint64_t done_at_begin_ = 0;
  std::size_t columns_ = 0;  // of what stands on the screen
  std::unique_ptr<Ticker> ticker_;
};

/// What erases so many columns that stand on a screen `width` columns wide: more rows than one where it has become
/// narrower meanwhile.
std::string erasing(std::size_t columns, std::size_t width);

/// One line: "connect  [=====>    ]  43 %  12.3 M/s  3 s left of it", at most `width` columns: how long the stage will
/// take, since nobody knows the next ones.
std::string progress_line(const char* stage, std::uint64_t done, std::uint64_t total, double items_per_s,
                          std::size_t width);

}  // namespace warren
