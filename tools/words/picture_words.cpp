// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/picture_words.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec picture_specs[] = {
    {"--show", "LIST",
     "what a picture shows, of world, roadmap, search, path, body, axes, legend, apart by commas (default: all)"},
    {"--heading", "ANGLE",
     "of a body that turns, radians or as 45deg: show where it has no room at that heading, and states as arrows"},
    {"--size", "WxH", "size of a picture in pixels, or in millimetres as 180x120mm (default: as the world asks)"},
    {"--dpi", "N", "pixels an inch of a picture, 10 to 2400 (default: 96, or what a .png's world asks)"},
    {"--title", "TEXT", "title of a picture; an empty one leaves it out (default: the world and how it was solved)"},
};

PageSize size_value(std::string_view option, std::string_view text) {
  PageSize size;
  std::string_view numbers = text;
  if (numbers.ends_with("mm")) size.unit = LengthUnit::mm;
  if (numbers.ends_with("mm") || numbers.ends_with("px")) numbers.remove_suffix(2);
  const std::size_t cross = numbers.find('x');
  const auto width = number_in(numbers.substr(0, cross));
  const auto height = cross < numbers.size() ? number_in(numbers.substr(cross + 1)) : std::nullopt;
  if (!width || !height) {
    throw UsageError(fmt::format("{}: expected WxH in pixels or WxHmm (found: '{}')", option, text));
  }
  size.width = *width;
  size.height = *height;
  return size;
}

}  // namespace

std::span<const OptionSpec> picture_option_specs() { return picture_specs; }

PictureOptions picture_words(const Arguments& arguments, bool is_drawn, std::string_view draws, std::string_view file) {
  PictureOptions options;
  if (!is_drawn) {
    for (const OptionSpec& spec : picture_specs) {
      if (arguments.has(spec.name)) throw UsageError(fmt::format("{}: goes with {}", spec.name, draws));
    }
    return options;
  }
  if (file.ends_with(".html")) {
    for (const char* option : {"--size", "--dpi"}) {
      if (arguments.has(option))
        throw UsageError(fmt::format("{}: a page fills its window; say .svg, .png or .pdf", option));
    }
  }
  if (arguments.has("--show")) {
    options.parts = Parts::none();
    for (const Part part : given_values(arguments, "--show", "--show", choice_value<Part>)) {
      options.parts = options.parts.with(part);
    }
  }
  constexpr double least_dpi = 10.0;
  constexpr double most_dpi = 2400.0;
  options.size = given_value(arguments, "--size", size_value);
  options.dpi = given_value(arguments, "--dpi", number_value, least_dpi, most_dpi);
  options.heading = given_value(arguments, "--heading", angle_value);
  options.title = arguments.value("--title");
  options.validate();
  return options;
}

}  // namespace warren::tools
