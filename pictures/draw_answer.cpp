// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/draw_answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/layers/draw_arm.hpp"
#include "pictures/layers/draw_bodies.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "solve/question/question_of_arm.hpp"
#include "solve/question/solve_options.hpp"
#include "worlds/poses/steering_curve.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

/// What planners call their lines, and how these are drawn.
struct LineStyle {
  std::string_view name;
  std::string_view label;
  Rgb color;
  double width;
};
constexpr std::array<LineStyle, 5> line_styles{
    {{"cells", "door between cells", colors::layer, widths::edge},
     {"medial_axis", "medial axis", colors::layer, widths::search_tree},
     {"visibility", "visibility edge", colors::layer, widths::edge},
     {"wrong_edges", "edge through an obstacle", colors::wrong, widths::search_tree},
     {"blocked", "obstacle of the reference point", colors::outline, widths::edge}}};

PictureLayer layer_of(NamedLines lines) {
  PictureLayer layer{.id = lines.name, .label = lines.name, .lines = std::move(lines.lines), .closed = lines.closed};
  for (const LineStyle& style : line_styles) {
    if (style.name != lines.name) continue;
    layer.label = style.label;
    layer.color = style.color;
    layer.width = style.width;
  }
  return layer;
}

void take_lengths(Picture& picture) {
  const std::vector<double> straight(picture.body.poses.size(), 0.0);
  picture.body.lengths = leg_lengths(picture.body.poses, picture.path_turns.empty() ? straight : picture.path_turns);
}

void add_bodies(Picture& picture, const RobotSpec& robot, const StateList& states) {
  const bool drives = robot.kind == RobotKind::car;
  picture.body = {.outline = robot.outline, .radius = robot.radius, .heads = drives};
  if (robot.kind == RobotKind::point) return;
  picture.path_label = "path of the reference point";
  std::vector<Se2> poses;
  if (states.width == 3 && !states.empty()) {
    poses = poses_of(states);
    picture.body.poses = poses;
  } else {
    for (const Vec2 p : picture.path) poses.push_back({p.x, p.y, 0.0});
  }
  if (drives) picture.path_turns = leg_turns(poses);
  for (PictureLayer& layer : bodies_along(poses, robot)) picture.layers.push_back(std::move(layer));
  take_lengths(picture);
}

void add_roadmap(Picture& picture, const Answer& answer, ByProducts& made, const Execution& execution) {
  const RobotSpec& robot = answer.problem.robot;
  PlannedRoadmap<Vec2> roadmap;
  if (robot.kind == RobotKind::car) {
    CarCurves curves = car_curves(made.pose_roadmaps, robot, execution);
    picture.layers.push_back(std::move(curves.edges));
    picture.layers.push_back(std::move(curves.trees));
    roadmap.graph = Graph(RawVector<EdgeEnd>(curves.milestones.size() + 1, 0), {});
    roadmap.states = std::move(curves.milestones);
  } else {
    roadmap = !made.pose_roadmaps.empty() ? in_the_plane(made.pose_roadmaps, execution)
              : !made.trees.empty()       ? in_the_plane(made.trees, execution)
                                          : std::move(made.roadmap);
  }
  const auto planner = enum_named<PlannerKind>(answer.planner);
  const bool is_shown = (planner && is_roadmap_planner(*planner)) || !roadmap.states.empty();
  if (is_shown) picture.roadmap = std::move(roadmap);
}

/// Paths that were the best before, the older the fainter.
PictureLayer improvements_layer(const Answer& answer, PolygonSet paths) {
  PictureLayer layer{
      .id = "improvements",
      .label = fmt::format("{}, the first {} long", counted(paths.size(), "path before it", "paths before it"),
                           human_number(answer.improvements.front().length)),
      .part = Part::search,
      .color = colors::path,
      .width = widths::outline,
      .over_roadmap = true};
  layer.lines = std::move(paths);
  constexpr double faintest = 0.15;
  constexpr double strongest = 0.6;
  for (std::size_t i = 0; i < layer.lines.size(); ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(layer.lines.size());
    layer.opacities.push_back(std::lerp(faintest, strongest, share));
  }
  return layer;
}

