// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/motion_bunch.hpp"

#include <algorithm>
#include <cstring>

namespace warren::detail {
namespace {

/// Vectors of numbers, and of what comparing them gives, for machines with registers of so many bytes.
template <class T, std::size_t bytes>
struct LanesOf;
template <>
struct LanesOf<float, 16> {
  using Numbers = float __attribute__((vector_size(16)));
  using Indices = std::int32_t __attribute__((vector_size(16)));
};
template <>
struct LanesOf<float, 32> {
  using Numbers = float __attribute__((vector_size(32)));
  using Indices = std::int32_t __attribute__((vector_size(32)));
};
template <>
struct LanesOf<double, 16> {
  using Numbers = double __attribute__((vector_size(16)));
  using Indices = std::int64_t __attribute__((vector_size(16)));
};
template <>
struct LanesOf<double, 32> {
  using Numbers = double __attribute__((vector_size(32)));
  using Indices = std::int64_t __attribute__((vector_size(32)));
};

}  // namespace

template <class T>
template <std::size_t bytes>
[[gnu::always_inline]] inline void MotionBunch<T>::sift_with(std::span<const WallOf<T>> walls) noexcept {
  using Lanes = typename LanesOf<T, bytes>::Numbers;
  using IndexLanes = typename LanesOf<T, bytes>::Indices;
  constexpr std::size_t width = sizeof(Lanes) / sizeof(T);
  for (std::size_t lane = 0; lane < most; lane += width) {
    Lanes left;
    Lanes bottom;
    Lanes right;
    Lanes top;
    std::memcpy(&left, &left_[lane], sizeof left);
    std::memcpy(&bottom, &bottom_[lane], sizeof bottom);
    std::memcpy(&right, &right_[lane], sizeof right);
    std::memcpy(&top, &top_[lane], sizeof top);
    IndexLanes count{};
    IndexLanes first{};
    IndexLanes last{};
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const WallOf<T>& wall = walls[i];
      const Lanes low_x = Lanes{} + std::min(wall.x1, wall.x2);
      const Lanes high_x = Lanes{} + std::max(wall.x1, wall.x2);
      const Lanes low_y = Lanes{} + std::min(wall.y1, wall.y2);
      const Lanes high_y = Lanes{} + std::max(wall.y1, wall.y2);
      const IndexLanes meets = (high_x >= left) & (low_x <= right) & (high_y >= bottom) & (low_y <= top);
      const IndexLanes index = IndexLanes{} + static_cast<Index>(i);
      last = (index & meets) | (last & ~meets);
      first |= index & meets & (count == 0);
      count -= meets;
    }
    std::memcpy(&count_[lane], &count, sizeof count);
    std::memcpy(&first_[lane], &first, sizeof first);
    std::memcpy(&last_[lane], &last, sizeof last);
  }
}

template <class T>
void MotionBunch<T>::sift_baseline(std::span<const WallOf<T>> walls) noexcept {
  sift_with<16>(walls);
}

template <class T>
[[gnu::target("avx2")]] void MotionBunch<T>::sift_avx2(std::span<const WallOf<T>> walls) noexcept {
  sift_with<32>(walls);
}

template <class T>
void MotionBunch<T>::sift(std::span<const WallOf<T>> walls, InstructionSet set) noexcept {
  set == InstructionSet::avx2 ? sift_avx2(walls) : sift_baseline(walls);
}

template class MotionBunch<float>;
template class MotionBunch<double>;

}  // namespace warren::detail
