// SPDX-License-Identifier: BSD-3-Clause
// The parts of a tile, each against brute force: partition, marking, row kernels, reduction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "planners/mazes/tile_source.hpp"
#include "spatial/obstacles/wall_index.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

double number(SequentialRng& rng, double low, double high) {
  return low + (high - low) * static_cast<double>(rng.next() >> 11) * 0x1p-53;
}

/// Walls of all sizes and directions, a third on the half grid, a third on 1/128, a third anywhere.
std::vector<Segment> random_walls(std::uint64_t seed, Box box, int count) {
  SequentialRng rng(seed);
  std::vector<Segment> walls;
  for (int i = 0; i < count; ++i) {
    const double reach = i % 20 == 0 ? 400.0 : i % 5 == 0 ? 12.0 : 1.5;
    Vec2 a{number(rng, box.min.x - 4, box.max.x + 4), number(rng, box.min.y - 4, box.max.y + 4)};
    Vec2 b = a + Vec2{number(rng, -reach, reach), number(rng, -reach, reach)};
    if (i % 7 == 0) b.x = a.x;
    if (i % 7 == 1) b.y = a.y;
    const double step = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 1.0 / 128 : 0.0;
    for (double* c : {&a.x, &a.y, &b.x, &b.y}) *c = step > 0.0 ? std::round(*c / step) * step : *c;
    if (i % 31 == 0) b = a;
    walls.push_back({a, b});
  }
  return walls;
}

WallSet as_floats(std::vector<Segment> walls) {
  for (Segment& w : walls) {
    for (double* c : {&w.a.x, &w.a.y, &w.b.x, &w.b.y}) *c = static_cast<double>(static_cast<float>(*c));
  }
  return WallSet::narrowest(walls);
}

std::vector<Segment> walls_of(const WallPartition& partition, const TileGrid& grid, std::size_t tile) {
  std::vector<Segment> walls;
  partition.of(tile).for_each(grid, tile, [&](const Segment& w) { walls.push_back(w); });
  return walls;
}

Box tile_box(const TileGrid& grid, std::size_t tile) {
  const Vec2 first = TileGrid::point(grid.first_col(tile), grid.first_row(tile));
  return {{first.x - 0.5, first.y - 0.5}, {first.x + grid.width(tile) - 0.5, first.y + grid.height(tile) - 0.5}};
}

TEST(WallPartition, EachTileHoldsEveryWallThatComesNear) {
  constexpr double halo = 1.11;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TileGrid grid = TileGrid::of({150, 200}, 6);
    const std::vector<Segment> given = random_walls(seed, grid.area(), 400);
    const WallSet walls = seed % 2 == 0 ? WallSet::narrowest(given) : as_floats(given);
    ASSERT_EQ(walls.holds_floats(), seed % 2 == 1);
    const WallPartition partition(walls, {}, grid, halo, {});
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      const std::vector<Segment> held = walls_of(partition, grid, tile);
      const Box box = tile_box(grid, tile);
      const Segment rim[] = {{box.min, {box.max.x, box.min.y}},
                             {box.max, {box.max.x, box.min.y}},
                             {box.max, {box.min.x, box.max.y}},
                             {box.min, {box.min.x, box.max.y}}};
      for (std::size_t i = 0; i < walls.size(); ++i) {
        const Segment w = walls.segment(i);
        const bool near = box.contains(w.a) || std::any_of(std::begin(rim), std::end(rim), [&](const Segment& side) {
                            return distance(side, w) <= halo;
                          });
        EXPECT_TRUE(!near || std::find(held.begin(), held.end(), w) != held.end()) << tile << " " << i;
      }
    }
  }
}

TEST(WallPartition, ALongWallIsHeldOnlyByTheTilesThatItPasses) {
  const TileGrid grid = TileGrid::of({6400, 6400}, 6);
  const std::vector<Segment> diagonal = {{{0.7, 0.6}, {6400.1, 6400.2}}};
  const WallPartition partition(WallSet::narrowest(diagonal), {}, grid, 1.11, {});
  std::size_t held = 0;
  for (std::size_t tile = 0; tile < grid.count(); ++tile) held += walls_of(partition, grid, tile).size();
  EXPECT_GE(held, 100U);
  EXPECT_LE(held, 400U);  // of 10,000
}

