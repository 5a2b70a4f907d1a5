// SPDX-License-Identifier: BSD-3-Clause
// CSV as RFC 4180 has it: fields between commas, quoted where they must be.
#pragma once

#include <string>
#include <string_view>

namespace warren {

/// A text as a field, made printable (so it has no ends of lines): in quotes where it holds a comma or a quote.
std::string csv_field(std::string_view text);

}  // namespace warren
