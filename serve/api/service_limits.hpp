// SPDX-License-Identifier: BSD-3-Clause
// What a service may spend on its clients.
#pragma once

#include <cstddef>

namespace warren::serve {

struct ServiceLimits {
  double budget_s = 10.0;  ///< of each request that is worked on; questions may ask for less
  std::size_t memory_bytes = static_cast<std::size_t>(-1);  ///< that the process may hold
  unsigned threads = 0;                                     ///< of each request
  bool writable = false;                                    ///< does whoever owns the service take changes?
  bool wants_token = false;                                 ///< from those who change
  std::size_t scene_bytes = std::size_t{64} << 20U;         ///< of a scene that is told
  std::size_t tile_bytes = std::size_t{64} << 20U;          ///< of tiles that are kept
  std::size_t path_bytes = std::size_t{1} << 30U;           ///< of paths that are kept; one has half of it at most
  std::size_t most_points = 10'000;                         ///< of a path that an answer lists
  std::size_t most_view_points = 500'000;                   ///< of a path that is told by itself
  std::size_t small_body = std::size_t{64} << 10U;
  std::size_t batch_body = std::size_t{4} << 20U;      ///< of a route graph, too
  std::size_t batch_answers = std::size_t{32} << 20U;  ///< bytes
};

}  // namespace warren::serve