/// No path through a place outside of it is as short as the answer's: an ellipse around start and goal, as far as it
/// lies in the box. Empty where the path is straight.
PictureLayer informed_set(const Answer& answer, Vec2 start, Vec2 goal, const Box& box) {
  constexpr int corners = 360;
  PictureLayer layer{.id = "informed_set",
                     .label = fmt::format("no path shorter than {} leaves it", human_number(answer.length)),
                     .part = Part::search,
                     .color = colors::outline,
                     .width = widths::outline,
                     .over_roadmap = true};
  const double apart = distance(start, goal);
  if (!(answer.length > apart) || apart == 0.0) return layer;
  const Vec2 along = 0.5 * answer.length / apart * (goal - start);
  const double half_width = 0.5 * std::sqrt((answer.length - apart) * (answer.length + apart));
  const Vec2 across = half_width / apart * Vec2{start.y - goal.y, goal.x - start.x};
  const Vec2 middle = 0.5 * (start + goal);
  std::vector<Vec2> chain;
  const auto end_chain = [&] {
    if (chain.size() > 1) layer.lines.add(chain);
    chain.clear();
  };
  std::vector<Vec2> circle = circle_outline({0, 0}, 1.0, corners);
  circle.push_back(circle.front());
  for (const Vec2 c : circle) {
    const Vec2 p = middle + c.x * along + c.y * across;
    box.contains(p) ? chain.push_back(p) : end_chain();
  }
  end_chain();
  return layer;
}

/// What is seen of a planner that gets better: where it looked, and the paths that it had before.
void add_improvements(Picture& picture, const Scene& scene, const Answer& answer, ByProducts& made,
                      const Execution& execution) {
  if (!answer.verified || answer.improvements.empty()) return;
  const RobotKind body = answer.problem.robot.kind;
  const bool is_informed = answer.planner != name_of(PlannerKind::rrt_star);
  if (is_informed && (body == RobotKind::point || body == RobotKind::disc) && picture.start && picture.goal) {
    Box box = obstacle_box(scene, execution);
    if (scene.bounds) box.include(*scene.bounds);
    for (const Vec2 p : picture.path) box.include(p);
    PictureLayer ellipse = informed_set(answer, *picture.start, *picture.goal, box);
    if (!ellipse.lines.empty()) picture.layers.push_back(std::move(ellipse));
  }
  // The last of them is the answer's own, unless it was made shorter in the end.
  const bool has_own = std::abs(answer.improvements.back().length - answer.length) <= 1e-9 * answer.length;
  PolygonSet before;
  for (std::size_t i = 0; i + (has_own ? 1 : 0) < made.improved.size(); ++i) before.add(made.improved[i]);
  if (before.empty()) return;
  picture.layers.push_back(improvements_layer(answer, std::move(before)));
  picture.path_label += fmt::format(", {} long", human_number(answer.length));
}

/// Obstacles that are cells, and what prices say of the ground.
std::vector<PictureLayer> ground_of(const Scene& scene, const RobotSpec& robot, const Prices& prices,
                                    const Execution& execution) {
  std::vector<PictureLayer> layers = scene.map ? cells_of_map(*scene.map, execution) : std::vector<PictureLayer>{};
  const double radius = robot.outline.empty() ? robot.radius : 0.0;
  for (PictureLayer& layer : price_layers(prices, scene.map, radius, execution)) layers.push_back(std::move(layer));
  return layers;
}

/// The other goals, the places on the way, and the other ways.
void add_choices(Picture& picture, const GoalRule& rule, const std::vector<std::vector<double>>& via,
                 std::span<const AlternativePath> others) {
  PictureLayer places{.id = "places",
                      .label = !via.empty()         ? "way-points"
                               : rule.visit.empty() ? "other goals"
                                                    : "places to visit",
                      .swatch = MarkShape::disc,
                      .part = Part::path,
                      .color = colors::goal,
                      .width = 5.0 * widths::path,
                      .over_roadmap = true};
  for (const auto* states : {&rule.others, &rule.visit, &via}) {
    for (const std::vector<double>& state : *states) {
      if (const auto p = plane_point(state)) places.lines.add(std::array{*p, *p});
    }
  }
  if (!places.lines.empty()) picture.layers.push_back(std::move(places));
  if (others.empty()) return;
  PictureLayer ways{.id = "alternatives",
                    .label = counted(others.size(), "other way", "other ways"),
                    .part = Part::path,
                    .color = mixed(colors::path, colors::paper, 45),
                    .width = 0.7 * widths::path,
                    .over_roadmap = true};
  for (const AlternativePath& other : others) ways.lines.add(other.path);
  picture.layers.push_back(std::move(ways));
}

