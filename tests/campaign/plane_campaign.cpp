// SPDX-License-Identifier: BSD-3-Clause
// The long form of tests/planners/visibility/plane_contest_test.cpp: `plane_campaign WORLDS SEED` lets all planners
// that claim the shortest path compete on so many strange worlds, one a seed from SEED on. Worlds on which somebody is
// wrong are made as small as they stay wrong, and the smallest of them is printed as a scene; then the exit code is 1.
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "parallel/chunks.hpp"
#include "tests/planners/visibility/plane_contest.hpp"

namespace warren::test {
namespace {

struct Finding {
  std::uint64_t seed = 0;
  PlaneProblem problem;
  std::string complaint;
};

std::size_t size_of(const PlaneProblem& problem) {
  return problem.obstacles.polygons.corners.size() + 2 * problem.obstacles.walls.size() +
         (problem.obstacles.bounds ? 1 : 0);
}

struct Part {
  ContestTally tally;
  std::vector<Finding> findings;
};

void compete(std::uint64_t seed, Part& part) {
  const PlaneProblem problem = StrangeWorlds(seed).make();
  std::string complaint = disagreement(problem, part.tally);
  if (!complaint.empty()) part.findings.push_back({seed, problem, std::move(complaint)});
}

/// Prints what was found; the number of findings.
std::size_t report(std::uint64_t worlds, std::vector<Part>& parts) {
  ContestTally sum;
  std::vector<Finding> findings;
  for (Part& part : parts) {
    sum.solved += part.tally.solved;
    sum.bent += part.tally.bent;
    sum.apart += part.tally.apart;
    sum.blocked += part.tally.blocked;
    sum.refused += part.tally.refused;
    for (Finding& f : part.findings) findings.push_back(std::move(f));
  }
  std::printf(
      "%llu worlds: %d solved (%d not straight), %d not connected, %d blocked; %d refused by cells, findings: %zu\n",
      static_cast<unsigned long long>(worlds), sum.solved, sum.bent, sum.apart, sum.blocked, sum.refused,
      findings.size());
  constexpr std::size_t most_shrunk = 20;
  std::optional<Finding> smallest;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    std::printf("seed %llu: %s\n", static_cast<unsigned long long>(findings[i].seed), findings[i].complaint.c_str());
    if (i >= most_shrunk) continue;
    Finding shrunk = findings[i];
    shrunk.problem = smallest_disagreement(shrunk.problem);
    ContestTally unused;
    shrunk.complaint = disagreement(shrunk.problem, unused);
    if (!smallest || size_of(shrunk.problem) < size_of(smallest->problem)) smallest = std::move(shrunk);
  }
  if (smallest) {
    std::printf("\n# seed %llu, made small: %s\n%s", static_cast<unsigned long long>(smallest->seed),
                smallest->complaint.c_str(), scene_text(smallest->problem).c_str());
  }
  return findings.size();
}

std::optional<std::uint64_t> number(const char* text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text, text + std::strlen(text), value);
  return error == std::errc() && *end == '\0' ? std::optional(value) : std::nullopt;
}

int run(int count, char** words) {
  const std::optional<std::uint64_t> worlds = count == 3 ? number(words[1]) : std::nullopt;
  const std::optional<std::uint64_t> seed = count == 3 ? number(words[2]) : std::nullopt;
  if (!worlds || !seed) {
    std::fprintf(stderr, "usage: plane_campaign WORLDS SEED\n");
    return 2;
  }
  constexpr std::size_t grain = 16;
  std::vector<Part> parts(chunk_count(*worlds, grain));
  for_chunks(*worlds, grain, {}, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) compete(*seed + i, parts[r.first / grain]);
  });
  return report(*worlds, parts) == 0 ? 0 : 1;
}

}  // namespace
}  // namespace warren::test

int main(int count, char** words) {
  try {
    return warren::test::run(count, words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plane_campaign: %s\n", error.what());
    return 70;
  }
}
