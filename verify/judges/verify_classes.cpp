// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_classes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/raw_vector.hpp"
#include "core/base/whole.hpp"
#include "parallel/asked_memory.hpp"

namespace warren {
namespace {

/// Cells whose middle is nearer than what is kept to a closed blocked square or to the map's outside: the nearest
/// blocked row of each column, then all columns that may be near enough.
Bitmap cells_without_room(const OccupancyMap& map, double keeps, const Execution& execution) {
  execution.reserve(map.blocked.bytes());
  if (!(keeps > 0.0)) return map.blocked;
  const double half_cells = 2.0 * keeps / map.cell;
  const double needed_sq = half_cells * half_cells;
  const auto width = std::int64_t{map.width()};
  const auto height = std::int64_t{map.height()};
  const auto around = std::min(width, bounded_whole<std::int64_t>(0.5 * half_cells + 2.0, 1.0, 1e9));
  const auto count = as_whole<std::size_t>(width * height);
  execution.reserve(sizeof(std::int32_t) * (count + as_whole<std::size_t>(width + 3 * around)));
  RawVector<std::int32_t> rows_off(count);  // to the nearest blocked row
  const auto at = [&](std::int64_t x, std::int64_t y) -> std::int32_t& {
    return rows_off[as_whole<std::size_t>(y * width + x)];
  };
  for (std::int64_t y = 0; y < height; ++y) {
    execution.check();
    for (std::int64_t x = 0; x < width; ++x) at(x, y) = map.blocked.holds(x, y) ? 0 : (y > 0 ? at(x, y - 1) : 0) + 1;
  }
  for (std::int64_t y = height; y-- > 0;) {
    execution.check();
    for (std::int64_t x = 0; x < width; ++x) at(x, y) = std::min(at(x, y), (y + 1 < height ? at(x, y + 1) : 0) + 1);
  }
  const auto gap = [](std::int64_t cells) { return static_cast<double>(std::max<std::int64_t>(2 * cells - 1, 0)); };
  std::vector<std::int32_t> near_rows;  // by columns off: a blocked square fewer rows off is too near
  for (std::int64_t columns = 0; columns <= around; ++columns) {
    execution.check();
    std::int32_t rows = 0;
    while (rows <= height && gap(rows) * gap(rows) + gap(columns) * gap(columns) < needed_sq) ++rows;
    near_rows.push_back(rows);
  }
  Bitmap closed(map.width(), map.height());
  std::vector<std::int32_t> padded(as_whole<std::size_t>(width + 2 * around));  // a row; beyond the map all is blocked
  std::vector<std::uint8_t> is_near(as_whole<std::size_t>(width));
  for (std::int64_t y = 0; y < height; ++y) {
    execution.check();
    std::copy_n(&at(0, y), width, &padded[as_whole<std::size_t>(around)]);
    std::fill(is_near.begin(), is_near.end(), std::uint8_t{0});
    for (std::int64_t off = -around; off <= around; ++off) {
      if (off % 256 == 0) execution.check();
      const std::int32_t rows = near_rows[as_whole<std::size_t>(std::abs(off))];
      const std::int32_t* row = padded.data() + (around + off);
      for (std::size_t x = 0; x < is_near.size(); ++x) is_near[x] |= row[x] < rows ? 1 : 0;
    }
    for (std::int64_t x = 0; x < width; ++x) {
      if (is_near[as_whole<std::size_t>(x)] != 0) closed.set(as_whole<std::uint32_t>(x), as_whole<std::uint32_t>(y));
    }
  }
  return closed;
}

/// Where a ray begins: the middle of a cell.
struct Ray {
  double x;
  double y;
  std::int32_t hole;
};

/// Components by joining runs of a row with those of the row before.
class Holes {
 public:
  Holes(const Bitmap& closed, double least, const Execution& execution) {
    std::size_t below = 0;  // the first run of the row below that the next run may touch
    for (std::uint32_t y = 0; y < closed.height(); ++y) {
      execution.check();
      const std::size_t here = runs_.size();  // the first of this row
      for (std::uint32_t x = 0; x < closed.width(); ++x) {
        if (!closed.test(x, y)) continue;
        const std::uint32_t first = x;
        while (x + 1 < closed.width() && closed.test(x + 1, y)) ++x;
        push_asked(runs_, {first, x, y, runs_.size()}, execution);
        while (below < here && runs_[below].last + 1 < first) ++below;
        for (std::size_t i = below; i < here && runs_[i].first <= x + 1; ++i) join(i, runs_.size() - 1);
      }
      below = here;
    }
    struct Extent {
      Run right;  // that reaches farthest
      Box box;
    };
    std::map<std::size_t, Extent> holes;  // by the first run of each: of its lowest cells the leftmost
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      execution.poll(i);
      const Run& run = runs_[i];
      const auto [found, is_new] = holes.try_emplace(root(i), Extent{run, {}});
      if (is_new) execution.reserve(sizeof *found + 4 * sizeof(void*));  // for the next one
      Extent& extent = found->second;
      if (run.last > extent.right.last) extent.right = run;
      extent.box.include(Box{{1.0 * run.first, 1.0 * run.row}, {run.last + 1.0, run.row + 1.0}});
    }
    execution.reserve(closed.bytes());
    Bitmap ends = closed;  // where cuts end: small holes are passed over
    for (const auto& [number, e] : holes) {
      execution.check();
      const bool at_border =
          e.box.min.x == 0.0 || e.box.min.y == 0.0 || e.box.max.x == closed.width() || e.box.max.y == closed.height();
      if (!at_border && std::max(e.box.width(), e.box.height()) < least) {
        for (std::size_t i = number; i < runs_.size() && runs_[i].row < e.box.max.y; ++i) {
          execution.poll(i);
          for (std::uint32_t x = runs_[i].first; root(i) == number && x <= runs_[i].last; ++x) {
            ends.clear(x, runs_[i].row);
          }
        }
      } else if (!at_border) {
        const auto hole = as_whole<std::int32_t>(rays_.size() + 1);
        push_asked(rays_, {e.right.last + 0.5, e.right.row + 0.5, hole}, execution);
        push_asked(boxes_, e.box, execution);
        push_asked(cuts_, {runs_[number].first, runs_[number].row, runs_[number].row}, execution);
      }
    }
    for (Cut& cut : cuts_) {
      execution.check();
      while (cut.low > 0 && !ends.test(cut.column, cut.low - 1) && !ends.test(cut.column + 1, cut.low - 1)) --cut.low;
    }
    std::stable_sort(rays_.begin(), rays_.end(), [](const Ray& a, const Ray& b) { return a.y < b.y; });
  }

