// SPDX-License-Identifier: BSD-3-Clause
// Memory given back before its owner ends. `held = {}` does not do that for a std::vector: it assigns an empty list,
// which keeps the room for the elements that were there.
#pragma once

namespace warren {

/// Leaves containers empty and without room.
template <class... Containers>
void let_go(Containers&... held) noexcept {
  (Containers().swap(held), ...);
}

}  // namespace warren
