// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/heading_layers_of_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "core/plane/minkowski.hpp"
#include "parallel/chunks.hpp"
#include "worlds/rasters/heading_footprints.hpp"
#include "worlds/rasters/polygons_on_lattice.hpp"

namespace warren {
namespace {

/// Cells at row dy and columns first .. last from a position.
struct StampRun {
  int dy;
  int first;
  int last;
};

/// Which cells, as offsets from the position, a body touches.
struct Stamp {
  std::vector<StampRun> runs;
  int least_x = 0;  // of all cells
  int most_x = 0;
  int least_y = 0;
  int most_y = 0;

  void add(const StampRun& run) {
    runs.push_back(run);
    least_x = std::min(least_x, run.first);
    most_x = std::max(most_x, run.last);
    least_y = std::min(least_y, run.dy);
    most_y = std::max(most_y, run.dy);
  }
  int widest() const {
    int most = 0;
    for (const StampRun& run : runs) most = std::max(most, run.last - run.first + 1);
    return most;
  }
};

/// to[w] |= the bits of `from` beginning at `first`, for all words of `to`.
void or_from(std::span<const std::uint64_t> from, std::size_t first, std::span<std::uint64_t> to) {
  const std::uint64_t* words = from.data() + first / 64;
  const unsigned shift = first % 64;
  if (shift == 0) {
    for (std::size_t w = 0; w < to.size(); ++w) to[w] |= words[w];
    return;
  }
  for (std::size_t w = 0; w < to.size(); ++w) to[w] |= words[w] >> shift | words[w + 1] << (64 - shift);
}

/// Widens a bitmap by a stamp.
class Widening {
 public:
  Widening(const Bitmap& blocked, const Stamp& stamp)
      : blocked_(blocked), stamp_(stamp), result_(blocked.width(), blocked.height()) {
    const int reach = std::max({-stamp.least_x, stamp.most_x, stamp.widest()});
    margin_ = (as_whole<std::size_t>(reach) / 64 + 1) * 64;
    const std::size_t words = blocked.row(0).size() + 2 * (margin_ / 64) + 2;
    const auto widest = as_whole<unsigned>(stamp.widest());
    doubled_.assign(as_whole<std::size_t>(std::bit_width(widest)), std::vector<std::uint64_t>(words, 0));
  }

  Bitmap run(const Execution& execution) {
    for (std::uint32_t y = 0; y < blocked_.height(); ++y) {
      execution.check();
      const auto row = blocked_.row(y);
      if (std::any_of(row.begin(), row.end(), [](std::uint64_t word) { return word != 0; })) widen_row(y);
    }
    clear_beyond_width();
    block_border();
    return std::move(result_);
  }

 private:
  /// doubled_[n] bit t: is any of the row's bits t .. t + 2^n - 1 set? The row begins at bit margin_.
  void double_row(std::uint32_t y) {
    const auto row = blocked_.row(y);
    std::copy(row.begin(), row.end(), doubled_[0].begin() + as_whole<std::ptrdiff_t>(margin_ / 64));
    for (std::size_t n = 1; n < doubled_.size(); ++n) {
      std::vector<std::uint64_t>& wide = doubled_[n];
      wide = doubled_[n - 1];
      const std::size_t by = std::size_t{1} << (n - 1);
      const std::size_t words = wide.size() - by / 64 - 1;
      or_from(doubled_[n - 1], by, std::span(wide).first(words));
    }
  }

  void widen_row(std::uint32_t y) {
    double_row(y);
    for (const StampRun& run : stamp_.runs) {
      const std::int64_t to = std::int64_t{y} - run.dy;
      if (to < 0 || to >= blocked_.height()) continue;
      const auto length = as_whole<unsigned>(run.last - run.first + 1);
      const auto n = as_whole<std::size_t>(std::bit_width(length) - 1);
      const auto out = result_.row(as_whole<std::uint32_t>(to));
      const auto at = [&](int dx) { return as_whole<std::size_t>(as_whole<std::int64_t>(margin_) + dx); };
      or_from(doubled_[n], at(run.first), out);
      or_from(doubled_[n], at(run.last + 1 - (1 << n)), out);
    }
  }

  void clear_beyond_width() {
    if (blocked_.width() % 64 == 0) return;
    const std::uint64_t mask = (std::uint64_t{1} << blocked_.width() % 64) - 1;
    for (std::uint32_t y = 0; y < blocked_.height(); ++y) result_.row(y).back() &= mask;
  }

