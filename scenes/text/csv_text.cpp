// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/csv_text.hpp"

#include "core/base/printable.hpp"

namespace warren {

std::string csv_field(std::string_view text) {
  std::string shown = printable(text);
  if (shown.find_first_of(",\"") == std::string::npos) return shown;
  std::string quoted = "\"";
  for (const char c : shown) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace warren
