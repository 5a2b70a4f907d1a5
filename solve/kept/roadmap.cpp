// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/sort.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/question/question_of_arm.hpp"

namespace warren {
namespace {

/// What says how a roadmap is searched or how its planner works while it searches means nothing to one that is kept.
void refuse_what_is_asked_later(const SolveOptions& options) {
  for (const Option option : given(options).members()) {
    if (question_options.has(option)) {
      throw UsageError(fmt::format("@{}: is for a question; say it when the roadmap is asked", name_of(option)));
    }
    if (option == Option::via) throw UsageError("@via: a roadmap that is kept is asked way by way; solve takes it");
    if (work_options.has(option)) {
      throw UsageError(fmt::format("@{}: a roadmap that is kept is made in one way; leave it out", name_of(option)));
    }
  }
}

/// Any start and goal: what is built does not depend on them.
Question without_ends(const Scene& scene, Question question, const Execution& execution) {
  RobotSpec robot = robot_of(scene, question);
  std::size_t width = state_size(robot);
  if (robot.files) {
    robot.files->read = arm_model_of(robot, 0.0, execution);
    width = robot.files->read->variables.size();
    if (width <= 3) throw UsageError("@robot: a roadmap is kept of arms with four joints or more");
    question.robot = std::move(robot);
  }
  question.start.assign(width, 0.0);
  question.goal.assign(width, 0.0);
  return question;
}

EdgeCounts edges_of(const LatticePassages& passages, const Execution& execution) {
  const auto bits_in = [&](std::span<const std::uint64_t> words) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
      execution.poll(i);
      bits += static_cast<std::uint64_t>(std::popcount(words[i]));
    }
    return bits;
  };
  const auto [rows, cols] = passages.size();
  const std::uint64_t free = bits_in(passages.right_words()) + bits_in(passages.up_words());
  const std::uint64_t all = std::uint64_t{rows} * (cols - 1) + std::uint64_t{cols} * (rows - 1);
  return {0, free, all - free};
}

/// All numbers that a state can have, zeros for those that it lacks.
using StateKey = std::array<double, most_joints>;

std::vector<StateKey> sorted_states(const RoadmapParts& parts, const Execution& execution) {
  execution.reserve(parts.vertex_count() * sizeof(StateKey));
  std::vector<StateKey> states(parts.vertex_count(), StateKey{});
  for (VertexId v = 0; v < states.size(); ++v) {
    execution.poll(v);
    std::ranges::copy(parts.state(v), states[v].begin());
  }
  polled_sort(states.begin(), states.end(), execution);
  return states;
}

void compare_states(const RoadmapParts& before, const RoadmapParts& now, const Execution& execution,
                    UpdateAccount& account) {
  const std::vector<StateKey> old_states = sorted_states(before, execution);
  const std::vector<StateKey> new_states = sorted_states(now, execution);
  std::size_t i = 0;
  std::size_t k = 0;
  std::uint64_t both = 0;
  for (std::size_t steps = 0; i < old_states.size() && k < new_states.size(); ++steps) {
    execution.poll(steps);
    if (old_states[i] == new_states[k]) {
      ++both, ++i, ++k;
    } else {
      ++(old_states[i] < new_states[k] ? i : k);
    }
  }
  account.states_added = new_states.size() - both;
  account.states_dropped = old_states.size() - both;
}

/// Two lattices share the smaller one's rows and columns; another roadmap shares nothing with a lattice.
void compare_lattices(const Roadmap& before, const Roadmap& now, UpdateAccount& account) {
  std::uint64_t both = 0;
  if (before.world.outline().maze && now.world.outline().maze) {
    const MazeHint& a = *before.world.outline().maze;
    const MazeHint& b = *now.world.outline().maze;
    both = std::uint64_t{std::min(a.rows, b.rows)} * std::min(a.cols, b.cols);
  }
  account.states_added = count_states(now) - both;
  account.states_dropped = count_states(before) - both;
}

/// More differences than so many are no change but another world.
constexpr std::size_t most_changed_places = 4096;

