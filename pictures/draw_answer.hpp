// SPDX-License-Identifier: BSD-3-Clause
// What a picture shows of an answer: the path, the body along it, and what the planner made on its way; and of a
// roadmap that is kept. The only place that knows by-products and pictures; `solve`, `render` and `compare` draw by it,
// and so can any program.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "pictures/model/picture.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/kept/roadmap.hpp"

namespace warren {

/// A world with an answer on it, and what its planner made, without description. A refuted path is drawn as any other.
/// Throws Stopped; what it throws for a table of an arm, solving has thrown before. heading_rad: as
/// PictureOptions::heading.
Picture drawing_of(const Scene& scene, const Answer& answer, ByProducts made, const Execution& execution,
                   std::optional<double> heading_rad = {});

/// The same of an answer that was read from a file: path and body. Throws InputError as check_joints() does.
Picture drawing_of(const Scene& scene, const RecordedAnswer& answer, const Execution& execution,
                   std::optional<double> heading_rad = {});

/// What PictureOptions::heading asks for: the cells without room for the body at that heading, and the states as
/// arrows; without states some arrows where it has room. Throws UsageError for bodies that have no such layer; Stopped.
void add_heading(Picture& picture, const Scene& scene, const RobotSpec& robot, double clearance,
                 std::span<const Se2> states, double heading_rad, const Execution& execution);
/// The same of the world's own body.
void add_heading_of_world(Picture& picture, const Scene& scene, double heading_rad, const Execution& execution);

/// Lets the body move along the path, in pictures that can (SVG, HTML); a point is shown as a small disc, an arm in its
/// three projections.
void animate(Picture& picture);

/// The picture of an answer in one go, in the format that the file's ending says, with the borders of a map's cells.
/// Returns as write_picture() of formats/ does. Throws WriteError, Stopped.
std::vector<std::string> write_picture(const std::string& file, const Scene& scene, const Answer& answer,
                                       ByProducts made = {}, const PictureOptions& options = {},
                                       const Execution& execution = {});

// What a picture shows of a roadmap: its vertices, and its edges by what is known of them. Free ones take the colours
// of their components, unchecked ones are thin and grey, blocked ones thin and red. Cars' edges are the curves that
// they drive; few states of bodies that turn have arrows. Of an arm: the places of its tool in the three views, and
// straight lines between them.

/// More edges are no picture but a grey.
inline constexpr std::uint64_t most_drawn_edges = 900'000;

/// Calls `draw` with the picture of world and roadmap, which lives as long as that call; start and goal are those of
/// the world. `description` is added to what the picture says of itself; heading_rad: as PictureOptions::heading.
/// Throws UsageError for more edges than most_drawn_edges; Stopped; what `draw` throws; what it throws for a table of
/// an arm, reading the roadmap has thrown before.
void draw_roadmap(const Roadmap& roadmap, const std::string& description, std::optional<double> heading_rad,
                  const Execution& execution, const std::function<void(const Picture&)>& draw);

// What stands under a picture's title: the world, the body, how it was solved and what came of it. A line each.

/// The world's name, without its folder.
std::string title_of(const Scene& scene);

/// Of an answer as it is.
std::string subtitle_of(const Scene& scene, const Answer& answer);
/// Of an answer that was read from a file.
std::string subtitle_of(const Scene& scene, const RecordedAnswer& answer);

/// The world and the body in it.
std::string subtitle_of(const Scene& scene, const RobotSpec& robot);

}  // namespace warren
