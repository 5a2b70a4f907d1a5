// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_file_io.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/base/error.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/json_text.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/kept/checksum.hpp"
#include "solve/kept/roadmap_sections.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/asked_words.hpp"
#include "solve/question/question.hpp"
#include "solve/question/question_of_arm.hpp"

namespace warren {
namespace {

/// But for those of a lattice.
constexpr std::string_view known_sections[] = {"meta",       "states",      "edge.first",  "edge.to",     "edge.state",
                                               "component",  "up.first",    "up.to",       "up.middle",   "up.length",
                                               "world.text", "maze.walls",  "world.walls", "world.seams", "map.place",
                                               "map.size",   "map.blocked", "map.unknown", "map.water"};
constexpr std::size_t longest_meta = std::size_t{1} << 20;

std::uint64_t hash_number(std::string_view digits) {
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  return number;
}

template <class T>
RawVector<T> copied(std::span<const T> numbers, const Execution& execution) {
  execution.reserve(numbers.size_bytes());
  return {numbers.begin(), numbers.end()};
}

RoadmapParts checked_parts(const RoadmapFile& file, const Roadmap& roadmap, const Execution& execution) {
  const RoadmapParts parts{.dimension = roadmap.arrays.dimension,
                           .directed = roadmap.arrays.directed,
                           .states = file.section<double>("states", execution),
                           .first = file.section<EdgeEnd>("edge.first", execution),
                           .to = file.section<VertexId>("edge.to", execution),
                           .edge_states = file.section<std::uint64_t>("edge.state", execution),
                           .component = file.section<VertexId>("component", execution)};
  check_parts(parts, file.name(), execution);
  return parts;
}

RoadmapArrays read_arrays(const RoadmapFile& file, const Roadmap& roadmap, const Execution& execution) {
  const RoadmapParts parts = checked_parts(file, roadmap, execution);
  return {.dimension = parts.dimension,
          .directed = parts.directed,
          .states = copied(parts.states, execution),
          .candidates = Graph(copied(parts.first, execution), copied(parts.to, execution)),
          .edge_states = copied(parts.edge_states, execution),
          .component = copied(parts.component, execution),
          .hierarchy = read_hierarchy(file, parts.vertex_count(), execution)};
}

KeptWorld given_world(const RoadmapFile& file, Scene given, const Roadmap& roadmap, const Execution& execution) {
  const std::string& hash = roadmap.world_hash;
  const std::string found = scene_hash(given, execution);
  let_prices_go(given, roadmap);
  if (found == hash) return KeptWorld(std::move(given));
  throw InputError(file.name(), fmt::format("was built for the world {}, and {} is another one", hash, given.source),
                   found);
}

/// The body can be in the world, and has such a roadmap there.
void check_world_of(const Scene& scene, const SolveOptions& options, const Question& question,
                    const std::string& name) {
  try {
    check_plannable(scene, question);
    if (choose_solver(options, scene, question).kind->open == nullptr) {
      throw InputError(name, "its planner keeps no roadmap of its body");
    }
  } catch (const UsageError& error) {
    throw InputError(name, error.what());
  }
}

/// The world inside. A lattice's walls are made when they are needed: what of it refers to the file and the lattice
/// lives as long as they do.
KeptWorld world_inside(const RoadmapFile& file, const Roadmap& roadmap, const Execution& execution) {
  if (!has_world(file)) throw InputError(file.name(), "has no world inside; name the world that it was built for");
  Scene outline = read_world_outline(file, execution);
  outline.source = roadmap.world.outline().source;
  const LatticePassages* lattice = roadmap.lattice != nullptr ? &roadmap.lattice->passages() : nullptr;
  auto make = [&file, lattice, outline, options = roadmap.options, question = roadmap.question(),
               hash = roadmap.world_hash](const Execution& on) {
    Scene scene = outline;
    scene.walls = read_world_walls(file, outline, lattice, on);
    const std::string found = scene_hash(scene, on);
    if (found != hash) throw InputError(file.name(), fmt::format("the world inside is not its own, {}", hash), found);
    check_world_of(scene, options, question, file.name());
    return scene;
  };
  if (lattice == nullptr) return KeptWorld(make(execution));
  KeptWorld::LookUp look_up;
  if (is_nothing_but_maze(outline) && file.find("maze.walls") == nullptr && file.find("world.walls") == nullptr) {
    look_up = [&file, maze = *outline.maze, hash = roadmap.world_hash](const Execution& on) {
      return cells_of_words(file.name(), maze, file.section<std::uint64_t>("passages.right", on),
                            file.section<std::uint64_t>("passages.up", on), hash, on);
    };
  }
  return {std::move(outline), std::move(make), std::move(look_up)};
}

/// The lattice is that of the maze, of prm, and of a body that plans on it.
void check_lattice_of(const Roadmap& roadmap, const std::string& name) {
  const auto& maze = roadmap.world.outline().maze;
  const LatticeSize size = roadmap.lattice->passages().size();
  const bool is_its = maze && maze->rows == size.rows && maze->cols == size.cols;
  if (is_round(roadmap.robot) && is_its && roadmap.options.planner == PlannerKind::prm) return;
  throw InputError(name, "its lattice is none of its world and body");
}

using Json = nlohmann::json;

constexpr std::string_view schema = "warren.roadmap/1";

template <class T>
void add_some(JsonObject& object, std::string_view name, const std::optional<T>& value) {
  if (value) object.add(name, *value);
}

std::string attach_json(const GrowingAttach& attach) {
  JsonObject object(", ", ": ");
  add_some(object, "radius", attach.radius);
  add_some(object, "step", attach.step);
  object.add("tries", attach.tries);
  return object.closed();
}

std::string rule_json(const ConnectionRule& rule) {
  JsonObject object(", ", ": ");
  object.add("radius", rule.radius, "neighbours", rule.neighbours);
  if (rule.attach) object.add_json("attach", attach_json(*rule.attach));
  return object.closed();
}

bool is_of_file(const RobotSpec& robot) { return robot.kind == RobotKind::arm || robot.kind == RobotKind::urdf; }

void append(std::vector<double>& numbers, const Eigen::Isometry3d& pose) {
  numbers.insert(numbers.end(), pose.matrix().data(), pose.matrix().data() + 16);
}

/// All numbers that say where an arm can be and what it meets.
std::vector<double> numbers_of(const ArmModel& model) {
  std::vector<double> numbers;
  for (const ArmVariable& v : model.variables) numbers.insert(numbers.end(), {v.low, v.high, v.continuous ? 1.0 : 0.0});
  for (const ArmJoint& joint : model.joints) {
    numbers.insert(numbers.end(),
                   {static_cast<double>(joint.parent), joint.axis.x(), joint.axis.y(), joint.axis.z(),
                    joint.slides ? 1.0 : 0.0, static_cast<double>(joint.variable), joint.multiplier, joint.offset});
    append(numbers, joint.origin);
  }
  for (const ArmLink& link : model.links) {
    numbers.push_back(static_cast<double>(link.frame));
    for (const Solid& solid : link.solids) {
      numbers.insert(numbers.end(), {static_cast<double>(solid.kind), solid.half.x(), solid.half.y(), solid.half.z()});
      append(numbers, solid.pose);
      for (const Vec3& corner : solid.corners) numbers.insert(numbers.end(), corner.data(), corner.data() + 3);
    }
  }
  for (const auto& [a, b] : model.pairs)
    numbers.insert(numbers.end(), {static_cast<double>(a), static_cast<double>(b)});
  append(numbers, model.tool);
  return numbers;
}

/// What files say is a part of the body: the hash of a table's bytes, or of what a URDF means, 16 hex digits.
std::string table_hash(const RobotSpec& robot, const Execution& execution) {
  if (robot.files) {
    RobotSpec alone = robot;  // what a world adds to it is in its words, or in that world's hash
    const ArmFiles& f = *robot.files;
    alone.files = ArmFiles{f.urdf, f.srdf, f.group, f.base, f.tip, f.packages};
    alone.files->tool = f.tool;
    const std::vector<double> numbers = numbers_of(arm_model_of(alone, 0.0, execution));
    return fmt::format("{:016x}", checksum(std::as_bytes(std::span(numbers))));
  }
  const InputFile table(robot.table, execution);
  return fmt::format("{:016x}", checksum(std::as_bytes(std::span(table.bytes()))));
}

std::uint64_t component_count(const RoadmapArrays& arrays, const Execution& execution) {
  std::uint64_t count = 0;
  for (VertexId v = 0; v < arrays.component.size(); ++v) {
    execution.poll(v);
    count += arrays.component[v] == v ? 1 : 0;
  }
  return count;
}

void add_recipe(JsonObject& object, const Roadmap& roadmap, const Execution& execution) {
  const SolveOptions& o = roadmap.options;
  object.add("robot", std::string_view(robot_text(roadmap.robot)));
  if (is_of_file(roadmap.robot)) object.add("table_hash", std::string_view(table_hash(roadmap.robot, execution)));
  object.add("clearance", roadmap.clearance);
  if (!roadmap.prices.empty()) {
    object.add_json("prices", json_list(std::span<const std::string>(price_lines(roadmap.prices)), ", "));
  }
  object.add("planner", name_of(o.planner.value_or(PlannerKind::prm)));
  if (o.sampler) object.add("sampler", name_of(*o.sampler));
  object.add("seed", o.seed);
  add_some(object, "samples", o.roadmap.samples);
  add_some(object, "neighbours", o.roadmap.neighbours);
  add_some(object, "radius", o.roadmap.radius);
  if (const auto star = star_option(o)) object.add("star", name_of(*star));
  if (o.roadmap.attach) object.add_json("attach", attach_json(*o.roadmap.attach));
  if (o.visibility.full) object.add("full", true);
  if (o.cells.doors) object.add("doors", name_of(*o.cells.doors));
  if (o.axis.objective) object.add("objective", name_of(*o.axis.objective));
  if (o.car.steering) object.add("steering", name_of(*o.car.steering));
  add_some(object, "turning_radius", o.car.turning_radius);
}

/// Reads one object of meta; every failure names the key.
class MetaReader {
 public:
  MetaReader(const std::string& where, const Json& json) : where_(where), json_(json) {}

