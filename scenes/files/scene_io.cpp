// SPDX-License-Identifier: BSD-3-Clause
// Scene text, in and out: one item a line, as docs/file_formats.md defines it; plain lists of walls are scenes. Reading
// is one pass in place, about 150 ns a wall; writing formats chunks in parallel. What is read back from what was
// written is the same bit for bit.
//
// The reader: a table of items, each with its usage line and the member that reads it. Contradictions between items are
// looked for at the end, when all lines are known.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

using scene_text::Fields, scene_text::Place;

class SceneReader {
 public:
  SceneReader(const InputFile& file, const Execution& execution)
      : file_(file), execution_(execution), walls_(execution) {}

  Scene read() {
    refuse_other_encodings();
    TextLines lines(file_, execution_);
    while (lines.next()) read_line(lines.fields(), lines.line());
    last_line_ = lines.number();
    scene_.walls = walls_.take();
    scene_.source = file_.name();
    check_whole();
    if (scene_.arm && first_line("moveit-names") > 0) scene_.arm->said.clear();
    return std::move(scene_);
  }

 private:
  struct Item {
    std::string_view name;
    std::string_view usage;
    bool once;
    void (SceneReader::*read)(Fields&);
  };
  static constexpr std::size_t item_count = 27;
  static constexpr std::size_t most_named = 1024;  // joints
  static const std::array<Item, item_count> items;

  static const Item* item_named(std::string_view name) {
    return std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  }
  /// Of an item of `items`; 0: there is no such line.
  std::size_t first_line(std::string_view item) const {
    return first_lines_[static_cast<std::size_t>(item_named(item) - items.begin())];
  }

  void refuse_other_encodings() const {
    const std::string_view all = file_.bytes();
    if (all.starts_with("\xff\xfe") || all.starts_with("\xfe\xff")) {
      Place{file_.name(), 1}.fail("expected UTF-8 text, not UTF-16", all.substr(0, 2));
    }
    if (all.empty()) Place{file_.name(), 1}.fail("the file is empty; expected walls, polygons or spheres");
  }

  void read_line(Fields fields, std::string_view line) {
    if (fields.done()) return;
    if (fields.number_follows()) {
      item_ = &items[0];
      return read_wall(fields);
    }
    const std::string_view name = fields.word();
    item_ = item_named(name);
    if (item_ == items.end()) refuse_word(fields.place(), name, line);
    std::size_t& first = first_lines_[static_cast<std::size_t>(item_ - items.begin())];
    const bool one_of_several = name == "goal" && !scene_.goal_pose;
    if (item_->once && first != 0 && !one_of_several) {
      fields.place().fail(fmt::format("a second `{}` line; the first is line {}", name, first), line);
    }
    first = fields.place().line;
    (this->*item_->read)(fields);
    check_done(fields);
  }

  [[noreturn]] static void refuse_word(const Place& place, std::string_view name, std::string_view line) {
    const auto is_control = [](unsigned char c) { return c < 0x20 && !scene_text::is_blank(static_cast<char>(c)); };
    if (std::any_of(name.begin(), name.end(), is_control)) place.fail("this is not a text file", line);
    std::array<std::string_view, item_count> names;
    std::transform(items.begin(), items.end(), names.begin(), [](const Item& item) { return item.name; });
    const std::string_view nearest = scene_text::nearest_word(name, names);
    if (!nearest.empty()) place.fail(fmt::format("unknown item; did you mean `{}`?", nearest), name);
    place.fail(fmt::format("unknown item; expected four numbers or one of {}", fmt::join(names, ", ")), name);
  }

  /// The numbers that are left in the line; their count is checked against the item's usage.
  const std::vector<double>& numbers(Fields& fields, std::size_t least, std::size_t most) {
    numbers_.clear();
    scene_text::read_numbers(fields, numbers_, execution_);
    if (numbers_.size() < least || numbers_.size() > most) refuse_count(fields.place(), numbers_.size());
    return numbers_;
  }
  [[noreturn]] void refuse_count(const Place& place, std::size_t count) const {
    place.fail(fmt::format("expected `{}`", item_->usage), scene_text::numbers_text(count));
  }
  [[noreturn]] void refuse(const Place& place, std::string_view what, double value) const {
    place.fail(fmt::format("`{}`: {}", item_->name, what), fmt::format("{}", value));
  }

