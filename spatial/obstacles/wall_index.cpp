// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/wall_index.hpp"

#include <utility>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"

namespace warren {

namespace detail {
namespace {

/// Vectors of numbers, and of what comparing them gives, for machines with registers of so many bytes.
template <class T, std::size_t bytes>
struct LanesOf {
  using Numbers [[gnu::vector_size(bytes)]] = T;
  using Indices [[gnu::vector_size(bytes)]] = typename MotionBunch<T>::Index;
};

/// A wall's box.
template <class T>
struct Ends {
  T low_x, low_y, high_x, high_y;
};
template <class T>
Ends<T> ends_of(const WallOf<T>& wall) {
  return {std::min(wall.x1, wall.x2), std::min(wall.y1, wall.y2), std::max(wall.x1, wall.x2),
          std::max(wall.y1, wall.y2)};
}

}  // namespace

template <class T>
template <std::size_t bytes>
[[gnu::always_inline]] inline void MotionBunch<T>::sift_with(MotionBunch& bunch, std::span<const WallOf<T>> walls) {
  using Lanes = typename LanesOf<T, bytes>::Numbers;
  using IndexLanes = typename LanesOf<T, bytes>::Indices;
  constexpr std::size_t width = sizeof(Lanes) / sizeof(T);
  for (std::size_t lane = 0; lane < most; lane += width) {
    Lanes left;
    Lanes bottom;
    Lanes right;
    Lanes top;
    std::memcpy(&left, &bunch.left_[lane], sizeof left);
    std::memcpy(&bottom, &bunch.bottom_[lane], sizeof bottom);
    std::memcpy(&right, &bunch.right_[lane], sizeof right);
    std::memcpy(&top, &bunch.top_[lane], sizeof top);
    IndexLanes count{};
    IndexLanes first{};
    IndexLanes last{};
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const auto [low_x, low_y, high_x, high_y] = ends_of(walls[i]);
      const IndexLanes meets = (Lanes{} + high_x >= left) & (Lanes{} + low_x <= right) & (Lanes{} + high_y >= bottom) &
                               (Lanes{} + low_y <= top);
      const IndexLanes index = IndexLanes{} + as_whole<Index>(i);
      last = (index & meets) | (last & ~meets);
      first |= index & meets & (count == 0);
      count -= meets;
    }
    std::memcpy(&bunch.count_[lane], &count, sizeof count);
    std::memcpy(&bunch.first_[lane], &first, sizeof first);
    std::memcpy(&bunch.last_[lane], &last, sizeof last);
  }
}

template <class T>
void MotionBunch<T>::sift(std::span<const WallOf<T>> walls, InstructionSet set) noexcept {
  const auto work = set == InstructionSet::baseline ? &VersionsOf<&MotionBunch::template sift_with<16>>::baseline
                                                    : &VersionsOf<&MotionBunch::template sift_with<32>>::avx2;
  work(*this, walls);
}

template class MotionBunch<float>;
template class MotionBunch<double>;

}  // namespace detail

// Builds a WallGrid: chooses the cell, cuts walls into pieces, and sorts the pieces into cells by counting, first into
// bands of rows (each chunk of walls its own counts), then band by band in cache. See wall_index.hpp for the bounds.

/// What the cell size follows from; sums over the walls that are filed.
struct WallStatistics {
  Box box;
  std::size_t walls = 0;
  double total_length = 0.0;   ///< of max(|dx|, |dy|)
  double median_length = 0.0;  ///< of a sample
};

/// A wall and the part of it that is to be filed (the whole wall, or a piece that a coarser grid handed down).
template <class T>
struct FiledWall {
  WallOf<T> wall;
  Segment part;
};

/// One pass over the parts of n filed walls.
template <class Filed>
WallStatistics statistics_of(std::size_t n, const Filed& filed, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 16;
  const auto length_of = [](const Segment& s) { return std::max(std::abs(s.b.x - s.a.x), std::abs(s.b.y - s.a.y)); };
  const auto of_chunk = [&](Range r) {
    WallStatistics part;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const Segment s = filed(i).part;
      part.box.include(box_of(s));
      part.total_length += length_of(s);
    }
    return part;
  };
  WallStatistics result;
  result.walls = n;
  for (const WallStatistics& part : parts_of_chunks(n, grain, execution, of_chunk)) {
    result.box.include(part.box);
    result.total_length += part.total_length;
  }
  constexpr std::size_t sampled = 1001;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < std::min(n, sampled); ++i)
    lengths.push_back(length_of(filed(i * n / std::min(n, sampled)).part));
  if (!lengths.empty()) {
    const auto middle = lengths.begin() + as_whole<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    result.median_length = *middle;
  }
  return result;
}