TEST(WallPartition, ThreadsChangeNothing) {
  const TileGrid grid = TileGrid::of({150, 200}, 6);
  const WallSet walls = WallSet::narrowest(random_walls(5, grid.area(), 200'000));
  Execution one;
  one.threads = 1;
  const WallPartition expected(walls, {}, grid, 1.11, one);
  for (const unsigned threads : {2U, 3U, 8U}) {
    Execution execution;
    execution.threads = threads;
    const WallPartition found(walls, {}, grid, 1.11, execution);
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      ASSERT_EQ(walls_of(found, grid, tile), walls_of(expected, grid, tile)) << threads;
    }
  }
}

/// Walls of mazes, some of them long, in both directions and of no length, in the forms that hold them.
std::vector<WallSet> in_each_form(std::uint64_t seed, Box box, int count) {
  SequentialRng rng(seed);
  RawVector<PackedWall> packed;
  RawVector<FloatWall> floats;
  RawVector<DoubleWall> doubles;
  for (int i = 0; i < count; ++i) {
    const auto steps = [&](double low, double high) { return static_cast<std::int32_t>(4.0 * number(rng, low, high)); };
    const std::int32_t x = steps(box.min.x - 9, box.max.x + 9);
    const std::int32_t y = steps(box.min.y - 9, box.max.y + 9);
    const std::int32_t length = i % 9 == 0 ? steps(-300.0, 300.0) : i % 8 == 0 ? 0 : steps(-3.0, 3.0);
    packed.push_back(i % 2 == 0 ? PackedWall::level(x, y, length) : PackedWall::upright(x, y, length));
    floats.push_back(unpacked(packed.back()));
    const FloatWall& w = floats.back();
    doubles.push_back({w.x1, w.y1, w.x2, w.y2});
  }
  std::vector<WallSet> sets;
  sets.emplace_back(std::move(packed));
  sets.emplace_back(std::move(floats));
  sets.emplace_back(std::move(doubles));
  return sets;
}

TEST(WallPartition, NeitherFormNorBandsChangeWhatATileHolds) {
  const TileGrid grid = TileGrid::of({500, 700}, 6);
  for (const std::uint64_t seed : test::seeds(3)) {
    const std::vector<WallSet> sets = in_each_form(seed, grid.area(), 60'000);
    const WallPartition expected(sets[2], {}, grid, 1.11, {});
    for (const WallSet& walls : sets) {
      for (const TileBands bands : {TileBands{1, false}, {2, false}, {3, true}, {7, false}, {8, true}, {11, false}}) {
        SCOPED_TRACE(testing::Message() << bands.count << (bands.by_rows ? " of rows" : " of columns"));
        WallPartition found(walls, {}, grid, 1.11, {}, bands);
        EXPECT_EQ(found.box().min, expected.box().min);
        EXPECT_EQ(found.box().max, expected.box().max);
        std::size_t tiles = 0;
        for (std::uint32_t band = 0; band < found.band_count(); ++band) {
          for (const std::size_t tile : found.begin_band(band, {})) {
            ASSERT_TRUE(found.is_filed(tile));
            ASSERT_EQ(walls_of(found, grid, tile), walls_of(expected, grid, tile)) << tile;
            ++tiles;
          }
        }
        EXPECT_EQ(tiles, grid.count());
        for (std::size_t tile = 0; tile < grid.count(); tile += 5) {
          LooseTile loose;
          std::vector<Segment> looked_up;
          found.look_up(tile, loose).for_each(grid, tile, [&](const Segment& w) { looked_up.push_back(w); });
          ASSERT_EQ(looked_up, walls_of(expected, grid, tile)) << tile;
        }
      }
    }
  }
}

TEST(TileBands, AreManyWhereWallsComeInOrderAndAsTheMemoryAsksWhereTheyDoNot) {
  const TileGrid grid = TileGrid::of({3000, 3000}, 8);
  RawVector<PackedWall> in_order;
  for (std::int32_t col = 0; col < 3000; ++col) {
    for (std::int32_t row = 0; row < 3000; ++row) in_order.push_back(PackedWall::upright(4 * col + 2, 4 * row + 2, 4));
  }
  RawVector<PackedWall> in_no_order = in_order;
  SequentialRng rng(3);
  for (std::size_t i = in_no_order.size(); i > 1; --i) std::swap(in_no_order[i - 1], in_no_order[rng.below(i)]);
  const auto bands_of = [&](const WallSet& walls, const Execution& execution) {
    const WallFiler filer(grid, 1.11);
    return choose_bands(WallCounts(walls, filer, grid.count(), {}), grid, execution).count;
  };
  const WallSet ordered(std::move(in_order));
  const WallSet mixed(std::move(in_no_order));
  EXPECT_EQ(bands_of(ordered, {}), 2U);
  EXPECT_EQ(bands_of(mixed, {}), 1U);
  Execution execution;
  const Deadline little(1e6, 1);
  execution.deadline = &little;
  EXPECT_EQ(bands_of(mixed, execution), 2U);
}

/// What the plane must hold: every milestone and edge put to WallIndex.
unsigned expected_bits(const WallIndex& index, const TileGrid& grid, std::int64_t col, std::int64_t row, double r) {
  const auto in_lattice = [&](std::int64_t c, std::int64_t w) {
    return c >= 0 && w >= 0 && c < grid.cols && w < grid.rows;
  };
  if (!in_lattice(col, row)) return 0;
  const Vec2 here = TileGrid::point(col, row);
  unsigned bits = index.keeps_clearance(here, here, r) ? plane_bit::milestone : 0;
  constexpr int step[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (unsigned d = 0; d < 4; ++d) {
    const std::int64_t c = col + step[d][0];
    const std::int64_t w = row + step[d][1];
    if (in_lattice(c, w) && index.keeps_clearance(here, TileGrid::point(c, w), r)) bits |= 1U << d;
  }
  return bits;
}

TEST(WallMarking, EveryMilestoneAndEdgeIsAsTheWallIndexSays) {
  const double clearances[] = {0.0, 0.1, 0.5, 1.7, 0.25};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double r = clearances[seed % 5] * (1 + 1e-9);
    const TileGrid grid = TileGrid::of({100, 130}, 6);
    const WallSet walls = as_floats(random_walls(seed, grid.area(), 300 + 100 * static_cast<int>(seed % 9)));
    const WallIndex index(walls, {}, {});
    const WallPartition partition(walls, {}, grid, 1.01 + r, {});
    WallMarker marker(r);
    TilePlane plane(grid, marker.margin());
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      plane.reset(tile, grid.area());
      marker.mark(partition.of(tile), plane);
      for (int row = 0; row < plane.height(); ++row) {
        for (int col = 0; col < plane.width(); ++col) {
          ASSERT_EQ(*plane.at(col, row),
                    expected_bits(index, grid, grid.first_col(tile) + col, grid.first_row(tile) + row, r))
              << tile << ": " << col << " " << row;
        }
      }
    }
  }
}

TEST(PlaneRows, EveryInstructionSetGivesTheSameBytes) {
  const std::vector<PlaneRowWork> variants = plane_row_variants();
  SequentialRng rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    const int width = 1 + static_cast<int>(rng.below(256));
    std::vector<std::uint8_t> rows(3 * 260);
    for (auto& byte : rows)
      byte = static_cast<std::uint8_t>(rng.below(2) == 0 ? rng.below(64) : 16U | 1U << rng.below(4));
    const auto run = [&](void (*work)(const PlaneRow&)) {
      std::vector<std::uint8_t> all = rows;
      std::vector<std::uint8_t> found(260);
      work({all.data() + 260, all.data() + 520, all.data(), found.data() + 1, width});
      all.insert(all.end(), found.begin(), found.end());
      return all;
    };
    for (std::size_t v = 1; v < variants.size(); ++v) {
      ASSERT_EQ(run(variants[v].peel), run(variants[0].peel)) << variants[v].name;
      ASSERT_EQ(run(variants[v].find_dead_ends), run(variants[0].find_dead_ends)) << variants[v].name;
      ASSERT_EQ(run(variants[v].find_keys), run(variants[0].find_keys)) << variants[v].name;
    }
  }
}

