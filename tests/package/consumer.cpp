// SPDX-License-Identifier: BSD-3-Clause
// Spreads a loop over two threads through the installed package.
#include <vector>

#include "core/rng.hpp"
#include "parallel/chunks.hpp"

int main() {
  std::vector<int> visits(1000, 0);
  warren::Execution execution;
  execution.threads = 2;
  warren::for_chunks(visits.size(), 100, execution, [&](warren::Range range) {
    for (std::size_t i = range.first; i < range.last; ++i) ++visits[i];
  });
  for (const int count : visits) {
    if (count != 1) return 1;
  }
  return 0;
}