  void read_wall(Fields& fields) {
    const std::vector<double>& n = numbers(fields, 4, 4);
    walls_.add(n[0], n[1], n[2], n[3]);
  }
  std::vector<Vec2> corners(Fields& fields) {
    const std::vector<double>& n = numbers(fields, 6, std::numeric_limits<std::size_t>::max());
    if (n.size() % 2 != 0) refuse_count(fields.place(), n.size());
    return scene_text::points_of(n, execution_);
  }
  void read_polygon(Fields& fields) { push_asked(scene_.polygons, {corners(fields), fields.place().line}, execution_); }
  void read_sphere(Fields& fields) {
    const std::vector<double>& n = numbers(fields, 4, 4);
    if (n[3] < 0.0) refuse(fields.place(), "the radius must be at least 0", n[3]);
    push_asked(scene_.spheres, {n[0], n[1], n[2], n[3]}, execution_);
  }
  /// Any two opposite corners.
  void read_box(Fields& fields) {
    const std::vector<double>& n = numbers(fields, 6, 6);
    SolidBox box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(n[axis], n[axis + 3]);
      box.high[axis] = std::max(n[axis], n[axis + 3]);
    }
    push_asked(scene_.boxes, box, execution_);
  }
  void read_solid(Fields& fields) {
    push_asked(scene_.solids, warren::read_solid(*solid_word_named(item_->name), fields, execution_), execution_);
  }
  /// What is left of the line has no word more; refuses it as too short.
  std::string word_of(Fields& fields) {
    if (fields.done()) fields.place().fail(fmt::format("expected `{}`", item_->usage), "too few words");
    return std::string(fields.word());
  }
  void check_done(Fields& fields) {
    if (!fields.done()) fields.place().fail(fmt::format("expected `{}`", item_->usage), fields.word());
  }
  ArmFiles& arm() { return scene_.arm ? *scene_.arm : scene_.arm.emplace(); }
  void read_attach(Fields& fields) {
    AttachedSolid attached{.link = word_of(fields), .solid = {}};
    std::string word = word_of(fields);
    const auto begins_solid = [&] { return solid_word_named(word) != nullptr && fields.number_follows(); };
    for (; !begins_solid(); word = word_of(fields)) attached.may_touch.push_back(word);
    attached.solid = warren::read_solid(*solid_word_named(word), fields, execution_, true);
    if (!fields.done() && word_of(fields) == "as") attached.solid.name = word_of(fields);
    note_link(arm(), attached.link, fields.place());
    for (const std::string& link : attached.may_touch) note_link(arm(), link, fields.place());
    push_asked(arm().attached, std::move(attached), execution_);
  }
  void read_hold(Fields& fields) {
    if (arm().held.size() == most_named) fields.place().fail(fmt::format("at most {} joints are held", most_named));
    warren::read_hold(fields, arm());
  }
  void read_allow(Fields& fields) { warren::read_allow(fields, arm()); }
  void read_tool(Fields& fields) { arm().tool = word_of(fields); }
  void read_base_pose(Fields& fields) { warren::read_base_pose(fields, arm()); }
  void read_group(Fields& fields) { arm().group = word_of(fields); }
  void read_bounds(Fields& fields) {
    const std::vector<double>& n = numbers(fields, 4, 4);
    if (!(n[0] < n[2])) refuse(fields.place(), fmt::format("XMIN must be less than XMAX = {}", n[2]), n[0]);
    if (!(n[1] < n[3])) refuse(fields.place(), fmt::format("YMIN must be less than YMAX = {}", n[3]), n[1]);
    scene_.bounds = Box{{n[0], n[1]}, {n[2], n[3]}};
  }
  void read_clearance(Fields& fields) {
    scene_.clearance = numbers(fields, 1, 1)[0];
    if (!(*scene_.clearance >= 0.0)) refuse(fields.place(), "R must be at least 0", *scene_.clearance);
  }
  void read_maze(Fields& fields) {
    const std::vector<double>& n = numbers(fields, 2, 2);
    scene_.maze = MazeHint{count(fields.place(), "ROWS", n[0]), count(fields.place(), "COLS", n[1])};
    if (std::uint64_t{scene_.maze->rows} * scene_.maze->cols > std::numeric_limits<std::uint32_t>::max()) {
      fields.place().fail("`maze`: ROWS x COLS must be below 2^32", fmt::format("{}x{}", n[0], n[1]));
    }
  }
  void read_start(Fields& fields) {
    if (fields.done() || fields.number_follows()) {
      scene_.start = state(fields);
    } else {
      scene_.named_start = named_state(fields, word_of(fields));
    }
  }
  /// Several goals are all by names, or all of the plane.
  void read_goal(Fields& fields) {
    const bool has_word = !fields.done() && !fields.number_follows();
    const std::string word = has_word ? word_of(fields) : std::string();
    if ((!scene_.named_goals.empty() && word != "joints") || (!scene_.goal.empty() && has_word)) {
      fields.place().fail("goals are several where all are `goal joints NAME VALUE ...` or all `goal X Y [THETA]`");
    }
    if (!has_word) goal_lines_.push_back(fields.place().line);
    if (!has_word && !scene_.goal.empty()) {
      push_asked(scene_.other_goals, state(fields), execution_);
      check_other_goal(fields.place());
    } else if (!has_word) {
      scene_.goal = state(fields);
    } else if (word == "pose") {
      scene_.goal_pose = pose(fields);
    } else {
      push_asked(scene_.named_goals, named_state(fields, word), execution_);
    }
  }
  /// 2, 3 or 6 numbers; of an arm of files as many as it has joints, which is known at the end.
  std::vector<double> state(Fields& fields) { return numbers(fields, 1, most_joints); }
  void check_other_goal(const Place& place) const {
    for (const std::size_t count : {scene_.goal.size(), scene_.other_goals.back().size()}) {
      if (count == 2 || count == 3) continue;
      place.fail("several goals are places of the plane, `goal X Y [THETA]` each", scene_text::numbers_text(count));
    }
  }
  NamedState named_state(Fields& fields, std::string_view word) {
    if (word != "joints" || fields.done()) fields.place().fail(fmt::format("expected `{}`", item_->usage), word);
    NamedState state;
    while (!fields.done()) {
      std::string joint = word_of(fields);
      if (std::ranges::count(state.names, joint) > 0) fields.place().fail("this joint stands here twice", joint);
      if (state.names.size() == most_named) fields.place().fail(fmt::format("at most {} joints", most_named), joint);
      state.names.push_back(std::move(joint));
      state.values.push_back(fields.number());
    }
    return state;
  }
  Eigen::Isometry3d pose(Fields& fields) {
    const std::vector<double>& n = numbers(fields, 7, 7);
    if (std::all_of(n.begin() + 3, n.end(), [](double x) { return x == 0.0; })) {
      fields.place().fail("`goal pose`: the quaternion QX QY QZ QW must not be 0 0 0 0");
    }
    return pose_of_numbers(n);
  }
  void read_grid(Fields& fields) {
    const std::vector<double>& n = numbers(fields, 2, 2);
    if (!(n[0] > 0.0)) refuse(fields.place(), "CELL must be greater than 0", n[0]);
    scene_.grid = GridSpec{n[0], count(fields.place(), "ANGLES", n[1])};
  }

  std::uint32_t count(const Place& place, std::string_view name, double value) const {
    if (!(value >= 1.0 && value <= std::numeric_limits<std::uint32_t>::max()) || value != std::floor(value)) {
      refuse(place, fmt::format("{} must be a whole number, at least 1 and below 2^32", name), value);
    }
    return static_cast<std::uint32_t>(value);
  }

  void read_prices(Fields& fields) {
    const auto word = std::ranges::find(price_line_words, item_->name, &PriceWord::name);
    read_price(*word, fields, scene_.prices, execution_);
    if (item_->name == "mask") {
      std::string& file = scene_.prices.masks.back().file;
      file = path_beside(file_.name(), file);
    }
  }
  void read_robot(Fields& fields) { scene_.robot = warren::read_robot(fields, execution_); }
  void check_whole() const {
    const bool has_lines = std::any_of(first_lines_.begin(), first_lines_.end(), [](std::size_t n) { return n > 0; });
    if (scene_.walls.size() == 0 && !has_lines) {
      Place{file_.name(), last_line_}.fail("the file ends without any wall, polygon, sphere, box or bounds");
    }
    check_state(scene_.start, "start", first_line("start"));
    check_state(scene_.goal, "goal", goal_lines_.empty() ? 0 : goal_lines_.front());
    for (std::size_t i = 0; i < scene_.other_goals.size(); ++i) {
      check_state(scene_.other_goals[i], "goal", goal_lines_[i + 1]);
    }
    check_arm_lines();
    if (scene_.maze) check_maze();
  }
  void check_state(const std::vector<double>& given, std::string_view item, std::size_t line) const {
    if (given.empty() || (scene_.robot && scene_.robot->kind == RobotKind::urdf)) return;
    if (const std::size_t count = given.size(); count == 1 || count == 4 || count == 5) {
      Place{file_.name(), line}.fail(fmt::format("expected `{}`", item_named(item)->usage),
                                     scene_text::numbers_text(count));
    }
    if (!scene_.robot) return;
    const std::size_t wanted = state_size(*scene_.robot);
    const bool any_heading = item == "goal" && wanted == 3 && given.size() == 2;
    const bool place_of_tool = item == "goal" && wanted == 6 && given.size() == 3;
    if (given.size() == wanted || any_heading || place_of_tool) return;
    Place{file_.name(), line}.fail(
        fmt::format("`{}` must be {} numbers for the robot of line {}", item, wanted, first_line("robot")),
        scene_text::numbers_text(given.size()));
  }
  /// Without a robot's line the question names an arm, or says what is wrong.
  void check_arm_lines() const {
    const bool has_plane_robot = !scene_.robot || scene_.robot->kind == RobotKind::point ||
                                 scene_.robot->kind == RobotKind::disc || state_size(*scene_.robot) == 3;
    if (!scene_.other_goals.empty() && !has_plane_robot) {
      place_of("goal").fail("an arm's goals are several where all are `goal joints NAME VALUE ...`");
    }
    if (scene_.robot && scene_.robot->kind == RobotKind::urdf) return check_robot_line(*scene_.robot->files);
    if (!scene_.robot) return;
    for (const std::string_view item : {"attach", "hold", "allow", "tool", "group", "base-pose"}) {
      if (first_line(item) > 0) place_of(item).fail(fmt::format("`{}` takes a `robot urdf`", item));
    }
    const bool has_names = scene_.named_start.has_value();
    if (has_names || !scene_.named_goals.empty() || scene_.goal_pose) {
      place_of(has_names ? "start" : "goal").fail("names of joints and poses of the tool take a `robot urdf`");
    }
  }
  /// A line of its own says nothing else than the robot's line says.
  void check_robot_line(const ArmFiles& own) const {
    if (!scene_.arm) return;
    const auto refuse = [&](std::string_view item) {
      place_of(item).fail(
          fmt::format("`{}` says another thing than the robot's line {}; leave one out", item, first_line("robot")));
    };
    const ArmFiles& said = *scene_.arm;
    if (!own.tool.empty() && !said.tool.empty() && own.tool != said.tool) refuse("tool");
    if (own.base_pose && said.base_pose && own.base_pose != said.base_pose) refuse("base-pose");
    const bool has_ends = !own.base.empty() || !own.tip.empty();
    if (!said.group.empty() && (has_ends || (!own.group.empty() && own.group != said.group))) refuse("group");
    for (const auto& held : own.held) {
      const auto differs = [&](const auto& line) { return line.first == held.first && line.second != held.second; };
      if (std::ranges::any_of(said.held, differs)) refuse("hold");
    }
  }
  void check_maze() const {
    const auto off = first_wall_off_grid(scene_.walls, *scene_.maze, execution_);
    if (!off) return;
    std::size_t walls = 0;
    TextLines lines(file_, execution_);
    while (lines.next()) {
      Fields fields = lines.fields();
      if (!fields.number_follows() && fields.word() != "wall") continue;
      if (walls++ < *off) continue;
      fields.place().fail(fmt::format("this wall is not on the unit grid of the {}x{} maze of line {}",
                                      scene_.maze->rows, scene_.maze->cols, first_line("maze")),
                          lines.line());
    }
  }
  Place place_of(std::string_view item) const { return {file_.name(), first_line(item)}; }

  const InputFile& file_;
  const Execution& execution_;
  Scene scene_;
  WallCollector walls_;
  std::vector<double> numbers_;
  std::array<std::size_t, item_count> first_lines_{};  ///< 0: no such line
  std::vector<std::size_t> goal_lines_;                ///< of goals that are numbers
  std::size_t last_line_ = 1;
  const Item* item_ = nullptr;  ///< of the line that is being read
};

