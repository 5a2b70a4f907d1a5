// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/worker_crew.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <new>
#include <system_error>

namespace warren {
namespace {

std::size_t starts = 0;  // that crews have asked for

void pretend_to_start(WorkerCrew&, std::size_t) { ++starts; }

void refuse_to_start(WorkerCrew&, std::size_t) {
  ++starts;
  throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
}

/// Crews are never ended, so they live in static memory.
template <WorkerCrew::Start start>
WorkerCrew& crew_with() {
  alignas(WorkerCrew) static std::byte room[sizeof(WorkerCrew)];
  static WorkerCrew& made = *new (room) WorkerCrew(start);
  return made;
}

/// How often a thread is asked for while the crew runs a loop.
std::size_t starts_for(WorkerCrew& crew, std::size_t chunks, unsigned threads) {
  starts = 0;
  std::size_t done = 0;  // no other thread counts
  std::size_t* const counter = &done;
  const auto count = [](const void* of, std::size_t) { ++**static_cast<std::size_t* const*>(of); };
  SharedLoop loop(chunks, threads, &counter, count);
  crew.run(loop);
  EXPECT_EQ(done, chunks);
  return starts;
}

TEST(WorkerCrew, StartsNoMoreThreadsThanTheLoopHasChunksForAndNoneTwice) {
  WorkerCrew& crew = crew_with<pretend_to_start>();
  EXPECT_EQ(starts_for(crew, 2, 8), 1U);
  EXPECT_EQ(starts_for(crew, 2, 8), 0U);
  EXPECT_EQ(starts_for(crew, 5, 8), 3U);
  EXPECT_EQ(starts_for(crew, 100, 8), 3U);
  EXPECT_EQ(starts_for(crew, 100, 8), 0U);
}

TEST(WorkerCrew, AfterARefusedStartMostLoopsDoWithoutAndLaterOnesAskAgain) {
  WorkerCrew& crew = crew_with<refuse_to_start>();
  EXPECT_EQ(starts_for(crew, 100, 8), 1U);
  std::size_t asked = 0;
  for (int loop = 0; loop < 2000; ++loop) asked += starts_for(crew, 100, 8);
  EXPECT_GE(asked, 1U);
  EXPECT_LE(asked, 20U);
}

}  // namespace
}  // namespace warren
