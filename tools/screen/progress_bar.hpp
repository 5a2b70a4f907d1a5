// SPDX-License-Identifier: BSD-3-Clause
// Draws how far the work is on standard error: stage, per cent, rate, time left of it and of the whole. Nothing is
// drawn for work that ends within a second; at most ten times a second after that; the line is cleared at the end.
// Plain mode writes a line of its own every two seconds and never erases.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "parallel/ticker.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/whole_run.hpp"

namespace warren::tools {

class ProgressBar {
 public:
  /// Watches `progress` until destroyed. Mode none draws nothing and starts no thread. budget_s: of the run, from now
  /// on.
  ProgressBar(const Progress& progress, ProgressMode mode, std::optional<double> budget_s = {},
              ExpectedStages stages = {});
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

 private:
  void draw();

  std::string whole_run_text(const RunMoment& moment, double items_per_s);

  const Progress& progress_;
  ProgressMode mode_;
  std::optional<double> budget_s_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  WholeRun whole_;
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
/// take; behind it what is known of the whole run.
std::string progress_line(const RunMoment& moment, double items_per_s, std::string_view of_whole_run,
                          std::size_t width);

}  // namespace warren::tools