/// False where the maps' cells are not the same places, or too many differ.
bool add_changed_cells(const OccupancyMap& a, const OccupancyMap& b, std::vector<Box>& places,
                       const Execution& execution) {
  const bool same_place = a.width() == b.width() && a.height() == b.height() && a.cell == b.cell &&
                          a.origin == b.origin && a.yaw_rad == b.yaw_rad;
  if (!same_place || !a.water.empty() || !b.water.empty()) return false;
  for (std::uint32_t y = 0; y < a.height(); ++y) {
    execution.check();
    if (std::ranges::equal(a.blocked.row(y), b.blocked.row(y))) continue;
    for (std::uint32_t x = 0; x < a.width(); ++x) {
      if (a.blocked.test(x, y) == b.blocked.test(x, y)) continue;
      places.push_back(world_box(a, {{1.0 * x, 1.0 * y}, {x + 1.0, y + 1.0}}));
      if (places.size() > most_changed_places) return false;
    }
  }
  return true;
}

using Ends = std::array<Vec2, 2>;

std::vector<Ends> walls_of(const Scene& scene, const Execution& execution) {
  execution.reserve(scene.walls.size() * sizeof(Ends));
  std::vector<Ends> walls;
  walls.reserve(scene.walls.size());
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    execution.poll(i);
    const Segment wall = scene.walls.segment(i);
    walls.push_back({wall.a, wall.b});
  }
  return walls;
}

std::vector<std::vector<Vec2>> outlines_of(const Scene& scene) {
  std::vector<std::vector<Vec2>> outlines;
  for (const ScenePolygon& polygon : scene.polygons) outlines.push_back(polygon.corners);
  return outlines;
}

/// The boxes of the shapes, lists of corners, that only one of the two has. False: these are too many.
template <class Shape>
bool add_changed_shapes(std::vector<Shape> before, std::vector<Shape> now, std::vector<Box>& places,
                        const Execution& execution) {
  const auto less = [](const Shape& a, const Shape& b) {
    return std::ranges::lexicographical_compare(a, b, [](Vec2 p, Vec2 q) { return is_before(p, q); });
  };
  for (std::vector<Shape>* shapes : {&before, &now}) polled_sort(shapes->begin(), shapes->end(), execution, less);
  auto a = before.begin();
  auto b = now.begin();
  for (std::size_t steps = 0; a != before.end() || b != now.end(); ++steps) {
    execution.poll(steps);
    const bool is_old = a != before.end() && (b == now.end() || less(*a, *b));
    const bool is_new = !is_old && (a == before.end() || less(*b, *a));
    if (is_old || is_new) places.push_back(box_around(is_old ? *a : *b));
    if (places.size() > most_changed_places) return false;
    if (!is_new) ++a;
    if (!is_old) ++b;
  }
  return true;
}

/// Where two worlds differ: the boxes of the obstacles that only one of them has. What keeps clear of all these boxes
/// meets the same obstacles in both. Nothing where the worlds differ in more than obstacles of the plane: in bounds,
/// maze, map, solids or, of maps, in size and place; or in too many obstacles. O(n log n) for n obstacles.
std::optional<std::vector<Box>> changed_places(const Scene& before, const Scene& now, const Execution& execution) {
  const bool is_framed_alike = before.bounds == now.bounds && before.maze == now.maze && !has_solids(before) &&
                               !has_solids(now) && before.seams.size() == now.seams.size() &&
                               before.map.has_value() == now.map.has_value();
  if (!is_framed_alike) return std::nullopt;
  if (!before.bounds && obstacle_box(before, execution) != obstacle_box(now, execution)) return std::nullopt;
  std::vector<Box> places;
  if (before.map && !add_changed_cells(*before.map, *now.map, places, execution)) return std::nullopt;
  if (!add_changed_shapes(walls_of(before, execution), walls_of(now, execution), places, execution))
    return std::nullopt;
  if (!add_changed_shapes(outlines_of(before), outlines_of(now), places, execution)) return std::nullopt;
  return places;
}

std::string_view why_nothing_is_kept(PlannerKind planner) {
  if (keeps_roadmap(planner)) return "a body that doesn't turn meets other obstacles at each start's heading";
  return planner == PlannerKind::grid ? "it searches the world's cells themselves" : "its trees grow from a start";
}

