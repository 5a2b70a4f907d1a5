// SPDX-License-Identifier: BSD-3-Clause
// Prices and forbidden areas as words: the same lines in a scene, on a command line and in an answer.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

/// How a line of prices begins.
struct PriceWord {
  std::string_view name;
  std::string_view usage;
  bool once;  ///< in a file
};
inline constexpr std::array<PriceWord, 5> price_line_words{
    {{"clearance-price", "clearance-price P [D]", true},
     {"area", "area F X Y X Y X Y ...", false},
     {"mask", "mask FILE areas F | mask FILE speed [BASE MULTIPLIER] | mask FILE keep-out [F]", false},
     {"keep-out", "keep-out X Y X Y X Y ...", false},
     {"unknown", "unknown F", true}}};

/// Reads what follows the word, one of these, to the line's end: areas and masks are added, others are replaced. Masks
/// are named, not read (scenes/files/ros_map_io.hpp). Throws InputError naming the fields' place, Stopped.
void read_price(const PriceWord& word, scene_text::Fields& fields, Prices& prices, const Execution& execution);

/// Reads such a line from its word on. Throws InputError naming `where`, Stopped.
void read_price_line(std::string_view line, const std::string& where, Prices& prices, const Execution& execution);

/// A line each, which read_price reads back the same; name_of_file(file): what a mask's file is to be called.
std::vector<std::string> price_lines(const Prices& prices,
                                     const std::function<std::string(const std::string&)>& name_of_file);
/// The same by the files' own names.
std::vector<std::string> price_lines(const Prices& prices);

}  // namespace warren
