// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/read_answer_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "scenes/text/json_text.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/question/asked_words.hpp"

namespace warren {
namespace {

using Json = nlohmann::json;

constexpr std::string_view point_expected =
    "[X, Y], two finite numbers (three for bodies that turn, one a joint for arms)";
constexpr std::string_view path_expected = "a list of points [X, Y]";

/// Takes the events of the parser. Keys that matter stand at depth 1 (the answer itself) and in "world"; all others are
/// passed over at any depth.
class AnswerReader {
 public:
  AnswerReader(const std::string& file, const Execution& execution) : file_(file), execution_(execution) {}

  bool null() { return other("null"); }
  bool boolean(bool value) {
    if (in("return")) answer_.problem.rule.back = value;
    if (in("kept")) keeping().kept = value;
    if (in("optimal")) answer_.optimal = value;
    if (in_option("optimise")) answer_.driving.optimise = value;
    return other("true or false");
  }
  bool number_integer(Json::number_integer_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(Json::number_unsigned_t value) { return number(static_cast<double>(value)); }
  bool number_float(Json::number_float_t value, const std::string&) { return number(value); }
  bool string(std::string& text) {
    if (in("contact")) {
      if (text != "allowed" && text != "blocked") refuse("\"allowed\" or \"blocked\"", text);
      answer_.problem.contact = text == "allowed" ? Contact::allowed : Contact::blocked;
    } else if (in("robot")) {
      RobotSpec robot = robot_value(fmt::format("{}: key \"robot\"", file_), text);
      if (robot.files) robot.files->said.clear();  // what MoveIt says, the robot may lack
      answer_.problem.robot = std::move(robot);
    } else if (in("prices") && arrays_ == 1) {
      read_price_line(text, fmt::format("{}: key \"prices\"", file_), answer_.problem.prices, execution_);
    } else if (in("goal_tolerance") && text == "inf") {
      answer_.problem.rule.tolerance = std::numeric_limits<double>::infinity();
    } else if (in("bound_of")) {
      answer_.bound_of = text;
    } else if (in("joints") && arrays_ == 1) {
      answer_.joints.push_back(text);
    } else if (objects_ == 2 && keys_[0] == "world" && keys_[1] == "hash") {
      answer_.world_hash = text;
    } else {
      return other("a text");
    }
    return true;
  }
  bool binary(Json::binary_t&) { return false; }
  bool start_object(std::size_t) {
    if (in("path")) refuse(path_expected, "an object");
    if (lists_around() > 0) refuse(point_expected, "an object");
    if (in("price")) answer_.price.emplace();
    if (in("goal_reached")) answer_.goal_reached.emplace();
    if (in("alternatives")) answer_.alternatives.emplace_back();
    if (in("holes")) answer_.holes.emplace_back();
    ++objects_;
    return true;
  }
  bool end_object() {
    --objects_;
    return true;
  }
  bool key(std::string& name) {
    if (objects_ <= 3) keys_[objects_ - 1] = name;
    if (in("path") && std::exchange(has_path_, true)) refuse("it once", "twice");
    return true;
  }
  bool start_array(std::size_t) {
    if (objects_ == 0) refuse_kind();
    if (lists_around() == 2 && arrays_ >= 2) refuse(path_expected, "a deeper list");
    if (number_place() != nullptr) refuse("a number", "a list");
    ++arrays_;
    numbers_.clear();
    return true;
  }
  bool end_array() {
    --arrays_;
    if (in("path") && arrays_ == 1) end_point();
    if (auto* const list = places(); list != nullptr && arrays_ == 1) {
      if (numbers_.size() < (in("goals") ? 1U : 2U)) refuse(point_expected, fmt::format("{} numbers", numbers_.size()));
      list->push_back(numbers_);
    }
    if (objects_ == 2) end_inner_list();
    if (in("start") && arrays_ == 0) answer_.problem.start = numbers_;
    if (in("goal") && arrays_ == 0) answer_.problem.goal = numbers_;
    if (in("goal_pose") && arrays_ == 0) take_pose();
    if (in_state() && numbers_.empty()) refuse(point_expected);
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception&) {
    scene_text::Place{file_, 0}.fail(fmt::format("this is not JSON from byte {} on", position), token);
  }

  RecordedAnswer finish() {
    if (!has_path_) throw InputError(file_, "the answer has no key \"path\"");
    if (answer_.path.empty()) throw InputError(file_, "key \"path\" has no points: there is nothing to check");
    const bool of_arm = answer_.problem.robot && answer_.problem.robot->kind == RobotKind::urdf;
    for (const auto& [name, state] : {std::pair{"start", &answer_.problem.start}, {"goal", &answer_.problem.goal}}) {
      keys_[0] = name;  // one number is for arms of one joint
      if (state->size() == 1 && !of_arm) refuse(point_expected);
    }
    GoalRule& rule = answer_.problem.rule;
    if (!rule.others.empty()) rule.others.erase(rule.others.begin());  // the first is "goal"
    if (answer_.price) answer_.price->error = cost_error_.value_or(0.0);
    try {
      check_prices(answer_.problem.prices);
      check_goal_rule(rule, of_arm ? 1 : 2);
    } catch (const UsageError& error) {
      throw InputError(file_, error.spelled("", '_'));
    }
    return std::move(answer_);
  }

 private:
  static void take_part(PriceParts& parts, std::string_view name, double value) {
    if (name == "clearance") parts.clearance = value;
    if (name == "areas") parts.areas = value;
    if (name == "turning") parts.turning = value;
    if (name == "cusps") parts.cusps = value;
    if (name == "reverse") parts.reverse = value;
  }
  KeptRoute& keeping() { return answer_.keeping ? *answer_.keeping : answer_.keeping.emplace(); }
  /// In the list of that name, in one of its objects.
  bool in_one_of(std::string_view name) const { return objects_ >= 2 && keys_[0] == name && arrays_ >= 1; }

  void take_inner(double value) {
    if (in_one_of("alternatives")) {
      AlternativePath& other = answer_.alternatives.back();
      if (objects_ == 3 && keys_[1] == "price") take_part(other.price, keys_[2], value);
      if (objects_ > 2) return;
      if (keys_[1] == "cost") other.cost = value;
      if (keys_[1] == "length") other.length = value;
      if (keys_[1] == "min_clearance") other.min_clearance = value;
      if (keys_[1] == "class") other.passed.push_back(bounded_whole<std::int32_t>(value));
      if (keys_[1] == "path") take_number(value);
    } else if (in_one_of("holes")) {
      if (keys_[1] == "id") answer_.holes.back().id = bounded_whole<std::uint32_t>(value, 0.0);
      if (keys_[1] == "box") take_number(value);
    } else if (objects_ == 2 && keys_[0] == "price" && arrays_ == 0) {
      take_part(*answer_.price, keys_[1], value);
    } else if (objects_ == 2 && keys_[0] == "goal_reached") {
      GoalReached& reached = *answer_.goal_reached;
      if (keys_[1] == "asked" && arrays_ == 1 && reached.asked.size() < most_joints) reached.asked.push_back(value);
      if (keys_[1] == "distance") reached.distance = value;
      if (keys_[1] == "distance_bound") reached.distance_bound = value;
    }
  }
  void check_size(double value) const {
    if (!is_coordinate(value)) refuse("finite numbers of at most 1e60");
  }
  void take_number(double value) {
    check_size(value);
    if (numbers_.size() >= 4) refuse("four numbers at most");
    numbers_.push_back(value);
  }
  void end_inner_list() {
    if (in_one_of("alternatives") && keys_[1] == "path" && arrays_ == 2) {
      if (numbers_.size() != 2) refuse(path_expected, fmt::format("a point of {} numbers", numbers_.size()));
      answer_.alternatives.back().path.push_back({numbers_[0], numbers_[1]});
    }
    if (in_one_of("holes") && keys_[1] == "box" && arrays_ == 1) {
      if (numbers_.size() != 4) refuse("a box of four numbers", fmt::format("{} numbers", numbers_.size()));
      answer_.holes.back().box = {{numbers_[0], numbers_[1]}, {numbers_[2], numbers_[3]}};
    }
  }
  bool number(double value) {
    if (objects_ == 0) refuse_kind();
    if (const int lists = lists_around(); lists > 0) {
      check_size(value);
      if (arrays_ != lists) refuse(lists == 2 ? path_expected : point_expected, "a number");
      if (numbers_.size() >= most_joints) refuse(in("path") ? path_expected : point_expected, "more numbers");
      numbers_.push_back(value);
    } else if (std::optional<double>* const place = number_place()) {
      check_size(value);
      if (in("clearance") && value < 0.0) refuse("a number of at least 0", fmt::format("{}", value));
      *place = value;
    }
    if (objects_ >= 2) take_inner(value);
    if (in("order") && arrays_ == 1) answer_.order.push_back(bounded_whole<std::uint64_t>(value, 0.0));
    if (in("class") && arrays_ == 1) answer_.passed.push_back(bounded_whole<std::int32_t>(value));
    if (in("kept_cost")) keeping().kept_cost = value;
    if (in("new_cost")) keeping().new_cost = value;
    if (in_option("turn_cost")) answer_.driving.turn_cost = value;
    if (in_option("cusp_cost")) answer_.driving.cusp_cost = value;
    if (in_option("reverse_cost")) answer_.driving.reverse_cost = value;
    if (in("goal_index") && arrays_ == 0 && value >= 0.0) answer_.goal_index = bounded_whole<std::uint64_t>(value);
    return true;
  }
  /// null is as good as a key that isn't there.
  bool other(const char* found) {
    if (in("path")) refuse(path_expected, found);
    const bool missing = std::string_view(found) == "null" && arrays_ == 0;
    if (lists_around() > 0 && !missing) refuse(point_expected, found);
    if (number_place() != nullptr && !missing) refuse("a number", found);
    if (in("contact") && !missing) refuse("\"allowed\" or \"blocked\"", found);
    if (objects_ == 0) refuse_kind();
    return true;
  }
  [[noreturn]] void refuse(std::string_view expected, std::string_view found = {}) const {
    scene_text::Place{fmt::format("{}: key \"{}\"", file_, keys_[0]), 0}.fail(fmt::format("expected {}", expected),
                                                                              found);
  }
  [[noreturn]] void refuse_kind() const { throw InputError(file_, "expected one JSON object: an answer"); }
  bool in(std::string_view name) const { return objects_ == 1 && keys_[0] == name; }
  bool in_option(std::string_view name) const {
    return objects_ == 2 && arrays_ == 0 && keys_[0] == "options" && keys_[1] == name;
  }
  bool in_state() const { return in("start") || in("goal") || in("goal_pose"); }
  void take_pose() {
    const Eigen::Quaterniond turn = numbers_.size() == 7
                                        ? Eigen::Quaterniond(numbers_[6], numbers_[3], numbers_[4], numbers_[5])
                                        : Eigen::Quaterniond(0.0, 0.0, 0.0, 0.0);
    if (!(turn.norm() > 0.0)) refuse("[X, Y, Z, QX, QY, QZ, QW]");
    answer_.problem.goal_pose = Eigen::Translation3d(numbers_[0], numbers_[1], numbers_[2]) * turn.normalized();
  }
  /// Where a list of states goes; nullptr: this is none.
  std::vector<std::vector<double>>* places() {
    GoalRule& rule = answer_.problem.rule;
    return in("goals") ? &rule.others : in("visit") ? &rule.visit : in("via") ? &answer_.via : nullptr;
  }
  /// Around each number of a path, of a list of states, of a state; 0: this is none.
  int lists_around() { return in("path") || places() != nullptr ? 2 : in_state() ? 1 : 0; }
  /// Where a number of the answer itself goes; nullptr: of another key.
  std::optional<double>* number_place() {
    GoalRule& rule = answer_.problem.rule;
    const std::pair<std::string_view, std::optional<double>*> keyed[] = {{"clearance", &answer_.problem.clearance},
                                                                         {"length", &answer_.length},
                                                                         {"lower_bound", &answer_.lower_bound},
                                                                         {"gap", &answer_.gap},
                                                                         {"cost", &answer_.cost},
                                                                         {"cost_error", &cost_error_},
                                                                         {"hole_size", &answer_.hole_size},
                                                                         {"goal_tolerance", &rule.tolerance},
                                                                         {"goal_region", &rule.region},
                                                                         {"goal_heading_rad", &rule.heading_rad}};
    const auto* const found = std::ranges::find_if(keyed, [&](const auto& key) { return in(key.first); });
    return found != std::end(keyed) ? found->second : nullptr;
  }
  void end_point() {
    const std::size_t width = answer_.path.empty() ? numbers_.size() : answer_.state_width();
    if (numbers_.empty() || numbers_.size() != width) {
      refuse(path_expected, fmt::format("{} numbers in point {}", numbers_.size(), answer_.path.size()));
    }
    execution_.poll(answer_.path.size());
    answer_.path.push_back({numbers_[0], numbers_.size() > 1 ? numbers_[1] : 0.0});
    if (width == 2) return;
    answer_.states.width = width;
    answer_.states.add(numbers_);
  }

  const std::string& file_;
  const Execution& execution_;
  RecordedAnswer answer_;
  std::array<std::string, 3> keys_;  // of the answer itself, of an object in it, of an object in that
  std::size_t objects_ = 0;
  int arrays_ = 0;
  std::optional<double> cost_error_;
  std::vector<double> numbers_;  // of the array that is being read
  bool has_path_ = false;
};

}  // namespace

RecordedAnswer recorded(const Answer& answer) {
  RecordedAnswer record;
  static_cast<ClaimedPath&>(record) = answer;
  record.problem = answer.problem.question();
  if (const auto& files = answer.problem.robot.files; files && files->read)
    std::ranges::transform(files->read->variables, std::back_inserter(record.joints), &ArmVariable::name);
  record.via = answer.problem.via;
  record.world_hash = answer.world.hash;
  record.length = answer.length;
  const auto number = [&](std::string_view name) -> std::optional<double> {
    const double* value = std::get_if<double>(figure_named(answer.options, name));
    return value != nullptr ? std::optional(*value) : std::nullopt;
  };
  record.driving = {number("turn_cost"), number("cusp_cost"), number("reverse_cost"),
                    figure_named(answer.options, "optimise") != nullptr};
  record.file = "answer";
  return record;
}

RecordedAnswer recorded(std::span<const std::vector<double>> states) {
  RecordedAnswer record;
  record.file = "answer";
  for (const std::vector<double>& state : states) {
    if (state.size() == 2) {
      record.path.push_back({state[0], state[1]});
    } else {
      record.states.width = state.size();
      record.states.add(state);
    }
  }
  return record;
}

RecordedAnswer read_answer(const InputFile& input, const Execution& execution) {
  JsonBytes bytes(input, execution);
  AnswerReader reader(input.name(), execution);
  Json::sax_parse(bytes.begin(), bytes.end(), &reader);
  RecordedAnswer answer = reader.finish();
  answer.file = input.name();
  return answer;
}

std::vector<std::vector<double>> states_of(const RecordedAnswer& answer) {
  std::vector<std::vector<double>> states;
  for (std::size_t i = 0; i < answer.state_count(); ++i) states.push_back(answer.state(i));
  return states;
}

void check_state_width(const RecordedAnswer& answer, std::size_t width, std::string_view body) {
  if (answer.state_width() == width) return;
  throw InputError(fmt::format("{}: key \"path\"", answer.file),
                   fmt::format("expected {} numbers a state for {}", width, body),
                   fmt::format("{} numbers in point 0", answer.state_width()));
}

bool names_other_joints(std::span<const std::string> named, std::span<const ArmVariable> joints) {
  return !named.empty() && !std::ranges::equal(named, joints, {}, {}, &ArmVariable::name);
}

void check_joints(const RecordedAnswer& answer, std::span<const ArmVariable> joints) {
  check_state_width(answer, joints.size(), "an arm");
  if (!names_other_joints(answer.joints, joints)) return;
  throw InputError(answer.file, "key \"joints\": the robot has other joints, or in another order");
}

void keep_to(RouteRule& route, const RecordedAnswer& answer) {
  route.keep_to = states_of(answer);
  route.joints = answer.joints;
}

void check_same_world(const RecordedAnswer& answer, const std::string& file, const Scene& scene,
                      const Execution& execution) {
  if (!answer.world_hash || (is_unmade(scene) && unmade_hash(scene).empty())) return;
  const std::string hash = scene_hash(scene, execution);
  if (hash == *answer.world_hash || ((scene.formula || scene.packed) && unmade_hash(scene) == *answer.world_hash))
    return;
  refuse_other_world(answer, file, scene, hash);
}

void refuse_other_world(const RecordedAnswer& answer, const std::string& file, const Scene& scene,
                        const std::string& hash) {
  throw InputError(file, fmt::format("this answer is about another world: {} has the hash {}", scene.source, hash),
                   answer.world_hash->substr(0, 16));
}

}  // namespace warren
