// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/sampler.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"

namespace warren {
namespace {

/// Free at random points: a share of them, or those in a box.
struct SpottedWorld {
  static constexpr std::size_t dimension = 2;
  using State = Vec2;
  struct Query {};
  double share;
  Box free_box;
  Query make_query() const { return {}; }
  State at_unit(const std::array<double, 2>& u) const { return {u[0], u[1]}; }
  bool is_free(const State& a, Query&) const {
    return free_box.contains(a) && uniform(5, static_cast<std::uint64_t>(a.y * 100'000 + a.x), 0) < share;
  }
  bool is_free_motion(const State&, const State&, Query&) const { return true; }
  static double distance(const State& a, const State& b) { return warren::distance(a, b); }
  std::array<double, 2> embed(const State& a) const { return {a.x, a.y}; }
  Box box() const { return free_box; }
};
static_assert(World<SpottedWorld>);

constexpr Box everywhere{{0, 0}, {1e6, 1e6}};
constexpr SpottedWorld nothing{0.0, everywhere};

RoadmapOptions on_lattice(LatticeSize size) {
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = size;
  return options;
}

/// Filtered one by one, then sorted.
std::vector<Vec2> by_sorting(const SpottedWorld& world, LatticeSize size, std::uint64_t count) {
  SpottedWorld::Query query;
  RawVector<Vec2> free;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (world.is_free(lattice_point(size, i), query)) free.push_back(lattice_point(size, i));
  }
  const RawVector<Vec2> sorted = detail::in_tile_order(WorldView(world), free, {});
  return {sorted.begin(), sorted.end()};
}

TEST(Milestones, OfALatticeAreItsFreePointsInTileOrder) {
  const LatticeSize sizes[] = {{1, 1}, {1, 900}, {900, 1}, {7, 300}, {300, 7}, {64, 64}, {65, 129}, {200, 131}};
  const SpottedWorld worlds[] = {
      {1.0, everywhere}, {0.9, everywhere}, {0.5, everywhere}, {0.02, everywhere}, {0.8, {{20, 3}, {90, 60}}}};
  for (const LatticeSize size : sizes) {
    for (const SpottedWorld& world : worlds) {
      const std::uint64_t all = std::uint64_t{size.rows} * size.cols;
      for (const std::uint64_t count : {all, all / 2 + 1}) {
        SCOPED_TRACE(testing::Message() << size.rows << " x " << size.cols << ", " << count << " points, share "
                                        << world.share);
        const RawVector<Vec2> points = draw_milestones(WorldView(world), on_lattice(size), count, {});
        EXPECT_EQ(std::vector<Vec2>(points.begin(), points.end()), by_sorting(world, size, count));
        EXPECT_GE(points.capacity(), points.size() + 2);
      }
    }
  }
}

TEST(Milestones, AreTheSameForAnyThreadCount) {
  const SpottedWorld world{0.7, everywhere};
  for (RoadmapOptions options : {on_lattice({500, 400}), RoadmapOptions{}}) {
    const RawVector<Vec2> one = draw_milestones(WorldView(world), options, 200'000, {.threads = 1});
    for (const unsigned threads : {2U, 3U, 8U}) {
      EXPECT_EQ(draw_milestones(WorldView(world), options, 200'000, {.threads = threads}), one)
          << threads << " threads";
    }
  }
}

TEST(Milestones, NoneAreThereWhereNothingIsFree) {
  EXPECT_TRUE(draw_milestones(WorldView(nothing), on_lattice({20, 30}), 600, {}).empty());
}

TEST(Milestones, MoreThanHaveNumbersAreRefused) {
  const LatticeSize size{65'536, 32'769};
  const std::uint64_t all = std::uint64_t{size.rows} * size.cols;
  EXPECT_THROW(draw_milestones(WorldView(nothing), on_lattice(size), all, {}), InputError);
}

}  // namespace
}  // namespace warren
