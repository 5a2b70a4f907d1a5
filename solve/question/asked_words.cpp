// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/asked_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse_number(std::string_view option, std::string_view what, std::string_view range, double found) {
  throw UsageError(fmt::format("@{}: {} is a number {} (found: {})", option, what, range, found));
}

/// Where it is said; range: from low to high, in words.
void check_number(std::string_view option, std::string_view what, const std::optional<double>& number, double low,
                  double high, std::string_view range) {
  if (number && !(*number >= low && *number <= high)) refuse_number(option, what, range, *number);
}

AskedWords said(bool is_said, AskedWord word) { return is_said ? AskedWords{word} : AskedWords{}; }

void check_factor(std::string_view option, const std::optional<double>& factor) {
  check_number(option, "a factor", factor, 1.0, largest_price, fmt::format("from 1 to {}", largest_price));
}

void check_area(std::string_view option, const std::vector<Vec2>& corners) {
  if (corners.size() < 3) throw UsageError(fmt::format("@{}: an area takes three corners or more", option));
  if (std::ranges::all_of(corners, [](Vec2 p) { return is_coordinate(p.x) && is_coordinate(p.y); })) return;
  throw UsageError(fmt::format("@{}: coordinates are numbers of at most 1e60", option));
}

void check_mask(const PriceMask& mask) {
  const bool is_speed = mask.kind == MaskKind::speed;
  const std::string_view option = is_speed ? "speed_zones" : mask.kind == MaskKind::keep_out ? "keep_out" : "areas";
  if (mask.kind == MaskKind::areas && !mask.factor) {
    throw UsageError("@areas: a mask needs the factor of its value 100: FILE,F");
  }
  check_factor(option, mask.factor);
  constexpr double most = 1e6;
  if (is_speed && !(std::abs(mask.base) <= most && std::abs(mask.multiplier) <= most)) {
    throw UsageError("@speed_zones: base and multiplier are numbers from -1e6 to 1e6, in per cent");
  }
}

void check_places(std::string_view option, const std::vector<std::vector<double>>& places, std::size_t least = 2) {
  for (const std::vector<double>& place : places) {
    const bool known = place.size() >= least && place.size() <= most_joints;
    if (known && std::ranges::all_of(place, is_coordinate)) continue;
    throw UsageError(fmt::format("@{}: a place is X,Y or X,Y,THETA, each at most 1e60", option));
  }
}

}  // namespace

AskedWords words_in(const Prices& prices) {
  AskedWords words =
      said(prices.clearance.has_value(), AskedWord::clearance_price) | said(!prices.areas.empty(), AskedWord::area) |
      said(!prices.keep_out.empty(), AskedWord::keep_out) | said(prices.opens_unknown(), AskedWord::unknown) |
      said(prices.unknown_factor() > 1.0, AskedWord::unknown_factor);
  for (const PriceMask& mask : prices.masks) {
    words = words | said(mask.kind == MaskKind::areas, AskedWord::areas) |
            said(mask.kind == MaskKind::speed, AskedWord::speed_zones) |
            said(mask.kind == MaskKind::keep_out, mask.factor ? AskedWord::keep_out_factor : AskedWord::keep_out);
  }
  return words;
}

AskedWords words_in(const GoalRule& rule) {
  return said(!rule.others.empty(), AskedWord::goal) | said(rule.tolerance.has_value(), AskedWord::goal_tolerance) |
         said(rule.region.has_value(), AskedWord::goal_region) |
         said(rule.heading_rad.has_value(), AskedWord::goal_heading) |
         said(!rule.visit.empty() || rule.back, AskedWord::visit);
}

AskedWords words_in(const RouteRule& route) {
  return said(route.alternatives.has_value(), AskedWord::alternatives) |
         said(!route.keep_to.empty(), AskedWord::keep_to);
}

PricedArea area_value(const std::string& where, std::string_view text) {
  scene_text::Fields fields(text, {where, 0});
  Prices prices;
  read_price(*std::ranges::find(price_line_words, "area", &PriceWord::name), fields, prices, {});
  return std::move(prices.areas.front());
}