Picture drawing_of_arm(const Scene& scene, const ArmModel& model, const std::vector<double>& start,
                       Path<JointState> path, std::string subtitle, const Execution& execution) {
  if (path.empty()) path.push_back(joint_state(start));
  Picture picture = arm_views(scene, model, path, execution);
  picture.title = title_of(scene);
  picture.subtitle = std::move(subtitle);
  return picture;
}

std::string body_text(const RobotSpec& robot, std::string_view metres) {
  switch (robot.kind) {
    case RobotKind::point:
      return "a point";
    case RobotKind::polygon:
      return fmt::format("a body of {} corners", robot.outline.size());
    case RobotKind::car:
      if (robot.steering == SteeringKind::differential) return "a differential drive";
      return fmt::format("a car, turning radius {}{}", human_number(robot.turning_radius), metres);
    case RobotKind::disc:
      return fmt::format("a disc of radius {}{}", human_number(robot.radius), metres);
    case RobotKind::urdf: {
      const ArmFiles& files = robot.files.value();
      const std::string name = files.urdf.substr(files.urdf.find_last_of('/') + 1);
      return files.group.empty() ? name : fmt::format("{}, group {}", name, files.group);
    }
    default:
      return fmt::format("{}, links of radius {}", name_of(robot.kind), human_number(robot.radius));
  }
}

std::string outcome_text(const Answer& answer, std::string_view metres) {
  if (answer.refuted) return fmt::format("refuted, length {}{}", human_number(answer.refuted->length), metres);
  if (!answer.verified) return std::string(name_of(answer.outcome));
  const std::string cost =
      answer.price && answer.cost ? fmt::format("cost {}{}, ", human_number(*answer.cost), metres) : "";
  return fmt::format("{}length {}{}{}, clearance {}{}", cost, human_number(answer.length), metres,
                     answer.optimal ? " (the shortest)" : "", human_number(answer.min_clearance), metres);
}

constexpr Rgb unchecked_color{176, 184, 196};
constexpr Rgb blocked_color{246, 130, 130};
constexpr double thin = 0.5 * widths::edge;  // what can't be driven stands back
constexpr std::size_t most_arrows = 2000;

struct EdgeStyle {
  EdgeState state;
  const char* id;
  const char* label;
  Rgb color;
};
/// Free edges are drawn last, over the others.
constexpr std::array<EdgeStyle, 3> edge_styles{{{EdgeState::unchecked, "unchecked", "unchecked edge", unchecked_color},
                                                {EdgeState::blocked, "blocked", "blocked edge", blocked_color},
                                                {EdgeState::free, "free", "free edge", colors::components[0]}}};

Graph edges_in(EdgeState state, const RoadmapArrays& arrays, const Execution& execution) {
  const Graph& all = arrays.candidates;
  execution.reserve((all.vertex_count() + 1) * sizeof(EdgeEnd) + all.targets().size() * sizeof(VertexId));
  RawVector<EdgeEnd> offsets;
  RawVector<VertexId> targets;
  for (VertexId v = 0; v < all.vertex_count(); ++v) {
    execution.poll(v);
    offsets.push_back(static_cast<EdgeEnd>(targets.size()));
    std::size_t end = all.first_end(v);
    for (const VertexId w : all.neighbours(v)) {
      if (edge_state(arrays.edge_states, end++) == state) targets.push_back(w);
    }
  }
  offsets.push_back(static_cast<EdgeEnd>(targets.size()));
  return {std::move(offsets), std::move(targets)};
}

class RoadmapDrawing {
 public:
  RoadmapDrawing(const Scene& scene, const Roadmap& roadmap, const RoadmapArrays& arrays, const Execution& execution)
      : scene_(scene), roadmap_(roadmap), arrays_(arrays), execution_(execution) {}