ChosenSolver builder_of(const SolveOptions& options, const Scene& scene, const Question& question) {
  const ChosenSolver solver = choose_solver(options, scene, question);
  if (!question.route.keep_to.empty()) throw UsageError("@keep_to: is of one question; a roadmap is for many");
  if (solver.kind->build == nullptr || !keeps_roadmap(solver.planner)) {
    throw UsageError(fmt::format("@planner: {} makes no roadmap that is kept: {}; prm and lazy-prm do",
                                 name_of(solver.planner), why_nothing_is_kept(solver.planner)));
  }
  if (scene.map && !scene.map->water.empty()) {
    throw UsageError(
        fmt::format("{}: on a map with water the free cells follow from the start, so there is no roadmap "
                    "for all questions",
                    scene.source));
  }
  return solver;
}

}  // namespace

bool grows(const SolveOptions& options, const Scene& scene, const RobotSpec& robot) {
  if (options.roadmap.samples || options.sampler == SamplerKind::lattice) return false;
  return options.sampler || !scene.maze || !is_round(robot);
}

EdgeCounts count_edges(const Roadmap& roadmap, const Execution& execution) {
  if (roadmap.lattice != nullptr) return edges_of(roadmap.lattice->passages(), execution);
  const RoadmapArrays& arrays = roadmap.arrays;
  EdgeCounts counts;
  const std::size_t ends = arrays.candidates.targets().size();
  for (std::size_t end = 0; end < ends; ++end) {
    execution.poll(end);
    const EdgeState state = edge_state(arrays.edge_states, end);
    ++(state == EdgeState::free ? counts.free : state == EdgeState::blocked ? counts.blocked : counts.unchecked);
  }
  if (arrays.directed) return counts;
  return {counts.unchecked / 2, counts.free / 2, counts.blocked / 2};
}

void check_buildable(const Scene& scene, const Question& question, const SolveOptions& options,
                     const Execution& execution) {
  question.validate();
  options.validate();
  refuse_what_is_asked_later(options);
  check_solver_options(options);
  constexpr AskedWords kept_words{AskedWord::clearance_price, AskedWord::area};
  for (const AskedWord word : words_in(prices_of(scene, question)).members()) {
    if (kept_words.has(word)) continue;
    throw UsageError(
        fmt::format("{}: kept roadmaps hold prices of nearness and of areas that are polygons, and no others; solve "
                    "takes them",
                    place_of_word(word, scene, question)));
  }
  if (const AskedWords words = words_in(question.rule); !words.empty()) {
    throw UsageError(
        fmt::format("@{}: kept roadmaps are asked for one goal; solve takes it", name_of(words.members().front())));
  }
  check_headings(scene, question);
  builder_of(options, scene, without_ends(scene, question, execution));
}

Roadmap build_within(Scene scene, const Question& question, const SolveOptions& options, const Execution& execution,
                     IndexChoice index, BuildAccount* account, const OldRoadmap* old) {
  Roadmap roadmap;
  roadmap.index = index;
  roadmap.options = options;
  roadmap.options.planner = options.planner.value_or(PlannerKind::prm);
  check_buildable(scene, question, roadmap.options, execution);
  roadmap.prices = prices_of(scene, question);
  scene.prices = {};
  roadmap.world = KeptWorld(std::move(scene));
  const Scene& world = roadmap.world.outline();  // all of it
  Question asked = without_ends(world, question, execution);
  asked.prices = roadmap.prices;
  const ChosenSolver solver = builder_of(roadmap.options, world, asked);
  roadmap.robot = robot_of(world, asked);
  roadmap.clearance = clearance_of(world, asked);
  roadmap.world_hash = scene_hash(world, execution);
  const bool indexed = index == IndexChoice::where_it_pays && roadmap.prices.empty();  // of lengths alone
  if (indexed) roadmap.lattice = lattice_index(world, asked, roadmap.options, execution);
  if (roadmap.lattice != nullptr) {
    roadmap.samples = roadmap.lattice->passages().cell_count();
    roadmap.rule = {1.0, 0};
    return roadmap;
  }
  const std::optional<Scene> copy = planned_copy(world, asked, solver.planner, execution);
  SolveRequest request{roadmap.options, copy ? *copy : world, asked, solver.planner, execution, nullptr, {}, old};
  request.index = indexed;
  BuiltArrays built = solver.kind->build(request);
  roadmap.samples = built.samples;
  roadmap.rule = built.rule;
  roadmap.arrays = std::move(built.arrays);
  roadmap.arrays.component = free_components(roadmap.arrays.parts(), execution);
  if (account != nullptr) *account = built.account;
  return roadmap;
}