const std::array<SceneReader::Item, SceneReader::item_count> SceneReader::items = {{
    {"wall", "wall X1 Y1 X2 Y2", false, &SceneReader::read_wall},
    {"polygon", "polygon X Y X Y X Y ...", false, &SceneReader::read_polygon},
    {"sphere", "sphere X Y Z R", false, &SceneReader::read_sphere},
    {"box", "box X1 Y1 Z1 X2 Y2 Z2", false, &SceneReader::read_box},
    {"obox", solid_words[2].usage, false, &SceneReader::read_solid},
    {"cylinder", solid_words[3].usage, false, &SceneReader::read_solid},
    {"capsule", solid_words[4].usage, false, &SceneReader::read_solid},
    {"hull", solid_words[5].usage, false, &SceneReader::read_solid},
    {"bounds", "bounds XMIN YMIN XMAX YMAX", true, &SceneReader::read_bounds},
    {"clearance", "clearance R", true, &SceneReader::read_clearance},
    {"maze", "maze ROWS COLS", true, &SceneReader::read_maze},
    {"robot", robot_usage, true, &SceneReader::read_robot},
    {"start", "start X Y [THETA] or six joint angles", true, &SceneReader::read_start},
    {"goal", "goal X Y [THETA] or six joint angles", true, &SceneReader::read_goal},
    {"grid", "grid CELL ANGLES", true, &SceneReader::read_grid},
    {"attach", "attach LINK [MAY_TOUCH ...] sphere|box|obox|cylinder|capsule|hull NUMBERS [as NAME]", false,
     &SceneReader::read_attach},
    {"hold", "hold JOINT VALUE", false, &SceneReader::read_hold},
    {"allow", "allow LINK LINK", false, &SceneReader::read_allow},
    {"tool", "tool LINK", true, &SceneReader::read_tool},
    {price_line_words[0].name, price_line_words[0].usage, price_line_words[0].once, &SceneReader::read_prices},
    {price_line_words[1].name, price_line_words[1].usage, price_line_words[1].once, &SceneReader::read_prices},
    {price_line_words[2].name, price_line_words[2].usage, price_line_words[2].once, &SceneReader::read_prices},
    {price_line_words[3].name, price_line_words[3].usage, price_line_words[3].once, &SceneReader::read_prices},
    {price_line_words[4].name, price_line_words[4].usage, price_line_words[4].once, &SceneReader::read_prices},
    {"moveit-names", "moveit-names", true, &SceneReader::check_done},
    {"group", "group NAME", true, &SceneReader::read_group},
    {"base-pose", "base-pose X Y Z QX QY QZ QW", true, &SceneReader::read_base_pose},
}};