  Picture draw(std::optional<double> heading_rad) const {
    if (heading_rad) check_has_headings(roadmap_.robot);
    if (is_arm(roadmap_.robot)) return draw_arm();
    Picture picture{.scene = scene_, .start = plane_point(scene_.start), .goal = plane_point(scene_.goal)};
    if (scene_.map) picture.layers = cells_of_map(*scene_.map, execution_);
    if (heading_rad) {
      add_heading(picture, scene_, roadmap_.robot, roadmap_.clearance, poses(), *heading_rad, execution_);
    }
    const bool drives = roadmap_.robot.kind == RobotKind::car;
    drives ? add_curves(picture) : add_lines(picture);
    picture.roadmap.emplace();
    picture.roadmap->states = positions();
    picture.roadmap->graph =
        drives ? Graph(RawVector<EdgeEnd>(vertex_count() + 1, 0), {}) : edges_in(EdgeState::free, arrays_, execution_);
    if (!heading_rad && arrays_.dimension == 3 && vertex_count() <= most_arrows) picture.layers.push_back(arrows());
    return picture;
  }

 private:
  std::size_t vertex_count() const { return arrays_.candidates.vertex_count(); }
  Vec2 position(VertexId v) const {
    const std::size_t first = std::size_t{v} * arrays_.dimension;
    return {arrays_.states[first], arrays_.states[first + 1]};
  }
  RawVector<Vec2> positions() const {
    RawVector<Vec2> all;
    all.reserve(vertex_count());
    for (VertexId v = 0; v < vertex_count(); ++v) all.push_back(position(v));
    return all;
  }
  RawVector<Se2> poses() const {
    RawVector<Se2> all;
    for (VertexId v = 0; v < vertex_count(); ++v) {
      all.push_back({position(v).x, position(v).y, arrays_.states[std::size_t{v} * 3 + 2]});
    }
    return all;
  }
  void add_lines(Picture& picture) const {
    for (const EdgeStyle& style : edge_styles) {
      if (style.state == EdgeState::free) continue;  // they are the roadmap
      PictureLayer layer{.id = style.id, .label = style.label, .color = style.color, .width = thin};
      const Graph graph = edges_in(style.state, arrays_, execution_);
      for (VertexId v = 0; v < vertex_count(); ++v) {
        execution_.poll(v);
        for (const VertexId w : graph.neighbours(v)) {
          if (v < w || arrays_.directed) layer.lines.add(std::array{position(v), position(w)});
        }
      }
      if (layer.lines.size() > 0) picture.layers.push_back(std::move(layer));
    }
  }

  void add_curves(Picture& picture) const {
    std::array<PlannedRoadmap<Se2>, 1> roadmap;
    roadmap[0].states = poses();
    for (const EdgeStyle& style : edge_styles) {
      roadmap[0].graph = edges_in(style.state, arrays_, execution_);
      PictureLayer layer = car_curves(roadmap, roadmap_.robot, execution_).edges;
      layer.id = style.id;
      layer.label = style.label;
      layer.color = style.color;
      if (style.state != EdgeState::free) layer.width = thin;
      if (layer.lines.size() > 0) picture.layers.push_back(std::move(layer));
    }
  }

  /// Where the states look, in strokes that keep apart from each other.
  PictureLayer arrows() const {
    const Box box = box_around(positions());
    const double extent = std::max(box.width(), box.height());
    const double length = std::min(extent / 50.0, 0.4 * extent / std::sqrt(static_cast<double>(vertex_count())));
    return heading_arrows(poses(), length);
  }
  Picture draw_arm() const {
    std::vector<JointState> states;
    const std::size_t n = arrays_.dimension;
    for (std::size_t v = 0; v < vertex_count(); ++v) {
      states.push_back(joint_state(std::span<const double>(arrays_.states).subspan(v * n, n)));
    }
    std::vector<ToolLines> lines;
    for (const EdgeStyle& style : edge_styles) {
      lines.push_back({style.id, style.label, style.color, style.state == EdgeState::free ? widths::edge : thin, {}});
      edges_in(style.state, arrays_, execution_).for_each_edge([&](VertexId v, VertexId w) {
        lines.back().edges.push_back({v, w});
      });
    }
    Picture picture =
        arm_roadmap_views(scene_, arm_model_of(roadmap_.robot, 0.0, execution_),
                          scene_.start.empty() ? JointState{} : joint_state(scene_.start), states, lines, execution_);
    picture.arm.reset();  // it stands
    return picture;
  }

  const Scene& scene_;
  const Roadmap& roadmap_;
  const RoadmapArrays& arrays_;
  const Execution& execution_;
};