/// The part of a segment inside a box (Liang and Barsky 1984); the segment itself if rounding leaves nothing.
inline Segment clipped(const Segment& s, const Box& box) {
  double from = 0.0;
  double to = 1.0;
  const auto cut = [&](double start, double along, double low, double high) {
    if (along == 0.0) return;
    const double t1 = (low - start) / along;
    const double t2 = (high - start) / along;
    from = std::max(from, std::min(t1, t2));
    to = std::min(to, std::max(t1, t2));
  };
  const Vec2 along = s.b - s.a;
  cut(s.a.x, along.x, box.min.x, box.max.x);
  cut(s.a.y, along.y, box.min.y, box.max.y);
  if (!(from <= to)) return s;
  return {from == 0.0 ? s.a : s.a + from * along, to == 1.0 ? s.b : s.a + to * along};
}

template <class T>
class WallGridBuilder {
 public:
  /// Chooses the cell. depth: 0, or that of a finer grid.
  WallGridBuilder(const WallStatistics& s, unsigned depth, const Execution& execution)
      : depth_(depth), execution_(execution) {
    const Box box = s.box.empty() ? Box{{}, {}} : s.box;
    const double width = box.width();
    const double height = box.height();
    const double longest = std::max({width, height, 1e-90});
    const double area = std::max(width, 1e-6 * longest) * std::max(height, 1e-6 * longest);
    const auto n = static_cast<double>(std::max<std::size_t>(s.walls, 1));
    const double slack = depth == 0 ? 65536.0 : 64.0;
    double h = std::sqrt(area / n);
    if (s.total_length > 0.0) h = std::min(h, area / s.total_length);
    h = std::max({h, std::sqrt(area / (2 * n + slack)), s.total_length / (4 * n + slack), longest * 1e-9});
    if (s.median_length >= h && s.median_length <= 2 * h) h = s.median_length * (1 + 1e-9);
    rounding_ = 1e-15 * std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
    grid_.cell_ = h;
    grid_.inverse_cell_ = 1.0 / h;
    // Off the lines that walls lie on, so that equal walls fall into equal cells.
    grid_.origin_ = {box.min.x - 0.43 * h, box.min.y - 0.43 * h};
    grid_.cols_ = bounded_whole<std::uint32_t>(width / h + 0.43) + 1;
    grid_.rows_ = bounded_whole<std::uint32_t>(height / h + 0.43) + 1;
    const std::size_t cells = std::size_t{grid_.cols_} * grid_.rows_;
    band_cells_ = as_whole<std::uint32_t>(std::max<std::size_t>(cells / 512 + 1, std::size_t{1} << 14));
    bands_ = as_whole<std::uint32_t>((cells + band_cells_ - 1) / band_cells_);
  }