  bool has(const char* key) const { return json_.contains(key); }
  MetaReader object(const char* key) const {
    const Json& value = at(key);
    if (!value.is_object()) fail(key, "an object");
    return {where_, value};
  }
  double number(const char* key) const {
    const auto value = taken<double>(key, &Json::is_number, "a number");
    if (!std::isfinite(value)) fail(key, "a number");
    return value;
  }
  std::uint64_t whole(const char* key) const {
    return taken<std::uint64_t>(key, &Json::is_number_unsigned, "a whole number");
  }
  std::uint32_t small(const char* key) const {
    const std::uint64_t value = whole(key);
    if (value > 1'000'000'000) fail(key, "a number of at most 10^9");
    return static_cast<std::uint32_t>(value);
  }
  bool truth(const char* key) const { return taken<bool>(key, &Json::is_boolean, "true or false"); }
  std::string text(const char* key) const { return taken<std::string>(key, &Json::is_string, "a text"); }
  template <class E>
  E named(const char* key) const {
    const auto value = enum_named<E>(text(key));
    if (!value) fail(key, "a name that this version knows");
    return *value;
  }
  [[noreturn]] void fail(const char* key, std::string_view expected) const {
    throw InputError(fmt::format("{}: key \"{}\"", where_, key), fmt::format("expected {}", expected));
  }

 private:
  const Json& at(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) fail(key, "it to be there");
    return *found;
  }
  template <class T>
  T taken(const char* key, bool (Json::*is_such)() const noexcept, std::string_view expected) const {
    const Json& value = at(key);
    if (!(value.*is_such)()) fail(key, expected);
    return value.get<T>();
  }
  const std::string& where_;
  const Json& json_;
};

GrowingAttach read_attach(const MetaReader& meta) {
  GrowingAttach attach;
  if (meta.has("radius")) attach.radius = meta.number("radius");
  if (meta.has("step")) attach.step = meta.number("step");
  attach.tries = meta.small("tries");
  return attach;
}

void read_options(const MetaReader& meta, SolveOptions& o) {
  o.planner = meta.named<PlannerKind>("planner");
  if (!keeps_roadmap(*o.planner)) meta.fail("planner", "one that makes roadmaps");
  if (meta.has("sampler")) o.sampler = meta.named<SamplerKind>("sampler");
  o.seed = meta.whole("seed");
  if (meta.has("samples")) o.roadmap.samples = meta.whole("samples");
  if (meta.has("neighbours")) o.roadmap.neighbours = meta.small("neighbours");
  if (meta.has("radius")) o.roadmap.radius = meta.number("radius");
  if (meta.has("star")) {
    const std::string star = meta.text("star");
    if (star != "radius" && star != "neighbours") meta.fail("star", "radius or neighbours");
    o.roadmap.star = star == "radius" ? StarRule::radius : StarRule::neighbours;
  }
  if (meta.has("attach")) o.roadmap.attach = read_attach(meta.object("attach"));
  if (meta.has("full")) o.visibility.full = meta.truth("full");
  if (meta.has("doors")) o.cells.doors = meta.named<DoorKind>("doors");
  if (meta.has("objective")) o.axis.objective = meta.named<AxisObjective>("objective");
  if (meta.has("steering")) o.car.steering = meta.named<SteeringKind>("steering");
  if (meta.has("turning_radius")) o.car.turning_radius = meta.number("turning_radius");
}

/// Of nearness and areas, of which a roadmap's body and world have a meaning.
Prices read_prices(const std::string& where, const Json& lines, const Execution& execution) {
  const std::string key = fmt::format("{}: key \"prices\"", where);
  if (!lines.is_array()) throw InputError(key, "expected a list of lines");
  Prices prices;
  for (const Json& line : lines) {
    if (!line.is_string()) throw InputError(key, "expected a list of lines");
    const std::string& text = line.get_ref<const std::string&>();
    if (!text.starts_with("clearance-price ") && !text.starts_with("area "))
      throw InputError(key, "expected prices of nearness and areas alone");
    read_price_line(text, key, prices, execution);
  }
  return prices;
}

ConnectionRule read_rule(const MetaReader& meta) {
  ConnectionRule rule{meta.number("radius"), meta.small("neighbours")};
  if (!(rule.radius >= 0.0)) meta.fail("radius", "a number of at least 0");
  if (meta.has("attach")) rule.attach = read_attach(meta.object("attach"));
  if (rule.attach && rule.attach->tries == 0) meta.fail("attach", "at least one try");
  return rule;
}

/// Of what shapes a roadmap beside its world: body, options and seed. That is a part of meta.
std::uint64_t recipe_hash(const Roadmap& roadmap, const Execution& execution) {
  JsonObject object(",\n ", ": ");
  add_recipe(object, roadmap, execution);
  const std::string recipe = object.closed();
  return checksum(std::as_bytes(std::span(recipe)));
}

/// What a roadmap is, as one JSON object with its keys in their documented order. Numbers read back as the same
/// doubles.
std::string meta_json(const Roadmap& roadmap, const Execution& execution) {
  const EdgeCounts edges = count_edges(roadmap, execution);
  JsonObject counts(", ", ": ");
  counts.add("unchecked", edges.unchecked, "free", edges.free, "blocked", edges.blocked);
  JsonObject object(",\n ", ": ");
  object.add("schema", schema, "source", roadmap.world.outline().source, "world_hash", roadmap.world_hash);
  add_recipe(object, roadmap, execution);
  if (roadmap.index == IndexChoice::none) object.add("asked_index", name_of(roadmap.index));
  object.add_json("rule", rule_json(roadmap.rule));
  object.add("drawn", roadmap.samples, "dimension", roadmap.arrays.dimension);
  object.add("directed", roadmap.arrays.directed, "states", count_states(roadmap));
  object.add_json("edges", counts.closed());
  object.add("index", roadmap.lattice != nullptr         ? std::string_view("route")
                      : roadmap.arrays.hierarchy.empty() ? std::string_view("none")
                                                         : std::string_view("contraction"));
  if (roadmap.lattice != nullptr) {
    const LatticeSize size = roadmap.lattice->passages().size();
    object.add_json("lattice", json_list(std::span<const std::uint32_t>(std::array{size.rows, size.cols})));
  } else {
    object.add("components", component_count(roadmap.arrays, execution));
  }
  return object.closed() + "\n";
}

/// The lattice that meta names; 0 x 0 where it names none.
LatticeSize lattice_of(const std::string& where, const Json& json) {
  const auto found = json.find("lattice");
  if (found == json.end()) return {};
  const auto is_side = [](const Json& n) { return n.is_number_unsigned() && n.get<std::uint64_t>() <= 0xffffffff; };
  if (!found->is_array() || found->size() != 2 || !std::all_of(found->begin(), found->end(), is_side)) {
    throw InputError(where + ": key \"lattice\"", "expected rows and columns");
  }
  return {(*found)[0].get<std::uint32_t>(), (*found)[1].get<std::uint32_t>()};
}

/// All that `meta` says of a roadmap, and its lattice: no scene, and of arrays their sizes. Throws InputError that
/// names the section.
Roadmap described(const RoadmapFile& file, const Execution& execution) {
  std::vector<std::string_view> known(std::begin(known_sections), std::end(known_sections));
  for (const RouteSection& kind : route_section_kinds()) known.push_back(kind.name);
  file.refuse_unknown(known);
  const std::string where = fmt::format("{}: section meta", file.name());
  const Json json = Json::parse(roadmap_meta(file, execution), nullptr, false);
  if (!json.is_object()) throw InputError(where, "expected one JSON object");
  const MetaReader meta(where, json);
  Roadmap roadmap;
  if (meta.text("schema") != schema) meta.fail("schema", schema);
  Scene named;
  named.source = meta.text("source");
  roadmap.world = KeptWorld(std::move(named));
  roadmap.world_hash = meta.text("world_hash");
  roadmap.robot = robot_value(fmt::format("{}: key \"robot\"", where), meta.text("robot"));
  if (roadmap.robot.files) roadmap.robot.files->said.clear();  // what MoveIt says, the robot may lack
  if (is_of_file(roadmap.robot) && table_hash(roadmap.robot, execution) != meta.text("table_hash")) {
    throw InputError(where, fmt::format("was made for another arm than {} has now; build it anew",
                                        roadmap.robot.files ? roadmap.robot.files->urdf : roadmap.robot.table));
  }
  roadmap.clearance = meta.number("clearance");
  if (!(roadmap.clearance >= 0.0 && roadmap.clearance <= largest_coordinate)) {
    meta.fail("clearance", "a number from 0 to 1e60");
  }
  if (meta.has("prices")) roadmap.prices = read_prices(where, json["prices"], execution);
  read_options(meta, roadmap.options);
  try {
    roadmap.options.validate();
    check_prices(roadmap.prices);
  } catch (const UsageError& error) {
    throw InputError(where, error.what());
  }
  if (meta.has("asked_index")) roadmap.index = meta.named<IndexChoice>("asked_index");
  roadmap.rule = read_rule(meta.object("rule"));
  roadmap.samples = meta.whole("drawn");
  roadmap.arrays.dimension = meta.small("dimension");
  roadmap.arrays.directed = json.value("directed", Json(false)) == Json(true);
  if (hash_number(roadmap.world_hash) != file.header().world_hash) {
    throw InputError(file.name(), "header and meta name different worlds");
  }
  if (has_lattice(file)) roadmap.lattice = read_lattice(file, lattice_of(where, json), execution);
  return roadmap;
}

}  // namespace

std::string roadmap_meta(const RoadmapFile& file, const Execution& execution) {
  const SectionPlace* place = file.find("meta");
  if (place != nullptr && place->elements > longest_meta) {
    throw InputError(fmt::format("{}: section meta", file.name()), "expected at most 1 MiB");
  }
  const auto bytes = file.section<std::byte>("meta", execution);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write_roadmap(const Roadmap& roadmap, const std::string& path, const Execution& execution, bool with_world) {
  OutputFile file(path, execution);  // first: a place that can't be written is known before the work
  write_roadmap(roadmap, file, execution, with_world);
  file.commit();
}

void write_roadmap(const Roadmap& roadmap, OutputFile& file, const Execution& execution, bool with_world) {
  if (roadmap.file != nullptr) roadmap.file->check_all(execution);  // nothing is copied that nobody looked at
  const std::string meta = meta_json(roadmap, execution);
  const RoadmapParts parts = roadmap.arrays.parts();
  const LatticePassages* lattice = roadmap.lattice != nullptr ? &roadmap.lattice->passages() : nullptr;
  HeldNumbers held;
  std::vector<RoadmapSection> sections{roadmap_section("meta", meta)};
  if (with_world) append_world_sections(roadmap.world.whole(execution), lattice, held, sections, execution);
  if (roadmap.lattice != nullptr) {
    append_lattice_sections(*roadmap.lattice, sections);
  } else {
    sections.insert(sections.end(),
                    {roadmap_section("states", parts.states), roadmap_section("edge.first", parts.first),
                     roadmap_section("edge.to", parts.to), roadmap_section("edge.state", parts.edge_states),
                     roadmap_section("component", parts.component)});
  }
  append_hierarchy_sections(roadmap.arrays.hierarchy, held, sections, execution);
  static_assert(sizeof("warren " WARREN_VERSION) - 1 <= sizeof(FixedHeader::writer));
  const RoadmapFileHeader header{.world_hash = hash_number(roadmap.world_hash),
                                 .recipe_hash = recipe_hash(roadmap, execution),
                                 .writer = "warren " WARREN_VERSION};
  write_roadmap_file(file, header, sections, execution);
}

void check_roadmap(const RoadmapFile& file, const Execution& execution) {
  const Roadmap roadmap = described(file, execution);
  if (roadmap.lattice != nullptr) {
    check_lattice(file, *roadmap.lattice, execution);
  } else {
    read_hierarchy(file, checked_parts(file, roadmap, execution).vertex_count(), execution);
  }
}

Roadmap read_roadmap(std::unique_ptr<RoadmapFile> opened, const Execution& execution, std::optional<Scene> world) {
  const RoadmapFile& file = *opened;
  Roadmap roadmap = described(file, execution);
  roadmap.world =
      world ? given_world(file, std::move(*world), roadmap, execution) : world_inside(file, roadmap, execution);
  if (file.header().recipe_hash != recipe_hash(roadmap, execution)) {
    throw InputError(file.name(), "header and meta name different bodies or options");
  }
  if (roadmap.robot.files) {  // once for all questions
    roadmap.robot = with_what_is_said(std::move(roadmap.robot), roadmap.world.outline());
    roadmap.robot.files->read = arm_model_of(roadmap.robot, roadmap.clearance, execution);
  }
  if (roadmap.lattice == nullptr) {
    check_world_of(roadmap.world.outline(), roadmap.options, roadmap.question(), file.name());
    roadmap.arrays = read_arrays(file, roadmap, execution);
  } else {
    check_lattice_of(roadmap, file.name());
    roadmap.file = std::move(opened);
  }
  return roadmap;
}

}  // namespace warren