Picture drawing_of_roadmap(const Scene& scene, const Roadmap& roadmap, const EdgeCounts& edges,
                           std::optional<double> heading_rad, const Execution& execution) {
  const bool by_index = roadmap.lattice != nullptr;  // its blocked edges are its walls
  const std::uint64_t drawn = edges.free + (by_index ? 0 : edges.unchecked + edges.blocked);
  if (drawn > most_drawn_edges) {
    throw UsageError(
        fmt::format("this roadmap has {} edges, and a picture of more than {} shows nothing; export it to "
                    ".graphml or .csv and draw a part, or draw its world",
                    grouped(drawn), grouped(most_drawn_edges)));
  }
  if (!by_index) return RoadmapDrawing(scene, roadmap, roadmap.arrays, execution).draw(heading_rad);
  const RoadmapArrays arrays = arrays_of(roadmap.lattice->passages(), execution);
  return RoadmapDrawing(scene, roadmap, arrays, execution).draw(heading_rad);
}

}  // namespace

void add_heading(Picture& picture, const Scene& scene, const RobotSpec& robot, double clearance,
                 std::span<const Se2> states, double heading_rad, const Execution& execution) {
  const HeadingCells cells = heading_cells(scene, robot, clearance, heading_rad, execution);
  picture.layers.insert(picture.layers.begin(), blocked_at_heading(cells, execution));
  if (states.empty()) picture.layers.push_back(arrows_among(cells, execution));
  for (PictureLayer& layer : state_arrows(states, heading_rad)) picture.layers.push_back(std::move(layer));
}

void add_heading_of_world(Picture& picture, const Scene& scene, double heading_rad, const Execution& execution) {
  const Question none;
  add_heading(picture, scene, robot_of(scene, none), clearance_of(scene, none), {}, heading_rad, execution);
}

Picture drawing_of(const Scene& scene, const Answer& answer, ByProducts made, const Execution& execution,
                   std::optional<double> heading_rad) {
  if (heading_rad) check_has_headings(answer.problem.robot);
  const Problem& problem = answer.problem;
  const StateList& states = answer.refuted ? answer.refuted->states : answer.states;
  if (is_arm(problem.robot)) {
    Path<JointState> path;
    for (std::size_t i = 0; i < states.size(); ++i) path.push_back(joint_state(states[i]));
    return drawing_of_arm(scene, arm_model_of(problem.robot, 0.0, execution), problem.start, std::move(path),
                          subtitle_of(scene, answer), execution);
  }
  Picture picture{.scene = scene,
                  .layers = ground_of(scene, problem.robot, problem.prices, execution),
                  .path = answer.refuted ? answer.refuted->path : answer.path,
                  .start = plane_point(problem.start),
                  .goal = plane_point(problem.goal),
                  .title = title_of(scene),
                  .subtitle = subtitle_of(scene, answer)};
  for (const HeadingCells& heading : made.headings) {
    PictureLayer cells = blocked_at_heading(heading, execution);
    PicturePage& page = picture.pages.emplace_back(PicturePage{cells.id, picture.layers});
    page.layers.insert(page.layers.begin(), std::move(cells));
    page.layers.push_back(arrows_among(heading, execution));
  }
  if (heading_rad) {
    std::vector<Se2> milestones;
    for (const PlannedRoadmap<Se2>& some : made.pose_roadmaps) {
      milestones.insert(milestones.end(), some.states.begin(), some.states.end());
    }
    add_heading(picture, scene, problem.robot, problem.clearance, milestones, *heading_rad, execution);
  }
  for (NamedLines& lines : made.lines) picture.layers.push_back(layer_of(std::move(lines)));
  add_roadmap(picture, answer, made, execution);
  add_bodies(picture, problem.robot, states);
  if (answer.verified && !made.arcs.points.empty()) {
    picture.path.assign(made.arcs.points.begin(), made.arcs.points.end());
    picture.path_turns = std::move(made.arcs.turns);
  }
  add_improvements(picture, scene, answer, made, execution);
  add_choices(picture, problem.rule, problem.via, answer.alternatives);
  return picture;
}

