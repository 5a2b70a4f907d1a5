// SPDX-License-Identifier: BSD-3-Clause
// What `warren-mpi scale` measured, as a table for people and as JSON (warren.ranks/1).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/distributed/rank_protocol.hpp"
#include "apps/studies/study_report.hpp"

namespace warren::distributed {

/// What a rank has used in one run.
struct RankUse {
  double cpu_s;
  std::uint64_t bytes_sent, peak_bytes;
};

struct RanksRun {
  bool is_strong;  ///< the same maze by more ranks; else one that grows with them
  std::uint32_t ranks, rows, cols;
  double length = 0.0;
  double seconds = 0.0;
  std::vector<RankUse> used = {};                         ///< by rank
  std::array<std::uint64_t, request_count> traffic = {};  ///< bytes, by what was asked

  double cells() const { return static_cast<double>(rows) * cols; }
  double cpu_s() const;
  std::uint64_t bytes_sent() const;
  std::uint64_t peak_bytes() const;  ///< of the rank that held most
};

/// What all runs have in common.
struct RanksSettings {
  std::uint64_t seed;
  double loops;
  unsigned threads;
};

studies::TextTable ranks_table(std::span<const RanksRun> runs);
std::string ranks_json(std::span<const RanksRun> runs, const RanksSettings& settings);

}  // namespace warren::distributed
