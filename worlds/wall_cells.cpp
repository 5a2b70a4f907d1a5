// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/wall_cells.hpp"

namespace warren {
namespace {

template <class T>
struct WallBoxes {
  alignas(64) std::array<T, WallCells::size> x_min, y_min, x_max, y_max;
};

template <class T>
[[gnu::always_inline]] inline void find_boxes(const WallOf<T>* walls, WallBoxes<T>& boxes) {
  for (std::size_t i = 0; i < WallCells::size; ++i) {
    const WallOf<T> w = walls[i];
    boxes.x_min[i] = w.x1 < w.x2 ? w.x1 : w.x2;
    boxes.x_max[i] = w.x1 < w.x2 ? w.x2 : w.x1;
    boxes.y_min[i] = w.y1 < w.y2 ? w.y1 : w.y2;
    boxes.y_max[i] = w.y1 < w.y2 ? w.y2 : w.y1;
  }
}

template <class T>
[[gnu::always_inline]] inline void widen(const WallBoxes<T>& boxes, BoxLanes<T>& lanes) {
  for (std::size_t i = 0; i < WallCells::size; i += BoxLanes<T>::count) {
    for (std::size_t k = 0; k < BoxLanes<T>::count; ++k) {
      lanes.x_min[k] = boxes.x_min[i + k] < lanes.x_min[k] ? boxes.x_min[i + k] : lanes.x_min[k];
      lanes.y_min[k] = boxes.y_min[i + k] < lanes.y_min[k] ? boxes.y_min[i + k] : lanes.y_min[k];
      lanes.x_max[k] = boxes.x_max[i + k] > lanes.x_max[k] ? boxes.x_max[i + k] : lanes.x_max[k];
      lanes.y_max[k] = boxes.y_max[i + k] > lanes.y_max[k] ? boxes.y_max[i + k] : lanes.y_max[k];
    }
  }
}

[[gnu::always_inline]] inline std::int32_t cell(double unit, double before, double end) {
  const double at = unit - before;
  const double above = at > 0.0 ? at : 0.0;
  return static_cast<std::int32_t>(above < end ? above : end) >> CellAxis::unit_bits;
}

template <class T>
[[gnu::always_inline]] inline void find_cells(const std::array<T, WallCells::size>& low,
                                              const std::array<T, WallCells::size>& high, const CellAxis& axis,
                                              std::array<std::int32_t, WallCells::size>& first,
                                              std::array<std::int32_t, WallCells::size>& last) {
  const CellAxis a = axis;
  for (std::size_t i = 0; i < WallCells::size; ++i) {
    first[i] = cell(whole_below(static_cast<double>(low[i]) * a.per_unit), a.before_first, a.end);
  }
  for (std::size_t i = 0; i < WallCells::size; ++i) {
    last[i] = cell(whole_above(static_cast<double>(high[i]) * a.per_unit), a.before_last, a.end);
  }
}

template <class T>
[[gnu::always_inline]] inline void find(const WallOf<T>* walls, const CellAxis& x, const CellAxis& y, WallCells& cells,
                                        BoxLanes<T>& lanes) {
  WallBoxes<T> boxes;
  find_boxes(walls, boxes);
  widen(boxes, lanes);
  find_cells(boxes.x_min, boxes.x_max, x, cells.column_first, cells.column_last);
  find_cells(boxes.y_min, boxes.y_max, y, cells.row_first, cells.row_last);
}

template <class T>
void find_any(const WallOf<T>* walls, const CellAxis& x, const CellAxis& y, WallCells& cells, BoxLanes<T>& lanes) {
  find(walls, x, y, cells, lanes);
}

#if defined(__x86_64__)
template <class T>
[[gnu::target("avx2")]] void find_avx2(const WallOf<T>* walls, const CellAxis& x, const CellAxis& y, WallCells& cells,
                                       BoxLanes<T>& lanes) {
  find(walls, x, y, cells, lanes);
}

template <class T>
[[gnu::target("avx512f,avx512vl,avx512dq")]] void find_avx512(const WallOf<T>* walls, const CellAxis& x,
                                                              const CellAxis& y, WallCells& cells, BoxLanes<T>& lanes) {
  find(walls, x, y, cells, lanes);
}
#endif

}  // namespace

template <class T>
Box BoxLanes<T>::box() const {
  Box box;
  for (std::size_t k = 0; k < count; ++k) {
    if (x_min[k] > x_max[k]) continue;  // no wall seen
    box.include(Vec2{static_cast<double>(x_min[k]), static_cast<double>(y_min[k])});
    box.include(Vec2{static_cast<double>(x_max[k]), static_cast<double>(y_max[k])});
  }
  return box;
}
template struct BoxLanes<float>;
template struct BoxLanes<double>;

WallCellVariants wall_cell_variants() {
  WallCellVariants variants{};
  variants.list[variants.count++] = {"baseline", find_any<float>, find_any<double>};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    variants.list[variants.count++] = {"AVX2", find_avx2<float>, find_avx2<double>};
  }
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
    variants.list[variants.count++] = {"AVX-512", find_avx512<float>, find_avx512<double>};
  }
#endif
  return variants;
}

const WallCellWork& wall_cell_work() {
  static const WallCellWork fastest = [] {
    const WallCellVariants variants = wall_cell_variants();
    return variants.list[variants.count - 1];
  }();
  return fastest;
}

}  // namespace warren
