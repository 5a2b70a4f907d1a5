// SPDX-License-Identifier: BSD-3-Clause
// A tile that lies above the world's: lines and dots in a few inks, transparent where there are none. Where inks meet,
// a pixel has the one that covers most of it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/formats/raster.hpp"
#include "pictures/model/colors.hpp"

namespace warren::serve {

/// Of one thread.
class InkTile {
 public:
  /// At most 16 inks, which outlive it. What draws asks the execution for a quarter of a MiB an ink that is used.
  InkTile(std::span<const Rgb> inks, const Execution& execution);

  /// The pixels of that ink.
  Mask& of(std::size_t ink);
  /// A PNG. Throws Stopped.
  std::string png() const;

 private:
  std::span<const Rgb> inks_;
  const Execution& execution_;
  std::vector<std::optional<Mask>> masks_;
};

}  // namespace warren::serve