/// A tile with random edges, `kept` in some places.
void scramble(TilePlane& plane, SequentialRng& rng, unsigned percent) {
  for (int row = 0; row < plane.height(); ++row) {
    for (int col = 0; col < plane.width(); ++col) {
      if (rng.below(100) >= percent) {
        *plane.at(col, row) &= static_cast<std::uint8_t>(~plane_bit::right);
        *plane.at(col + 1, row) &= static_cast<std::uint8_t>(~plane_bit::left);
      }
      if (rng.below(100) >= percent) {
        *plane.at(col, row) &= static_cast<std::uint8_t>(~plane_bit::up);
        *plane.at(col, row + 1) &= static_cast<std::uint8_t>(~plane_bit::down);
      }
      if (rng.below(500) == 0) *plane.at(col, row) |= plane_bit::kept;
    }
  }
}

/// Steps from each of the tile's vertices to `from` inside the tile; -1: not joined.
std::vector<int> steps_from(const TilePlane& plane, int from) {
  const int side = static_cast<int>(plane.grid().side());
  std::vector<int> steps(static_cast<std::size_t>(side * side), -1);
  std::queue<int> queue({from});
  steps[static_cast<std::size_t>(from)] = 0;
  constexpr int step[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (; !queue.empty(); queue.pop()) {
    const int at = queue.front();
    for (unsigned d = 0; d < 4; ++d) {
      const int col = at % side + step[d][0];
      const int row = at / side + step[d][1];
      if ((*plane.at(at % side, at / side) & (1U << d)) == 0) continue;
      if (col < 0 || row < 0 || col >= plane.width() || row >= plane.height()) continue;
      int& there = steps[static_cast<std::size_t>(row * side + col)];
      if (there >= 0) continue;
      there = steps[static_cast<std::size_t>(at)] + 1;
      queue.push(row * side + col);
    }
  }
  return steps;
}

/// Shortest distances from key `from` over the chains (Bellman-Ford).
std::vector<std::uint32_t> chain_distances(const TileSummary& summary, std::size_t from) {
  constexpr std::uint32_t far = 1U << 30;
  std::vector<std::uint32_t> distance(summary.keys.size(), far);
  distance[from] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Chain& c : summary.chains) {
      const auto relax = [&](std::size_t a, std::size_t b) {
        if (distance[a] + c.length >= distance[b]) return;
        distance[b] = distance[a] + c.length;
        changed = true;
      };
      relax(c.from, c.to);
      relax(c.to, c.from);
    }
  }
  return distance;
}