void check_prices(const Prices& prices) {
  if (const auto& clearance = prices.clearance) {
    check_number("clearance_price", "a price", clearance->price, 0.0, largest_price,
                 fmt::format("from 0 to {}", largest_price));
    check_number("clearance_price", "the distance from which nothing is paid", clearance->reach, smallest_coordinate,
                 largest_coordinate, "above 0");
  }
  for (const PricedArea& area : prices.areas) {
    check_factor("area", area.factor);
    check_area("area", area.corners);
  }
  for (const PriceMask& mask : prices.masks) check_mask(mask);
  for (const ScenePolygon& area : prices.keep_out) check_area("keep_out", area.corners);
  if (prices.opens_unknown()) check_factor("unknown", prices.unknown);
}

void check_goal_rule(const GoalRule& rule, std::size_t least_numbers) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  check_number("goal_tolerance", "a distance", rule.tolerance, 0.0, endless, "from 0 on, or inf");
  check_number("goal_region", "a distance", rule.region, 0.0, largest_coordinate, "from 0 to 1e60");
  if (rule.region && rule.tolerance) {
    throw UsageError("@goal_region: any place in it is as good, which leaves nothing to @goal_tolerance; say one");
  }
  const std::string_view of_heading = rule.region ? "goal_region" : "goal_tolerance";
  check_number(of_heading, "an angle", rule.heading_rad, 0.0, 3.15, "from 0 to 3.15 rad");
  check_places("goal", rule.others, least_numbers);
  check_places("visit", rule.visit);
  constexpr std::size_t most_visits = 12;
  if (rule.visit.size() > most_visits) {
    throw UsageError(fmt::format("@visit: takes {} places at most, for which the best order is proved (found: {})",
                                 most_visits, rule.visit.size()));
  }
  if (rule.visit.empty() && rule.back) throw UsageError("@return: is for @visit, the places on the way");
  if (!rule.visit.empty() && (!rule.others.empty() || rule.tolerance || rule.region)) {
    throw UsageError("@visit: is for one goal, and that exactly; several goals, a tolerance or a region are for none");
  }
}

void check_route_rule(const RouteRule& route) {
  check_number("alternatives", "the number of paths", route.alternatives, 1.0, most_alternatives,
               fmt::format("from 1 to {}", most_alternatives));
  check_number("alternatives", "the size of a hole", route.hole, 0.0, largest_coordinate, "from 0 to 1e60");
  check_number("stretch", "a share of the least cost", route.stretch, 1.0, largest_coordinate, "from 1 to 1e60");
  if (route.stretch && !route.alternatives) throw UsageError("@stretch: is for @alternatives");
  if (route.hole && !route.alternatives) throw UsageError("@hole: is for @alternatives");
  if (route.unless_gain && !(*route.unless_gain >= 0.0 && *route.unless_gain < 1.0)) {
    refuse_number("unless_gain", "a share of the cost", "from 0 to below 1", *route.unless_gain);
  }
  if (route.unless_gain && route.keep_to.empty()) throw UsageError("@unless_gain: is for @keep_to");
  check_places("keep_to", route.keep_to);
}

void check_asked(const Scene& scene, const Question& question) {
  const auto& clearance = question.prices.clearance ? question.prices.clearance : scene.prices.clearance;
  for (const Prices* prices : {&scene.prices, &question.prices}) {
    check_prices(*prices);
    for (const PriceMask& mask : prices->masks) {
      if (!mask.read) throw UsageError(fmt::format("{}: nobody has read this mask yet; read_masks() does", mask.file));
    }
  }
  check_goal_rule(question.rule);
  if ((question.prices.opens_unknown() || scene.prices.opens_unknown()) && !scene.map) {
    const std::string said = question.prices.opens_unknown() ? "@unknown" : scene.source + ": its line 'unknown'";
    throw UsageError(fmt::format("{}: only maps have unknown cells, and {} is none", said, scene.source));
  }
  if (clearance && question.contact == Contact::allowed) {
    throw UsageError("@contact: what pays for nearness keeps off, so 'allowed' contradicts @clearance_price");
  }
  if (question.goal_pose && !question.rule.empty()) {
    throw UsageError("@goal_pose: is one pose of an arm's tool; several goals and rules of goals are for the plane");
  }
}

}  // namespace warren