  /// filed(i) gives the i-th of n walls as FiledWall<T>.
  template <class Filed>
  WallGrid<T> build(std::size_t n, const Filed& filed) {
    const auto cell_at = [this](Vec2 p) { return grid_.row_of(p.y) * grid_.cols_ + grid_.col_of(p.x); };
    const std::size_t chunks = chunk_count(n, grain);
    std::vector<std::uint32_t> counts(chunks * bands_ + 1, 0);  // [band][chunk], then where each begins
    std::vector<Vec2> reaches(chunks);
    for_chunks(n, grain, execution_, [&](Range r) {
      const std::size_t chunk = r.first / grain;
      Vec2 reach;
      for (std::size_t i = r.first; i < r.last; ++i) {
        for_each_piece(filed(i).part, [&](Vec2 middle, const Segment& piece) {
          ++counts[std::size_t{band_of(cell_at(middle))} * chunks + chunk];
          const Box box = box_of(piece);
          reach = {std::max({reach.x, middle.x - box.min.x, box.max.x - middle.x}),
                   std::max({reach.y, middle.y - box.min.y, box.max.y - middle.y})};
        });
      }
      reaches[chunk] = reach;
    });
    for (const Vec2 reach : reaches)
      grid_.reach_ = {std::max(grid_.reach_.x, reach.x), std::max(grid_.reach_.y, reach.y)};
    grid_.reach_ = (1 + 1e-9) * grid_.reach_ + Vec2{rounding_, rounding_};
    std::uint32_t total = 0;
    for (std::uint32_t& count : counts) total += std::exchange(count, total);
    execution_.reserve(std::size_t{total} * (sizeof(Staged) + sizeof(WallOf<T>)) +
                       std::size_t{bands_} * band_cells_ * 4);
    RawVector<Staged> staged(total);
    touch_first(staged, execution_);
    std::vector<std::uint32_t> next(counts);
    for_chunks(n, grain, execution_, [&](Range r) {
      for (std::size_t i = r.first; i < r.last; ++i) {
        const FiledWall<T> wall = filed(i);
        for_each_piece(wall.part, [&](Vec2 middle, const Segment&) {
          const std::uint32_t cell = cell_at(middle);
          staged[next[std::size_t{band_of(cell)} * chunks + r.first / grain]++] = {cell, wall.wall};
        });
      }
    });
    grid_.offsets_.resize(std::size_t{grid_.cols_} * grid_.rows_ + 1);
    grid_.offsets_.back() = total;
    grid_.walls_.resize(total);
    for_chunks(bands_, 1, execution_, [&](Range r) {
      const std::size_t first = counts[r.first * chunks];
      const std::size_t last = counts[(r.first + 1) * chunks];
      sort_band({staged.data() + first, last - first}, as_whole<std::uint32_t>(r.first), first);
    });
    refine_crowded_cells();
    return std::move(grid_);
  }

 private:
  struct Staged {
    std::uint32_t cell;
    WallOf<T> wall;
  };
  static constexpr std::size_t grain = std::size_t{1} << 16;
  static constexpr unsigned deepest = 16;
  static constexpr std::uint32_t crowded = 64;

  template <class F>
  void for_each_piece(const Segment& part, const F& f) const {
    const Vec2 along = part.b - part.a;
    const double longest = std::max(std::abs(along.x), std::abs(along.y));
    if (longest <= grid_.cell_) {
      f(0.5 * (part.a + part.b), part);
      return;
    }
    const auto pieces = bounded_whole<std::uint32_t>(std::ceil(longest * grid_.inverse_cell_));
    Vec2 from = part.a;
    for (std::uint32_t i = 1; i <= pieces; ++i) {
      const Vec2 to = i == pieces ? part.b : part.a + (static_cast<double>(i) / pieces) * along;
      f(0.5 * (from + to), Segment{from, to});
      from = to;
    }
  }
  std::uint32_t band_of(std::uint32_t cell) const { return cell / band_cells_; }
  void sort_band(std::span<const Staged> staged, std::uint32_t band, std::size_t first) {
    const std::size_t first_cell = std::size_t{band} * band_cells_;
    const std::size_t cells = std::min<std::size_t>(band_cells_, grid_.offsets_.size() - 1 - first_cell);
    std::uint32_t* offsets = grid_.offsets_.data() + first_cell;
    std::fill(offsets, offsets + cells, 0U);
    for (const Staged& s : staged) ++offsets[s.cell - first_cell];
    auto at = as_whole<std::uint32_t>(first);
    for (std::size_t c = 0; c < cells; ++c) at += std::exchange(offsets[c], at);
    for (const Staged& s : staged) grid_.walls_[offsets[s.cell - first_cell]++] = s.wall;
    for (std::size_t c = cells; c-- > 1;) offsets[c] = offsets[c - 1];  // each offset has moved to its cell's end
    if (cells > 0) offsets[0] = as_whole<std::uint32_t>(first);
  }
  void refine_crowded_cells() {
    if (depth_ >= deepest) return;
    const std::size_t cells = grid_.offsets_.size() - 1;
    std::vector<std::vector<std::uint32_t>> found(chunk_count(cells, grain));
    for_chunks(cells, grain, execution_, [&](Range r) {
      for (std::size_t c = r.first; c < r.last; ++c) {
        if (grid_.offsets_[c + 1] - grid_.offsets_[c] > crowded)
          found[r.first / grain].push_back(as_whole<std::uint32_t>(c));
      }
    });
    for (const auto& part : found) {
      for (const std::uint32_t cell : part) refine_cell(cell);
    }
  }
  void refine_cell(std::uint32_t cell) {
    const std::size_t first = grid_.offsets_[cell];
    const std::size_t n = grid_.offsets_[cell + 1] - first;
    const Vec2 low = grid_.origin_ + Vec2{(cell % grid_.cols_) * grid_.cell_, (cell / grid_.cols_) * grid_.cell_};
    const Vec2 reach = grid_.reach_ + Vec2{rounding_, rounding_};
    const Box region{low - reach, low + Vec2{grid_.cell_, grid_.cell_} + reach};
    const RawVector<WallOf<T>> walls(grid_.walls_.begin() + first, grid_.walls_.begin() + first + n);
    const auto filed = [&](std::size_t i) { return FiledWall<T>{walls[i], clipped(walls[i].segment(), region)}; };
    WallGridBuilder finer(statistics_of(n, filed, execution_), depth_ + 1, execution_);
    if (finer.grid_.cell_ > grid_.cell_ / 4) return;  // long or equal walls: a finer grid would hold them all again
    if (grid_.child_of_.empty()) grid_.child_of_.assign(grid_.offsets_.size() - 1, WallGrid<T>::no_child);
    grid_.child_of_[cell] = as_whole<std::uint32_t>(grid_.children_.size());
    grid_.children_.push_back(finer.build(n, filed));
  }

