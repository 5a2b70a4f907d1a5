// SPDX-License-Identifier: BSD-3-Clause
// The cells of a PathScreen that walls cover once they are grown: a block of walls at a time, as columns of numbers, by
// the widest instructions that this processor has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/whole.hpp"
#include "core/plane/packed_wall.hpp"
#include "verify/near/cell_axis.hpp"

namespace warren {

/// The least and largest coordinates of walls, eight apart side by side.
template <class T>
struct WallLanes {
  static constexpr std::size_t count = 8;
  std::array<T, count> x_min, y_min, x_max, y_max;
};

/// Of a block of walls: the first and last column and row of each.
struct CoveredCells {
  static constexpr std::size_t block_size = 128;
  alignas(64) std::array<std::int32_t, block_size> column_first, column_last, row_first, row_last;

  /// Finds the cells of block_size walls, and widens the lanes by them.
  template <class Wall, class Scale, class T>
  using Work = void (*)(const Wall*, const Scale&, const Scale&, CoveredCells&, WallLanes<T>&);
  /// The same operations by wider instructions where this processor has them and `plain` is not asked: the same cells.
  template <class Wall, class Scale, class T>
  static Work<Wall, Scale, T> fastest(bool plain) {
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
    if (!plain && __builtin_cpu_supports("avx2")) return work_avx2<Wall, Scale, T>;
#else
    static_cast<void>(plain);
#endif
    return work_any<Wall, Scale, T>;
  }

 private:
  template <class T>
  struct Boxes {
    alignas(64) std::array<T, block_size> x_min, y_min, x_max, y_max;
  };

  template <class T>
  [[gnu::always_inline]] static inline void find_boxes(const WallOf<T>* walls, Boxes<T>& boxes) {
    for (std::size_t i = 0; i < block_size; ++i) {
      const WallOf<T> w = walls[i];
      boxes.x_min[i] = w.x1 < w.x2 ? w.x1 : w.x2;
      boxes.x_max[i] = w.x1 < w.x2 ? w.x2 : w.x1;
      boxes.y_min[i] = w.y1 < w.y2 ? w.y1 : w.y2;
      boxes.y_max[i] = w.y1 < w.y2 ? w.y2 : w.y1;
    }
  }

  [[gnu::always_inline]] static inline void find_boxes(const PackedWall* walls, Boxes<std::int32_t>& boxes) {
    for (std::size_t i = 0; i < block_size; ++i) {
      const PackedWall::Ends w = walls[i].ends();
      boxes.x_min[i] = w.x1 < w.x2 ? w.x1 : w.x2;
      boxes.x_max[i] = w.x1 < w.x2 ? w.x2 : w.x1;
      boxes.y_min[i] = w.y1 < w.y2 ? w.y1 : w.y2;
      boxes.y_max[i] = w.y1 < w.y2 ? w.y2 : w.y1;
    }
  }

  template <class T>
  [[gnu::always_inline]] static inline void widen(const Boxes<T>& boxes, WallLanes<T>& lanes) {
    for (std::size_t i = 0; i < block_size; i += WallLanes<T>::count) {
      for (std::size_t k = 0; k < WallLanes<T>::count; ++k) {
        lanes.x_min[k] = boxes.x_min[i + k] < lanes.x_min[k] ? boxes.x_min[i + k] : lanes.x_min[k];
        lanes.y_min[k] = boxes.y_min[i + k] < lanes.y_min[k] ? boxes.y_min[i + k] : lanes.y_min[k];
        lanes.x_max[k] = boxes.x_max[i + k] > lanes.x_max[k] ? boxes.x_max[i + k] : lanes.x_max[k];
        lanes.y_max[k] = boxes.y_max[i + k] > lanes.y_max[k] ? boxes.y_max[i + k] : lanes.y_max[k];
      }
    }
  }

  [[gnu::always_inline]] static inline std::int32_t cell(double units, double before, double end) {
    const double at = units - before;
    return bounded_whole<std::int32_t>(at, 0.0, end) >> cell_quantum_bits;
  }

  [[gnu::always_inline]] static inline std::int32_t cell(std::int32_t units, std::int32_t before, std::int32_t end) {
    const std::int32_t at = units - before;
    const std::int32_t above = at > 0 ? at : 0;
    return (above < end ? above : end) >> cell_quantum_bits;
  }
  [[gnu::always_inline]] static inline void find_cells(const std::array<std::int32_t, block_size>& low,
                                                       const std::array<std::int32_t, block_size>& high,
                                                       const CellStepAxis& axis,
                                                       std::array<std::int32_t, block_size>& first,
                                                       std::array<std::int32_t, block_size>& last) {
    for (std::size_t i = 0; i < block_size; ++i) {
      first[i] = cell(low[i] << axis.shift, axis.before_first, axis.end);
      last[i] = cell(high[i] << axis.shift, axis.before_last, axis.end);
    }
  }

  template <class T>
  [[gnu::always_inline]] static inline void find_cells(const std::array<T, block_size>& low,
                                                       const std::array<T, block_size>& high, const CellAxis& axis,
                                                       std::array<std::int32_t, block_size>& first,
                                                       std::array<std::int32_t, block_size>& last) {
    for (std::size_t i = 0; i < block_size; ++i) {
      first[i] = cell(whole_below(static_cast<double>(low[i]) * axis.per_unit), axis.before_first, axis.end);
    }
    for (std::size_t i = 0; i < block_size; ++i) {
      last[i] = cell(whole_above(static_cast<double>(high[i]) * axis.per_unit), axis.before_last, axis.end);
    }
  }

  template <class Wall, class Scale, class T>
  [[gnu::always_inline]] static inline void work(const Wall* walls, const Scale& x, const Scale& y, CoveredCells& cells,
                                                 WallLanes<T>& lanes) {
    Boxes<T> boxes;
    find_boxes(walls, boxes);
    widen(boxes, lanes);
    find_cells(boxes.x_min, boxes.x_max, x, cells.column_first, cells.column_last);
    find_cells(boxes.y_min, boxes.y_max, y, cells.row_first, cells.row_last);
  }
  template <class Wall, class Scale, class T>
  static void work_any(const Wall* walls, const Scale& x, const Scale& y, CoveredCells& cells, WallLanes<T>& lanes) {
    work(walls, x, y, cells, lanes);
  }
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  template <class Wall, class Scale, class T>
  [[gnu::target("avx2")]] static void work_avx2(const Wall* walls, const Scale& x, const Scale& y, CoveredCells& cells,
                                                WallLanes<T>& lanes) {
    work(walls, x, y, cells, lanes);
  }
#endif
};

}  // namespace warren