TEST(TileReduction, KeepsTheDistancesBetweenKeptVerticesAndTheComponents) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SequentialRng rng(seed);
    const TileGrid grid = TileGrid::of({static_cast<std::uint32_t>(30 + seed), 50}, 6);
    TilePlane plane(grid, 1);
    plane.reset(0, grid.area());
    scramble(plane, rng, static_cast<unsigned>(35 + 2 * seed));
    const TilePlane before = plane;
    const TileSummary summary = TileReduction(plane).reduce(plane);
    const int side = static_cast<int>(grid.side());
    std::vector<bool> has_key(static_cast<std::size_t>(side * side), false);
    for (std::size_t k = 0; k < summary.keys.size(); k += 1 + summary.keys.size() / 8) {
      const std::vector<int> steps = steps_from(before, summary.keys[k]);
      const std::vector<std::uint32_t> distances = chain_distances(summary, k);
      for (std::size_t other = 0; other < summary.keys.size(); ++other) {
        const int direct = steps[summary.keys[other]];
        ASSERT_EQ(distances[other], direct < 0 ? 1U << 30 : static_cast<unsigned>(direct)) << k << " " << other;
      }
    }
    const auto cover = [&](int from) {
      const std::vector<int> steps = steps_from(before, from);
      for (std::size_t v = 0; v < steps.size(); ++v) has_key[v] = has_key[v] || steps[v] >= 0;
    };
    for (const std::uint16_t k : summary.keys) {
      if (!has_key[k]) cover(k);
    }
    std::uint64_t closed = 0;
    for (int row = 0; row < plane.height(); ++row) {
      for (int col = 0; col < plane.width(); ++col) {
        const int at = row * side + col;
        if ((*before.at(col, row) & plane_bit::kept) != 0) {
          EXPECT_TRUE(std::binary_search(summary.keys.begin(), summary.keys.end(), at));
        }
        if (has_key[static_cast<std::size_t>(at)]) continue;
        ++closed;  // a component without a key: count it once
        cover(at);
      }
    }
    EXPECT_EQ(summary.closed_components, closed);
    EXPECT_EQ(summary.milestones, std::uint64_t{grid.cols} * grid.rows);
  }
}

}  // namespace
}  // namespace warren