  WallGrid<T> grid_;
  unsigned depth_;
  const Execution& execution_;
  std::uint32_t band_cells_ = 1;
  std::uint32_t bands_ = 1;
  double rounding_ = 0.0;  ///< pieces may lie beside their wall by so much: some units in the last place
};

namespace {

bool fits_float(std::span<const Segment> segments) {
  return WallSet::narrowest(segments).visit(
      []<class Wall>(std::span<const Wall>) { return std::is_same_v<typename Wall::Number, float>; });
}

/// Are all points of s farther than r from p, or just r? Squared and without a division.
bool keeps(Vec2 p, const Segment& s, double r_sq) noexcept {
  const Vec2 along = s.b - s.a;
  const Vec2 to_p = p - s.a;
  const double length_sq = dot(along, along);
  const double t = dot(to_p, along);
  if (t <= 0.0) return dot(to_p, to_p) >= r_sq;
  if (t >= length_sq) return dot(p - s.b, p - s.b) >= r_sq;
  const double c = cross(along, to_p);
  return c * c >= r_sq * length_sq;
}

/// WallIndex::keep_clearance, r > 0. A bunch with too many walls around it is halved.
template <class T>
std::uint32_t keep_clearance_in(const WallGrid<T>& grid, std::span<const Segment> motions, double r) noexcept {
  constexpr std::size_t room = 128;
  std::array<WallOf<T>, room> walls;
  detail::MotionBunch<T> bunch(motions, r);
  const std::size_t count = grid.copy_near(bunch.around(), walls.data(), room);
  if (count == grid.no_room) {
    if (motions.size() == 1) {
      return grid.for_each_along(motions[0], r,
                                 [&](const Segment& wall) { return segments_keep_distance(motions[0], wall, r); });
    }
    const std::size_t half = motions.size() / 2;
    return keep_clearance_in(grid, motions.first(half), r) | keep_clearance_in(grid, motions.subspan(half), r) << half;
  }
  bunch.sift({walls.data(), count});
  const auto keeps_off = [&](std::size_t i, std::size_t wall) {
    return segments_keep_distance(motions[i], walls[wall].segment(), r);
  };
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    bool keeps = bunch.count(i) == 0 || keeps_off(i, bunch.first(i));
    if (bunch.count(i) > 1) keeps = keeps && keeps_off(i, bunch.last(i));
    if (bunch.count(i) > 2 && keeps) {
      const BoxScreen<T> screen(box_of(motions[i]).grown(r));
      for (std::size_t w = bunch.first(i) + 1; keeps && w < bunch.last(i); ++w) {
        keeps = !screen.meets(walls[w]) || keeps_off(i, w);
      }
    }
    kept |= std::uint32_t{keeps} << i;
  }
  return kept;
}

}  // namespace

