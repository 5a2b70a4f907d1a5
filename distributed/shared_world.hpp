// SPDX-License-Identifier: BSD-3-Clause
// The world that ranks share: a maze whose tiles any of them can make, or a file of which each reads its part. Files of
// different hosts may have one name and other walls, so the ranks compare what they see before they begin.
#pragma once

#include <string>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::distributed {

struct SharedWorld {
  Scene scene;        ///< without its walls (is_unmade)
  std::string facts;  ///< what all ranks must see of it; of a .maze all its checksums, of a .npy its size and outline
};

/// Reads what a file says of itself: a .maze's header and checksums, a .npy's header and the four walls of the outline,
/// no other walls. Throws UsageError for what ranks do not share, InputError, ReadError, Stopped.
SharedWorld shared_world(const std::string& source, const Execution& execution);

}  // namespace warren::distributed
