// SPDX-License-Identifier: BSD-3-Clause
// `far_campaign SOLVES SEED`: so many questions of tests/solve/bodies_far_away.hpp, one a seed from SEED on. Prints
// what judges refuted; then the exit code is 1.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "parallel/chunks.hpp"
#include "tests/solve/bodies_far_away.hpp"

namespace warren::test {
namespace {

int run(std::uint64_t solves, std::uint64_t first) {
  constexpr std::size_t grain = 16;
  std::vector<FarTally> parts(chunk_count(solves, grain));
  for_chunks(solves, grain, {}, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) solve_far_away(first + i, parts[r.first / grain]);
  });
  FarTally all;
  for (const FarTally& part : parts) {
    all.solved += part.solved;
    all.unsolved += part.unsolved;
    for (const std::string& refuted : part.refuted) std::printf("seed %s\n", refuted.c_str());
    all.refuted.insert(all.refuted.end(), part.refuted.begin(), part.refuted.end());
  }
  std::printf("%llu solves: %llu solved, %zu refuted\n", static_cast<unsigned long long>(solves),
              static_cast<unsigned long long>(all.solved), all.refuted.size());
  return all.refuted.empty() ? 0 : 1;
}

}  // namespace
}  // namespace warren::test

int main(int count, char** words) {
  try {
    if (count == 3)
      return warren::test::run(std::strtoull(words[1], nullptr, 10), std::strtoull(words[2], nullptr, 10));
    std::fprintf(stderr, "usage: far_campaign SOLVES SEED\n");
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "far_campaign: %s\n", error.what());
    return 70;
  }
}
