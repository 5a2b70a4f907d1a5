// SPDX-License-Identifier: BSD-3-Clause
// An arm and its solids as the member "arm" of a page's JSON.
#pragma once

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/picture.hpp"

namespace warren {

/// Does the page's script draw an arm in perspective, where it is on its way? Else its perspective is an image.
inline bool moves_arm(const Picture& picture, Parts parts) {
  return picture.solids != nullptr && picture.arm != nullptr && !picture.arm->spines.empty() && parts.has(Part::body);
}

/// Of a picture that moves an arm. Places of space are relative to the view's target, of the picture's world
/// to `origin`. Throws Stopped, and what `write` throws.
void write_page_arm(const Picture& picture, Parts parts, Vec2 origin, const Execution& execution, const Write& write);

}  // namespace warren
