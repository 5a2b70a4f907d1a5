// SPDX-License-Identifier: BSD-3-Clause
// What SVG and HTML are made of: text of unknown origin, colours, images; and how every page begins. All of it is in
// page/page_io.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/embedded_file.hpp"
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

// Styles and scripts of pages, which the build puts into the library, and how every page begins.

std::span<const EmbeddedFile> page_files();

/// The bytes of one of them.
std::string_view page_file(std::string_view name);

/// A file as the element that runs it.
std::string script_element(std::string_view name);

/// Up to the end of <head>: the title as plain text, the style, and a policy by which nothing is loaded from anywhere
/// and nothing is run but the scripts of that name, as script_element() writes them.
std::string head_of_page(const std::string& title, std::string_view style, std::span<const std::string_view> scripts);

}  // namespace warren