constexpr std::size_t line_grain = 8192;

void append_number(std::string& text, double x) {
  constexpr double largest_quick = 1e9;
  const double doubled = 2.0 * x;
  if (std::abs(x) < largest_quick && doubled == static_cast<double>(static_cast<std::int64_t>(doubled)) &&
      doubled > 0.0) {
    const auto halves = static_cast<std::int64_t>(doubled);
    const fmt::format_int digits(halves / 2);
    text.append(digits.data(), digits.size());
    if (halves % 2 != 0) text.append(".5");
    return;
  }
  fmt::format_to(std::back_inserter(text), "{}", x + 0.0);  // no negative zeros
}

/// A blank and a number.
void append_next(std::string& text, double x) {
  text.push_back(' ');
  append_number(text, x);
}

/// An item and its numbers, one line; nothing without numbers.
void append_item(std::string& text, std::string_view item, std::span<const double> numbers) {
  if (numbers.empty()) return;
  text.append(item);
  for (const double x : numbers) append_next(text, x);
  text.push_back('\n');
}
template <class... Numbers>
void append_line(std::string& text, std::string_view item, Numbers... numbers) {
  append_item(text, item, std::array{static_cast<double>(numbers)...});
}

void append_polygon(std::string& text, const std::vector<Vec2>& points, const Execution& execution) {
  constexpr std::size_t points_per_poll = 4096;
  text.append("polygon");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % points_per_poll == points_per_poll - 1) execution.check();
    for (const double x : {points[i].x, points[i].y}) append_next(text, x);
  }
  text.push_back('\n');
}

