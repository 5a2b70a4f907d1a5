// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/maze_wall_starts.hpp"

namespace warren {
namespace {

using namespace maze;  // NOLINT: the parts of this method

/// Takes the walls of one chunk as WallWriter does, and looks whether those that stand are they.
template <class T>
class WallComparer {
 public:
  explicit WallComparer(const WallOf<T>* walls) : at_(walls) {}
  void make_room() const {}
  void add(T x1, T y1, T x2, T y2, unsigned keep) {
    if (keep == 0) return;
    same_ = same_ && *at_ == WallOf<T>{x1, y1, x2, y2};
    ++at_;
  }
  bool same() const { return same_; }

 private:
  const WallOf<T>* at_;
  bool same_ = true;
};

template <class T>
bool has_walls_as(std::span<const WallOf<T>> walls, const MazeCells& cells, const Execution& execution) {
  const WallStarts starts(cells, false);
  const std::vector<std::size_t> places = places_of(cells, starts, {0, cells.cell_count()}, 4, execution);
  const std::array<WallOf<T>, 4> frame = outline<T>(cells.rows(), cells.cols());
  if (walls.size() != places.back() || !std::equal(frame.begin(), frame.end(), walls.begin())) return false;
  std::vector<std::uint8_t> same(places.size() - 1);
  for_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    WallComparer<T> comparer(walls.data() + places[r.first / wall_grain]);
    for_runs(cells, r, [&](const Run& run) { write_units<T>(cells, starts, run, comparer); });
    same[r.first / wall_grain] = comparer.same() ? 1 : 0;
  });
  return std::find(same.begin(), same.end(), 0) == same.end();
}

template <class T>
WallSet walls_as(const MazeCells& cells, bool merged, const Execution& execution) {
  const WallStarts starts(cells, merged);
  const std::vector<std::size_t> places = places_of(cells, starts, {0, cells.cell_count()}, 4, execution);
  const std::array<WallOf<T>, 4> frame = outline<T>(cells.rows(), cells.cols());
  execution.reserve(places.back() * sizeof(WallOf<T>));
  RawVector<WallOf<T>> walls(places.back());
  std::copy(frame.begin(), frame.end(), walls.begin());
  write_walls<T>(cells, starts, {0, cells.cell_count()}, places, walls.data(), execution);
  return WallSet(std::move(walls));
}

}  // namespace

std::uint64_t interior_walls(const MazeCells& cells, const Execution& execution) {
  const WallStarts starts(cells, false);
  std::vector<std::uint64_t> parts(chunk_count(cells.cell_count(), wall_grain));
  for_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    for_runs(cells, r, [&](const Run& run) { parts[r.first / wall_grain] += starts.count(run); });
  });
  std::uint64_t sum = 0;
  for (const std::uint64_t part : parts) sum += part;
  return sum;
}

WallSet maze_walls(const MazeCells& cells, bool merged, const Execution& execution) {
  if (execution.progress != nullptr) execution.progress->begin("walls", cells.cell_count());
  return walls_are_floats(cells.rows(), cells.cols()) ? walls_as<float>(cells, merged, execution)
                                                      : walls_as<double>(cells, merged, execution);
}

bool has_maze_walls(const WallSet& walls, const MazeCells& cells, const Execution& execution) {
  if (walls.holds_floats() != walls_are_floats(cells.rows(), cells.cols())) return false;
  return walls.visit([&](auto all) { return has_walls_as(all, cells, execution); });
}

}  // namespace warren