/// Most pairs lie on one side of the line of one of the two, far enough from it: that is asked first, and beyond
/// rounding, so that the ends would say the same. Whether they cross is decided by plain doubles: in doubt an end is
/// within rounding of the other segment, and its distance decides.
bool segments_keep_distance(const Segment& s, const Segment& t, double r) noexcept {
  constexpr double beyond_rounding = 1.0 + 1e-12;
  const double r_sq = r * r;
  const Vec2 u = s.b - s.a;
  const Vec2 v = t.b - t.a;
  const double a1 = cross(u, t.a - s.a);
  const double a2 = cross(u, t.b - s.a);
  const double b1 = cross(v, s.a - t.a);
  const double b2 = cross(v, s.b - t.a);
  const bool is_beside_s = (a1 > 0) == (a2 > 0);
  const bool is_beside_t = (b1 > 0) == (b2 > 0);
  const bool far_from_s = is_beside_s & (std::min(a1 * a1, a2 * a2) > beyond_rounding * r_sq * dot(u, u));
  const bool far_from_t = is_beside_t & (std::min(b1 * b1, b2 * b2) > beyond_rounding * r_sq * dot(v, v));
  if (far_from_s | far_from_t) return true;
  if (!is_beside_s && !is_beside_t) return false;
  return keeps(t.a, s, r_sq) && keeps(t.b, s, r_sq) && keeps(s.a, t, r_sq) && keeps(s.b, t, r_sq);
}

WallIndex::WallIndex(const WallSet& walls, std::span<const Segment> more, const Execution& execution)
    : wall_count_(walls.size() + more.size()) {
  if (wall_count_ > (std::size_t{1} << 31)) throw InputError("walls", "at most 2^31 walls can be indexed");
  walls.visit([&]<class Span>(Span given) {
    using T = typename Span::element_type::Number;
    const auto build = [&]<class U>(U) {
      const auto filed = [&](std::size_t i) {
        const Segment s = i < given.size() ? given[i].segment() : more[i - given.size()];
        return FiledWall<U>{WallOf<U>::of(s.a.x, s.a.y, s.b.x, s.b.y), s};
      };
      const WallStatistics statistics = statistics_of(wall_count_, filed, execution);
      box_ = statistics.box;
      grid_ = WallGridBuilder<U>(statistics, 0, execution).build(wall_count_, filed);
    };
    if (std::is_same_v<T, float> && fits_float(more)) {
      build(float{});
    } else {
      build(double{});
    }
  });
}

std::size_t WallIndex::bytes() const {
  return std::visit([](const auto& grid) { return grid.bytes(); }, grid_);
}

std::vector<Segment> WallIndex::some_walls(std::size_t most) const {
  return std::visit(
      [most](const auto& grid) {
        const std::size_t n = std::min(most, grid.filed_count());
        std::vector<Segment> walls(n);
        for (std::size_t i = 0; i < n; ++i) walls[i] = grid.filed(i * grid.filed_count() / n);
        return walls;
      },
      grid_);
}

bool WallIndex::blocks(Vec2 a, Vec2 b) const noexcept {
  const Segment motion{a, b};
  const auto passes = [&](const Segment& wall) { return !segments_touch(motion, wall); };
  return !std::visit([&](const auto& grid) { return grid.for_each_along(motion, 0.0, passes); }, grid_);
}

bool WallIndex::keeps_clearance(Vec2 a, Vec2 b, double r) const noexcept {
  if (r <= 0.0) return !blocks(a, b);
  const Segment motion{a, b};
  const auto keeps_off = [&](const Segment& wall) { return segments_keep_distance(motion, wall, r); };
  return std::visit([&](const auto& grid) { return grid.for_each_along(motion, r, keeps_off); }, grid_);
}

std::uint32_t WallIndex::keep_clearance(std::span<const Segment> motions, double r) const noexcept {
  if (motions.empty()) return 0;
  if (r > 0.0) return std::visit([&](const auto& grid) { return keep_clearance_in(grid, motions, r); }, grid_);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) kept |= std::uint32_t{!blocks(motions[i].a, motions[i].b)} << i;
  return kept;
}

double WallIndex::clearance(Vec2 p, double at_most) const noexcept {
  if (wall_count_ == 0) return at_most;
  const double farthest = std::max({p.x - box_.min.x, box_.max.x - p.x, p.y - box_.min.y, box_.max.y - p.y, 0.0});
  const double cell = std::visit([](const auto& grid) { return grid.cell(); }, grid_);
  double nearest_sq = at_most * at_most;
  for (double radius = std::min(cell, at_most);; radius = std::min(2 * radius, at_most)) {
    for_each_near(Box{p, p}.grown(radius), [&](const Segment& wall) {
      nearest_sq = std::min(nearest_sq, distance_sq(p, wall));
      return nearest_sq > 0.0;
    });
    if (nearest_sq <= radius * radius || radius >= at_most || radius > farthest) break;
  }
  return std::min(at_most, std::sqrt(nearest_sq));
}

}  // namespace warren
