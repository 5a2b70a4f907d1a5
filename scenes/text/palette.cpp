// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/palette.hpp"

#include "core/base/printable.hpp"

namespace warren {

std::string Palette::painted(std::string_view code, std::string_view text) const {
  if (!on_) return printable(text);
  return "\x1b[" + std::string{code} + "m" + printable(text) + "\x1b[0m";
}

}  // namespace warren