Picture drawing_of(const Scene& scene, const RecordedAnswer& answer, const Execution& execution,
                   std::optional<double> heading_rad) {
  const RobotSpec robot = robot_of(scene, answer.problem);
  if (heading_rad) check_has_headings(robot);
  const std::vector<double>& start = answer.problem.start.empty() ? scene.start : answer.problem.start;
  if (is_arm(robot)) {
    const ArmModel model = arm_model_of(robot, 0.0, execution);
    if (answer.state_count() > 0) check_joints(answer, model.variables);
    Path<JointState> path;
    for (const std::vector<double>& state : states_of(answer)) path.push_back(joint_state(state));
    return drawing_of_arm(scene, model, start, std::move(path), subtitle_of(scene, answer), execution);
  }
  Picture picture{.scene = scene,
                  .layers = ground_of(scene, robot, answer.problem.prices, execution),
                  .path = answer.path,
                  .start = plane_point(start),
                  .goal = plane_point(answer.problem.goal.empty() ? scene.goal : answer.problem.goal),
                  .title = title_of(scene),
                  .subtitle = subtitle_of(scene, answer)};
  if (heading_rad) add_heading(picture, scene, robot, clearance_of(scene, answer.problem), {}, *heading_rad, execution);
  if (answer.state_width() == state_size(robot)) add_bodies(picture, robot, answer.states);
  add_choices(picture, answer.problem.rule, answer.via, {});
  return picture;
}

void animate(Picture& picture) {
  constexpr double point_share = 1.0 / 120.0;
  picture.moves = true;
  if (picture.arm) return;
  MovingBody& body = picture.body;
  if (body.poses.empty()) {
    for (const Vec2 p : picture.path) body.poses.push_back({p.x, p.y, 0.0});
    take_lengths(picture);
  }
  if (body.outline.empty() && body.radius == 0.0) {
    const Box box = box_around(picture.path);
    body.radius = point_share * std::max(box.width(), box.height());
  }
}

std::vector<std::string> write_picture(const std::string& file, const Scene& scene, const Answer& answer,
                                       ByProducts made, const PictureOptions& options, const Execution& execution) {
  std::optional<Scene> copy;
  const Scene& shown = with_map_walls(scene, copy, execution);
  return write_picture(file, drawing_of(shown, answer, std::move(made), execution, options.heading), options,
                       execution);
}

std::string title_of(const Scene& scene) { return scene.source.substr(scene.source.rfind('/') + 1); }

std::string subtitle_of(const Scene& scene, const RobotSpec& robot) {
  return description_of(scene) + "; " + body_text(robot, metres_behind(unit_of(scene)));
}

std::string subtitle_of(const Scene& scene, const Answer& answer) {
  std::vector<std::string> words{answer.planner, answer.sampler, answer.search};
  std::erase(words, "");
  if (answer.roadmap.samples > 0) words.push_back(counted(answer.roadmap.samples, "sample", "samples"));
  if (answer.roadmap.milestones > 0) words.push_back(counted(answer.roadmap.milestones, "milestone", "milestones"));
  words.push_back(outcome_text(answer, metres_behind(unit_of(scene))));
  if (!answer.sampler.empty()) words.push_back(fmt::format("seed {}", answer.seed));
  return fmt::format("{}\n{}", subtitle_of(scene, answer.problem.robot), fmt::join(words, ", "));
}

std::string subtitle_of(const Scene& scene, const RecordedAnswer& answer) {
  const std::string world = subtitle_of(scene, robot_of(scene, answer.problem));
  return answer.length
             ? fmt::format("{}\nlength {}{}", world, human_number(*answer.length), metres_behind(unit_of(scene)))
             : world;
}

void draw_roadmap(const Roadmap& roadmap, const std::string& description, std::optional<double> heading_rad,
                  const Execution& execution, const std::function<void(const Picture&)>& draw) {
  const Scene& world = roadmap.world.whole(execution);
  std::optional<Scene> copy;
  const Scene& scene = with_map_walls(world, copy, execution);
  const EdgeCounts edges = count_edges(roadmap, execution);
  Picture picture = drawing_of_roadmap(scene, roadmap, edges, heading_rad, execution);
  picture.title = title_of(world);
  picture.subtitle = fmt::format("{}\nroadmap of {}, edges: {} free, {} blocked, {} unchecked",
                                 subtitle_of(world, roadmap.robot), counted(count_states(roadmap), "state", "states"),
                                 grouped(edges.free), grouped(edges.blocked), grouped(edges.unchecked));
  picture.description = fmt::format("{}\n{}", picture.subtitle, description);
  draw(picture);
}

}  // namespace warren
