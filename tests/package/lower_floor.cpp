// SPDX-License-Identifier: BSD-3-Clause
// Uses warren::core alone: do two segments cross?
#include <warren/core/plane/geometry.hpp>

int main() {
  const warren::Segment rising{{0.0, 0.0}, {1.0, 1.0}};
  const warren::Segment falling{{0.0, 1.0}, {1.0, 0.0}};
  return warren::segments_touch(rising, falling) ? 0 : 1;
}
