// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/layer_legends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "scenes/scene/unit_of.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/json_text.hpp"
#include "solve/question/question.hpp"

namespace warren::serve {
namespace {

class Legend {
 public:
  /// opacity: as two hexadecimal digits; empty: opaque.
  void add(Rgb color, std::string_view words, std::string_view opacity = {}) {
    JsonObject entry;
    entry.add("color", fmt::format("#{:02x}{:02x}{:02x}{}", color.red, color.green, color.blue, opacity));
    entry.add("words", words);
    text_ += (text_.size() > 1 ? "," : "") + entry.closed();
  }
  std::string closed() const { return text_ + "]"; }

 private:
  std::string text_ = "[";
};

/// As people read it, what is before the point in groups of three.
std::string grouped_number(double value) {
  const std::string text = human_number(value);
  const std::size_t whole = std::min(text.size(), text.find_first_not_of("0123456789"));
  return whole == 0 ? text : grouped(std::stoull(text.substr(0, whole))) + text.substr(whole);
}

/// Behind a number.
std::string unit_behind(const ServedWorld& world) {
  const std::string_view unit = unit_of(world.outline());
  return unit.empty() ? "" : " " + std::string(unit);
}

/// Of a scale whose steps below `needed` are not seen.
void add_steps(Legend& legend, const Steps& steps, double needed, std::string_view behind) {
  const std::string opacity = fmt::format("{:02x}", step_opacity);
  for (std::size_t step = 0; step < steps.count; ++step) {
    const double low = std::max(needed, static_cast<double>(step) * steps.each);
    const double high = static_cast<double>(step + 1) * steps.each;
    const bool is_last = step + 1 == steps.count;
    if (!is_last && high <= needed) continue;
    legend.add(step_inks[step],
               is_last ? fmt::format("{}{} and more", grouped_number(low), behind)
                       : fmt::format("{} to {}{}", grouped_number(low), grouped_number(high), behind),
               opacity);
  }
}

}  // namespace

std::string passages_legend(std::uint64_t passages, std::uint64_t cells) {
  Legend legend;
  legend.add(component_inks[0], fmt::format("{} between {}, drawn where a cell has 8 pixels or more",
                                            counted(passages, "passage", "passages"), counted(cells, "cell", "cells")));
  return legend.closed();
}

std::string axis_legend(const RoadmapLayer& layer, bool turns) {
  Legend legend;
  legend.add(component_inks[0], fmt::format("{} and {}, as far from all obstacles as can be{}",
                                            counted(layer.milestones(), "place", "places"),
                                            counted(layer.free_edges(), "free edge", "free edges"),
                                            turns ? ", of the disc around the body" : ""));
  return legend.closed();
}

std::string edges_legend(const RoadmapLayer& layer, bool has_curves) {
  Legend legend;
  legend.add(component_inks[0],
             fmt::format("{} and {}{}; where a tile has more than {} edges, milestones alone",
                         counted(layer.milestones(), "milestone", "milestones"),
                         counted(layer.free_edges(), "free edge", "free edges"),
                         has_curves ? ", which cars drive as curves" : "", grouped(most_drawn_edges)));
  return legend.closed();
}

std::string components_legend(const RoadmapLayer& layer) {
  Legend legend;
  const auto& milestones = layer.milestones_of_ink();
  for (std::size_t rank = 0; rank + 1 < component_inks.size(); ++rank) {
    if (milestones[rank] == 0) break;
    legend.add(component_inks[rank], fmt::format("{}: {}", rank == 0 ? "largest" : fmt::format("number {}", rank + 1),
                                                 counted(milestones[rank], "milestone", "milestones")));
  }
  if (layer.small_components() > 0) {
    legend.add(component_inks.back(), fmt::format("{}: {}", counted(layer.small_components(), "other", "others"),
                                                  counted(milestones.back(), "milestone", "milestones")));
  }
  return legend.closed();
}

std::string search_legend(const StartDistances& found, const ServedWorld& world) {
  Legend legend;
  const std::string behind = unit_behind(world);
  for (std::size_t step = 0; step < found.steps.count && found.reached > 0; ++step) {
    const bool is_last = step + 1 == found.steps.count;
    const double high = is_last ? found.farthest : static_cast<double>(step + 1) * found.steps.each;
    legend.add(search_inks[step],
               fmt::format("{} to {}{} from the start", grouped_number(static_cast<double>(step) * found.steps.each),
                           grouped_number(high), behind));
  }
  if (const std::uint64_t others = found.inks.size() - found.reached; others > 0) {
    legend.add(search_inks.back(), counted(others, "milestone", "milestones") + " that it does not reach");
  }
  return legend.closed();
}

std::string clearance_legend(const ClearanceLayer& layer, const ServedWorld& world) {
  Legend legend;
  const std::string behind = unit_behind(world);
  const double needed = layer.needed();
  if (needed > 0.0) {
    legend.add(
        too_near_ink,
        fmt::format("nearer than {}{}: too near for {}", grouped_number(needed), behind, robot_text(world.robot())),
        fmt::format("{:02x}", step_opacity));
  }
  add_steps(legend, layer.steps(), needed, behind);
  return legend.closed();
}

}  // namespace warren::serve