void append_named(std::string& text, std::string_view item, const NamedState& state) {
  text.append(item).append(" joints");
  for (std::size_t i = 0; i < state.names.size(); ++i) {
    append_next(text.append(" ").append(state.names[i]), state.values[i]);
  }
  text += '\n';
}

/// Lines that say of an arm what its robot's line does not.
void append_arm(std::string& text, const ArmFiles& arm) {
  for (const auto& [joint, value] : arm.held) append_line(text, "hold " + joint, value);
  for (const auto& [first, second] : arm.allowed) text += fmt::format("allow {} {}\n", first, second);
  if (!arm.tool.empty()) text += fmt::format("tool {}\n", arm.tool);
  if (!arm.group.empty()) text += fmt::format("group {}\n", arm.group);
  if (arm.base_pose) append_item(text, "base-pose", *arm.base_pose);
  if (arm.said.empty() && !(arm.allowed.empty() && arm.attached.empty())) text += "moveit-names\n";
  for (const AttachedSolid& attached : arm.attached) {
    text += "attach " + attached.link;
    for (const std::string& link : attached.may_touch) text += ' ' + link;
    text += ' ' + solid_text(attached.solid);
    const std::string& name = attached.solid.name;  // which others may touch it by, where it is a word
    if (scene_text::is_word(name)) text += " as " + name;
    text += '\n';
  }
}