  /// Positions from which the stamp reaches beyond the map.
  void block_border() {
    const std::int64_t width = blocked_.width();
    const std::int64_t height = blocked_.height();
    const auto column = [&](std::int64_t x) { return as_whole<std::uint32_t>(std::clamp<std::int64_t>(x, 0, width)); };
    for (std::int64_t y = 0; y < height; ++y) {
      const auto row = as_whole<std::uint32_t>(y);
      if (y + stamp_.least_y < 0 || y + stamp_.most_y >= height) {
        result_.set_run(row, 0, column(width));
        continue;
      }
      result_.set_run(row, 0, column(-stamp_.least_x));
      result_.set_run(row, column(width - stamp_.most_x), column(width));
    }
  }

  const Bitmap& blocked_;
  const Stamp& stamp_;
  Bitmap result_;
  std::size_t margin_;  // bits before a row's first, a multiple of 64
  std::vector<std::vector<std::uint64_t>> doubled_;
};

class MapLayers {
 public:
  MapLayers(const OccupancyMap& map, double clearance, const Execution& execution)
      : map_(map), execution_(execution), room_(clearance) {
    // The world's coordinates are rounded: what is free here shall be free there.
    constexpr double rounding = 1e-13;
    const double size = map.cell * (double{1} * map.width() + map.height());
    room_ += rounding * (std::abs(map.origin.x) + std::abs(map.origin.y) + size);
  }

  void make(const std::vector<LayerJob>& jobs, std::vector<Bitmap>& bitmaps) const {
    execution_.reserve(jobs.size() * map_.blocked.bytes());
    bitmaps.resize(jobs.size());
    for_chunks(jobs.size(), 1, execution_, [&](Range r) {
      const Stamp stamp = stamp_of(jobs[r.first]);
      bitmaps[r.first] = Widening(map_.blocked, stamp).run(execution_);
    });
  }

 private:
  /// A position touches the square around a point exactly if the point is in the sum of body and square.
  Stamp stamp_of(const LayerJob& job) const {
    constexpr double most_reach = 1 << 29;  // cells: wider than all that memory holds
    const double half = map_.cell / 2;
    const std::vector<Vec2> square{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    double reach = 0.0;
    for (const ConvexPiece& piece : job.pieces) {
      for (const Vec2 p : piece) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
    }
    const auto most = bounded_whole<int>(std::ceil((reach + room_ + half) / map_.cell), 0.0, most_reach) + 1;
    const double corner = -most * map_.cell;
    const auto side = as_whole<std::uint32_t>(2 * most + 1);
    execution_.reserve(Bitmap::bytes_for(side, side));
    LatticeMarking marking({corner, corner}, map_.cell, side, side);
    for (const ConvexPiece& piece : job.pieces) marking.mark_near(minkowski_sum(piece, square), room_);
    return runs_of(marking.take(), most);
  }

  static Stamp runs_of(const Bitmap& marked, int most) {
    Stamp stamp;
    const auto side = as_whole<int>(marked.width());
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        if (!marked.holds(i, j)) continue;
        const int first = i;
        while (marked.holds(i + 1, j)) ++i;
        stamp.add({j - most, first - most, i - most});
      }
    }
    return stamp;
  }

  const OccupancyMap& map_;
  const Execution& execution_;
  double room_;
};

}  // namespace

HeadingLayers map_layers(const OccupancyMap& map, std::span<const Vec2> outline, std::uint32_t angles, double clearance,
                         const Execution& execution) {
  if (outline.size() < 3) throw InputError("robot", "a polygon needs three corners or more");
  if (!(clearance >= 0.0)) throw InputError("clearance", "must be a number from 0", std::to_string(clearance));
  HeadingLayers layers;
  layers.origin = {0.5 * map.cell, 0.5 * map.cell};
  layers.cell = map.cell;
  layers.width = map.width();
  layers.height = map.height();
  layers.angles = angles;
  if (angles < 1 || map.blocked.size() > HeadingLayers::most_states / angles) {
    throw InputError(
        "grid", "must have from 1 to 2^32 - 4 states: the map's cells times headings",
        std::to_string(map.width()) + " x " + std::to_string(map.height()) + " x " + std::to_string(angles));
  }
  constexpr double widest = 4096.0;  // cells: half a stamp, which has 8 MB then
  double reach = clearance;
  for (const Vec2 p : outline) reach = std::max(reach, clearance + norm(p));
  if (!(reach / map.cell < widest)) {
    throw InputError("robot", "reaches over more than 4096 cells of the map", std::to_string(reach));
  }
  const std::vector<LayerJob> jobs = list_layer_jobs(outline, layers);
  MapLayers(map, clearance, execution).make(jobs, layers.bitmaps);
  return layers;
}

}  // namespace warren
