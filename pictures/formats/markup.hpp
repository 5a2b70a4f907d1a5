// SPDX-License-Identifier: BSD-3-Clause
// Text of unknown origin inside of SVG and HTML.
#pragma once

#include <string>
#include <string_view>

#include "pictures/formats/write_picture.hpp"
#include "pictures/model/colors.hpp"

namespace warren {

/// & < > " escaped, and "?" for all that can't be seen or acts on others (printable.hpp), but for the line feed.
std::string xml_text(std::string_view text);

/// The same without the escapes: for text that scripts show.
std::string seen_text(std::string_view text);

/// "#1e293b"
std::string css_color(Rgb color);

// Bytes as base 64, piece by piece: images inside of text.

class Base64 {
 public:
  explicit Base64(const Write& write) : write_(write) {}
  void write(std::string_view bytes);
  /// Writes what is left; nothing may follow.
  void end();

 private:
  const Write& write_;
  std::string left_;  // bytes that are no whole group of three
};

}  // namespace warren