void let_prices_go(Scene& world, const Roadmap& roadmap) {
  Prices all = roadmap.prices;
  add_prices(all, world.prices);
  if (roadmap.prices.clearance) all.clearance = roadmap.prices.clearance;
  if (price_lines(all) != price_lines(roadmap.prices)) {
    throw UsageError(fmt::format(
        "{}: has prices or forbidden areas that the roadmap was built without; build one of this world", world.source));
  }
  world.prices = {};
}

Roadmap update(const Roadmap& roadmap, Scene now, const Execution& execution, UpdateAccount* account) {
  std::optional<OldRoadmap> old;
  const bool drawn = is_roadmap_planner(*roadmap.options.planner);
  if (drawn && !grows(roadmap.options, roadmap.world.outline(), roadmap.robot) && roadmap.lattice == nullptr &&
      !is_arm(roadmap.robot)) {
    if (auto places = changed_places(roadmap.world.whole(execution), now, execution)) {
      old = {&roadmap.arrays, std::move(*places)};
    }
  }
  BuildAccount built;
  let_prices_go(now, roadmap);
  Question question = roadmap.question();
  question.robot = without_what_is_said(roadmap.robot, roadmap.world.outline());  // the changed world says its own
  if (question.robot->files) {
    ArmFiles& files = *question.robot->files;
    if (!now.arm || now.arm->group.empty()) files.group = roadmap.robot.files->group;
    if (!now.arm || now.arm->tool.empty()) files.tool = roadmap.robot.files->tool;
  }
  Roadmap next =
      build_within(std::move(now), question, roadmap.options, execution, roadmap.index, &built, old ? &*old : nullptr);
  if (account == nullptr) return next;
  const EdgeCounts edges = count_edges(next, execution);
  account->built_anew = !old || next.lattice != nullptr;
  account->edges = edges.free + edges.blocked + edges.unchecked;
  account->edges_checked = built.counters.edges_checked;
  if (next.lattice != nullptr || !drawn) account->edges_checked = account->edges;  // all of them were made anew
  const bool any_lattice = roadmap.lattice != nullptr || next.lattice != nullptr;
  any_lattice ? compare_lattices(roadmap, next, *account)
              : compare_states(roadmap.arrays.parts(), next.arrays.parts(), execution, *account);
  return next;
}

Roadmap build(Scene scene, const Question& question, const SolveOptions& options, const Limits& limits,
              IndexChoice index) {
  const LimitedExecution limited(limits);
  return build_within(std::move(scene), question, options, limited.execution(), index);
}

void let_walls_go(Roadmap& roadmap, const Execution& execution) {
  if (roadmap.lattice == nullptr || !is_nothing_but_maze(roadmap.world.outline())) return;
  const LatticePassages& lattice = roadmap.lattice->passages();
  const Scene outline = without_arrays(roadmap.world.outline());
  auto make = [&lattice, outline](const Execution& on) {
    Scene scene = outline;
    scene.walls = walls_of_lattice(lattice, on);
    return scene;
  };
  auto look_up = [&lattice, maze = *outline.maze, hash = roadmap.world_hash](const Execution& on) {
    return cells_of_words("the lattice", maze, lattice.right_words(), lattice.up_words(), hash, on);
  };
  KeptWorld bits(outline, std::move(make), std::move(look_up));
  try {
    bits.looked_up(execution);
    roadmap.world = std::move(bits);
  } catch (const InputError&) {  // the walls are others, or in another order
  }
}

}  // namespace warren
