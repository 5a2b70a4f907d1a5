// SPDX-License-Identifier: BSD-3-Clause
// What a question may ask beyond a way from a start to a goal, as words that planners take or refuse: prices, forbidden
// areas, choices of goals. Which planner takes what: kind_of_problem.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/enum_names.hpp"
#include "scenes/scene/prices.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// A word each; keep_out_factor and unknown_factor are the factors that two of them may have, which are prices;
/// goal_heading is the angle of a tolerance or region.
enum class AskedWord : std::uint8_t {
  clearance_price,
  area,
  areas,
  speed_zones,
  keep_out_factor,
  unknown_factor,
  keep_out,
  unknown,
  goal,
  goal_tolerance,
  goal_region,
  goal_heading,
  visit,
  alternatives,
  keep_to
};
/// The options that say them: some say two.
constexpr auto enum_names(AskedWord) {
  return std::array<std::string_view, 15>{
      "clearance_price", "area",           "areas",   "speed_zones",  "keep_out",
      "unknown",         "keep_out",       "unknown", "goal",         "goal_tolerance",
      "goal_region",     "goal_tolerance", "visit",   "alternatives", "keep_to"};
}
using AskedWords = EnumSet<AskedWord>;

/// What is geometry: it says what blocks, and planners of maps or polygons take it with these.
inline constexpr AskedWords restriction_words{AskedWord::keep_out, AskedWord::unknown};
/// What makes places dear.
inline constexpr AskedWords price_words{AskedWord::clearance_price, AskedWord::area,
                                        AskedWord::areas,           AskedWord::speed_zones,
                                        AskedWord::keep_out_factor, AskedWord::unknown_factor};
/// What asks for other ways than the cheapest: homotopy classes, an older path.
inline constexpr AskedWords route_words{AskedWord::alternatives, AskedWord::keep_to};
/// What leaves a choice of goals: of points and discs, and of bodies that turn.
inline constexpr AskedWords choice_words{AskedWord::goal, AskedWord::goal_tolerance, AskedWord::goal_region};
inline constexpr AskedWords pose_choice_words = choice_words | AskedWords{AskedWord::goal_heading};

/// The words that these say.
AskedWords words_in(const Prices& prices);
AskedWords words_in(const GoalRule& rule);
AskedWords words_in(const RouteRule& route);
/// The words that a question says, whatever the world's file says.
inline AskedWords words_in(const Question& question) {
  return words_in(question.prices) | words_in(question.rule) | words_in(question.route);
}
/// The words of both.
inline AskedWords words_in(const Scene& scene, const Question& question) {
  return words_in(prices_of(scene, question)) | words_in(rule_of(scene, question)) | words_in(question.route);
}

/// Reads "F X Y X Y X Y ..."; throws InputError naming `where`.
PricedArea area_value(const std::string& where, std::string_view text);

/// Throws UsageError for prices and rules that no world can be asked for: numbers out of range, areas of two corners.
void check_prices(const Prices& prices);
void check_goal_rule(const GoalRule& rule, std::size_t least_numbers = 2);  ///< of a goal
void check_route_rule(const RouteRule& route);
/// Throws UsageError for what this world and body give no meaning to: unknown cells where there is no map, a reach that
/// nobody says of a body without width, a price of nearness where the path may touch.
void check_asked(const Scene& scene, const Question& question);

}  // namespace warren
