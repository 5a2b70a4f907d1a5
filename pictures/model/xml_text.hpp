// SPDX-License-Identifier: BSD-3-Clause
// Text of unknown origin inside of SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace warren {

/// & < > " escaped, and "?" for all that can't be seen or acts on others (printable.hpp), but for the line feed.
std::string xml_text(std::string_view text);

/// The same without the escapes: for text that scripts show.
std::string seen_text(std::string_view text);

}  // namespace warren
