// SPDX-License-Identifier: BSD-3-Clause
// Text of unknown origin inside of SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace warren {

/// & < > " escaped, control characters but the line feed, and what is no UTF-8, replaced.
std::string xml_text(std::string_view text);

}  // namespace warren