std::string head_of(const Scene& scene, const std::string& path) {
  std::string text;
  if (scene.maze) append_line(text, "maze", scene.maze->rows, scene.maze->cols);
  if (scene.bounds) {
    const Box& b = *scene.bounds;
    append_line(text, "bounds", b.min.x, b.min.y, b.max.x, b.max.y);
  }
  if (scene.clearance) append_line(text, "clearance", *scene.clearance);
  if (scene.robot) text += "robot " + robot_text(*scene.robot) + '\n';
  append_item(text, "start", scene.start);
  append_item(text, "goal", scene.goal);
  for (const std::vector<double>& goal : scene.other_goals) append_item(text, "goal", goal);
  if (scene.named_start) append_named(text, "start", *scene.named_start);
  for (const NamedState& goal : scene.named_goals) append_named(text, "goal", goal);
  if (scene.goal_pose) {
    const Vec3 at = scene.goal_pose->translation();
    const auto [x, y, z, w] = quaternion_of_turn(scene.goal_pose->linear());
    append_line(text, "goal pose", at.x(), at.y(), at.z(), x, y, z, w);
  }
  if (scene.grid) append_line(text, "grid", scene.grid->cell, scene.grid->angles);
  if (scene.arm) append_arm(text, *scene.arm);
  const auto name = [&](const std::string& file) { return name_beside(path, file); };
  for (const std::string& line : price_lines(scene.prices, name)) text += line + '\n';
  return text;
}

std::string solids_of(const Scene& scene) {
  std::string text;
  for (const Sphere& s : scene.spheres) append_line(text, "sphere", s.x, s.y, s.z, s.radius);
  for (const auto& [low, high] : scene.boxes)
    append_line(text, "box", low[0], low[1], low[2], high[0], high[1], high[2]);
  for (const Solid& solid : scene.solids) text += solid_text(solid) + '\n';
  return text;
}

void append_wall(std::string& text, const Segment& s) {
  append_number(text, s.a.x);
  for (const double x : {s.a.y, s.b.x, s.b.y}) append_next(text, x);
  text.push_back('\n');
}

}  // namespace

Scene read_scene_text(const InputFile& file, const Execution& execution) { return SceneReader(file, execution).read(); }

/// Shortest decimal numbers that read back the same, half-integers (mazes) by integer digits. Walls are formatted in
/// parallel and written in their order.
void write_scene_text(const Scene& scene, const SceneTextSink& write, const Execution& execution,
                      const std::string& path) {
  struct {
    const SceneTextSink& write;
  } to{write};
  write(head_of(scene, path));
  write_in_pieces(to, scene.polygons.size(), line_grain / 16, execution, [&](Range r, std::string& text) {
    for (std::size_t i = r.first; i < r.last; ++i) append_polygon(text, scene.polygons[i].corners, execution);
  });
  write(solids_of(scene));
  scene.walls.visit([&](auto walls) {
    write_in_pieces(to, walls.size(), line_grain, execution, [&](Range r, std::string& text) {
      for (std::size_t i = r.first; i < r.last; ++i) append_wall(text, walls[i].segment());
    });
  });
}

void write_scene_text(const Scene& scene, const std::string& path, const Execution& execution) {
  if (execution.progress != nullptr) execution.progress->begin("write", scene.polygons.size() + scene.walls.size());
  OutputFile file(path, execution);
  write_scene_text(
      scene, [&](std::string_view text) { file.write(text); }, execution, path);
  file.commit();
}

}  // namespace warren