  const std::vector<Box>& boxes() const { return boxes_; }

  /// A place on a cut counts as one to its right. Cuts of one column have no row in common.
  void follow_told(Vec2 a, Vec2 b, std::vector<std::int32_t>& word) const {
    std::vector<std::pair<double, std::int32_t>> met;
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      const double x = cuts_[i].column + 1.0;
      if ((a.x < x) == (b.x < x)) continue;
      const double y = a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x));
      if (y < cuts_[i].low || y >= cuts_[i].high) continue;
      const auto hole = as_whole<std::int32_t>(i + 1);
      met.emplace_back(std::abs(x - a.x), a.x < b.x ? hole : -hole);
    }
    std::sort(met.begin(), met.end());
    for (const auto& [off, letter] : met) add(letter, word);
  }

  /// A leg up from below a ray's height to it or above crosses it; rays of one height lie one on the other in the order
  /// of their holes.
  void follow(Vec2 a, Vec2 b, std::vector<std::int32_t>& word) const {
    const bool up = a.y < b.y;
    const auto first = std::ranges::upper_bound(rays_, std::min(a.y, b.y), {}, &Ray::y);
    const auto last = std::ranges::upper_bound(rays_, std::max(a.y, b.y), {}, &Ray::y);
    for (auto i = 0; i < last - first; ++i) {
      const Ray& ray = up ? first[i] : *(last - 1 - i);
      const double x = a.x + (b.x - a.x) * ((ray.y - a.y) / (b.y - a.y));
      if (x <= ray.x) continue;
      add(up ? ray.hole : -ray.hole, word);
    }
  }

 private:
  static void add(std::int32_t letter, std::vector<std::int32_t>& word) {
    if (!word.empty() && word.back() == -letter) {
      word.pop_back();
    } else {
      word.push_back(letter);
    }
  }
  /// Below a hole's lowest cell, on the line to the next column.
  struct Cut {
    std::uint32_t column;
    std::uint32_t low;
    std::uint32_t high;
  };
  struct Run {
    std::uint32_t first;
    std::uint32_t last;
    std::uint32_t row;
    std::size_t of;
  };
  std::size_t root(std::size_t i) {
    while (runs_[i].of != i) i = runs_[i].of = runs_[runs_[i].of].of;
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t ra = root(a);
    const std::size_t rb = root(b);
    runs_[std::max(ra, rb)].of = std::min(ra, rb);
  }

  std::vector<Run> runs_;
  std::vector<Ray> rays_;
  std::vector<Box> boxes_;
  std::vector<Cut> cuts_;
};

}  // namespace

JudgedClasses judged_classes(const OccupancyMap& map, const ClassRule& rule, std::span<const Path<Vec2>> paths,
                             const Execution& execution) {
  const Holes holes(cells_without_room(map, rule.keeps, execution), rule.hole / map.cell * (1.0 - 1e-12), execution);
  const std::vector<std::vector<std::int32_t>> empty(paths.size());
  execution.reserve(holes.boxes().size() * sizeof(Box));
  JudgedClasses judged{empty, empty, holes.boxes()};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t leg = 1; leg < paths[i].size(); ++leg) {
      execution.check();
      const Vec2 from = map_point(map, paths[i][leg - 1]);
      const Vec2 to = map_point(map, paths[i][leg]);
      holes.follow(from, to, judged.classes[i]);
      holes.follow_told(from, to, judged.told[i]);
    }
  }
  return judged;
}

std::optional<std::pair<std::size_t, std::size_t>> same_class(const std::vector<std::vector<std::int32_t>>& classes) {
  for (std::size_t i = 0; i < classes.size(); ++i) {
    for (std::size_t j = i + 1; j < classes.size(); ++j) {
      if (classes[i] == classes[j]) return std::pair{i, j};
    }
  }
  return std::nullopt;
}

}  // namespace warren
