// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/write_picture.hpp"

#include <fmt/format.h>

#include "scenes/text/output_file_io.hpp"

namespace warren {

std::string ending_of(const std::string& file) {
  const std::size_t dot = file.rfind('.');
  if (dot == std::string::npos || file.find('/', dot) != std::string::npos) return {};
  std::string ending = file.substr(dot);
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

bool is_picture(std::string_view ending) {
  return !ending.empty() && fmt::format(" {} ", picture_endings).find(fmt::format(" {} ", ending)) != std::string::npos;
}

std::vector<std::string> write_picture(const std::string& file, const Picture& picture, const PictureOptions& options,
                                       const Execution& execution) {
  options.validate();
  const std::string ending = ending_of(file);
  decltype(write_svg)* writer = write_svg;
  if (ending == ".png") writer = write_png;
  if (ending == ".pdf") writer = write_pdf;
  if (ending == ".html") writer = write_html;
  OutputFile output(file, execution);
  std::vector<std::string> notes =
      writer(picture, options, execution, [&](std::string_view bytes) { output.write(bytes); });
  output.commit();
  return notes;
}

}  // namespace warren
