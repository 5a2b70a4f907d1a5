// SPDX-License-Identifier: BSD-3-Clause
// Answers: what they say, their path as an array, as JSON, as places along it.
#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "apps/python/bind.hpp"
#include "pictures/answer_summary.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/answer/explanation_text.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/paths/timed_path.hpp"
#include "tools/words/question_words.hpp"

namespace warren::python {
namespace py = pybind11;
using namespace py::literals;
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What others call `every` is near to words that mean something else.
tools::Command with_every(tools::Command command) {
  for (const std::string_view other : {"--step", "--steps", "--spacing", "--interval", "--dt", "--resolution"}) {
    command.foreign.emplace_back(other, "places so far apart, or moments, are asked for by every=");
  }
  return command;
}
tools::Command saving_paths() { return with_every(command_of("save_path", {tools::path_option_specs()})); }
tools::Command sampling() { return with_every(command_of("sample", {tools::path_option_specs()}, {"--frame"})); }

py::array path_of(const py::object& self) {
  const Answer& answer = self.cast<const KeptAnswer&>().answer;
  const StateList& states = answer.states;
  if (!states.empty()) return view_of(states.numbers.data(), shape_of(states.size(), states.width), self);
  if (answer.path.empty()) return read_only(py::array_t<double>(Shape{0, 2}));
  return view_of(&answer.path.data()->x, shape_of(answer.path.size(), 2), self);
}

std::string json_of(const Answer& answer) {
  std::string text;
  CallLimits().run([&](const Execution& execution) {
    write_answer_json(answer, execution, [&](std::string_view piece) { text += piece; });
  });
  return text;
}

py::dict seconds_of(const Answer& answer) {
  py::dict seconds;
  for (const auto& [stage, s] : named_stages(answer.seconds)) seconds[stage] = s;
  return seconds;
}

py::list improvements_of(const Answer& answer) {
  py::list all;
  for (const Improvement& i : answer.improvements) {
    all.append(py::make_tuple(i.iterations, i.seconds, i.length, i.cost, i.by, i.lower_bound));
  }
  return all;
}

py::object blocked_of(const Answer& answer) {
  if (!answer.blocked) return py::none();
  const BlockedEnd& end = *answer.blocked;
  const bool is_place = !end.free_place.empty();
  return py::dict("end"_a = end.is_start ? "start" : "goal", "by"_a = end.by,
                  "free_place"_a = is_place ? py::object(py::tuple(py::cast(end.free_place))) : py::none(),
                  "distance"_a = is_place ? std::optional(end.distance) : std::nullopt,
                  "hint"_a = end.hint.empty() ? std::nullopt : std::optional(end.hint), "room"_a = end.room,
                  "needed"_a = end.needed, "depth"_a = end.depth);
}

py::dict price_of(const PriceParts& price) {
  return py::dict("clearance"_a = price.clearance, "areas"_a = price.areas, "turning"_a = price.turning,
                  "cusps"_a = price.cusps, "reverse"_a = price.reverse);
}

py::object reached_of(const Answer& answer) {
  if (!answer.goal_reached) return py::none();
  const GoalReached& reached = *answer.goal_reached;
  return py::make_tuple(py::tuple(py::cast(reached.asked)), reached.distance, reached.distance_bound);
}

py::list alternatives_of(const Answer& answer) {
  py::list all;
  for (const AlternativePath& other : answer.alternatives) {
    all.append(py::make_tuple(other.cost, other.length, price_of(other.price), other.min_clearance,
                              py::tuple(py::cast(other.passed)), array_of<double>(other.path, {2})));
  }
  return all;
}

py::list holes_of(const Answer& answer) {
  py::list all;
  for (const MapHole& hole : answer.holes) {
    const Box& b = hole.box;
    all.append(py::make_tuple(hole.id, py::make_tuple(b.min.x, b.min.y, b.max.x, b.max.y)));
  }
  return all;
}

py::object keeping_of(const Answer& answer) {
  if (!answer.keeping) return py::none();
  return py::make_tuple(answer.keeping->kept, answer.keeping->kept_cost, answer.keeping->new_cost);
}

/// States at even steps along the path, its own states among them: one row each; and how far along they are.
std::pair<RawVector<double>, RawVector<double>> places_along(const PathLegs& legs, double every,
                                                             const Execution& execution) {
  RawVector<double> states;
  RawVector<double> along;
  const auto add = [&](std::size_t leg, double share, double at) {
    execution.poll(along.size());
    const PathState state = legs.at(leg, share);
    states.insert(states.end(), state.used().begin(), state.used().end());
    along.push_back(at);
  };
  add(0, 0.0, 0.0);
  double before = 0.0;
  for (std::size_t i = 0; i < legs.leg_count(); ++i) {
    const double length = legs.length(i);
    const double parts = std::max(1.0, std::ceil(length / every * (1.0 - 1e-12)));
    execution.reserve(static_cast<std::size_t>(std::min(parts, 1e12)) * 64);
    for (double k = 1.0; k <= parts; k += 1.0) add(i, k / parts, before + length * (k / parts));
    before += length;
  }
  return {std::move(states), std::move(along)};
}

/// States at even moments, the last one too; and the moments.
std::pair<RawVector<double>, RawVector<double>> places_in_time(const PathLegs& legs, const TravelLimits& limits,
                                                               double every_s, const Execution& execution) {
  const TimedPath timed(legs, limits, execution);
  RawVector<double> states;
  RawVector<double> times;
  for (double k = 0.0;; k += 1.0) {
    const double t = std::min(k * every_s, timed.duration_s());
    execution.poll(times.size());
    if (times.size() % 4096 == 0) execution.reserve(std::size_t{4096} * 64);
    const PathMoment moment = timed.at(t);
    const PathState state = legs.at(moment.leg, moment.share);
    states.insert(states.end(), state.used().begin(), state.used().end());
    times.push_back(t);
    if (t >= timed.duration_s()) return {std::move(states), std::move(times)};
  }
}

/// (states, along or times); the keywords are those of paths in files.
py::tuple sample(const Answer& answer, const py::dict& keywords) {
  keywords["path"] = "-";
  const PathFileOptions options = tools::path_words(arguments_of(made_once<sampling>(), keywords));
  check_path_file(answer.problem.robot, "-", options);
  if (answer.path.empty() && answer.states.empty()) {
    return py::make_tuple(read_only(py::array_t<double>(Shape{0, 2})), read_only(py::array_t<double>(Shape{0})));
  }
  const PathLegs legs(answer);
  auto [states, at] = CallLimits().run([&](const Execution& execution) {
    if (options.every_s) return places_in_time(legs, *options.limits, *options.every_s, execution);
    return places_along(legs, options.every.value_or(std::numeric_limits<double>::infinity()), execution);
  });
  return py::make_tuple(array_of<double>(std::move(states), shape_of(legs.width())), array_of<double>(std::move(at)));
}

py::dict save_path(const Answer& answer, const std::string& file, const py::dict& keywords) {
  keywords["path"] = file;
  const PathFileOptions options = tools::path_words(arguments_of(made_once<saving_paths>(), keywords));
  check_path_file(answer.problem.robot, file, options);
  if (!answer.verified) throw py::value_error("save_path: the answer has no path");
  const PathFileAccount account =
      CallLimits().run([&](const Execution& on) { return write_path_file(answer, file, options, on); });
  return py::dict("places"_a = account.places, "duration_s"_a = account.duration_s);
}

/// A figure that an answer has or has not.
template <class Class, class Get>
void figure(Class& answers, const char* name, const Get& get) {
  answers.def_property_readonly(name, [get](const KeptAnswer& kept) { return get(kept.answer); });
}

/// Of prices, goals that are many, and other ways.
void bind_prices(py::class_<KeptAnswer>& answers) {
  figure(answers, "cost", [](const Answer& a) { return a.cost.value_or(unknown); });
  figure(answers, "price", [](const Answer& a) { return a.price ? std::optional(price_of(*a.price)) : std::nullopt; });
  figure(answers, "cost_error", [](const Answer& a) { return a.price ? a.price->error : unknown; });
  figure(answers, "bound_of",
         [](const Answer& a) { return a.bound_of.empty() ? std::nullopt : std::optional(a.bound_of); });
  figure(answers, "goal_index", [](const Answer& a) { return a.goal_index; });
  figure(answers, "goal_reached", &reached_of);
  figure(answers, "order", [](const Answer& a) { return a.order; });
  figure(answers, "passed", [](const Answer& a) { return py::tuple(py::cast(a.passed)); });
  figure(answers, "alternatives", &alternatives_of);
  figure(answers, "holes", &holes_of);
  figure(answers, "keeping", &keeping_of);
}

}  // namespace

void bind_answers(py::module_& module) {
  py::class_<KeptAnswer> answers(module, "Answer");
  answers.def_property_readonly("path", &path_of);
  figure(answers, "status", [](const Answer& a) { return name_of(a.outcome); });
  figure(answers, "stop_reason", [](const Answer& a) {
    using Told = std::optional<std::pair<std::string_view, std::string>>;
    return a.stop_reason ? Told({name_of(*a.stop_reason), stop_text(*a.stop_reason, a.wanted_memory_bytes)}) : Told{};
  });
  figure(answers, "verified", [](const Answer& a) { return a.verified; });
  figure(answers, "optimal", [](const Answer& a) { return a.optimal; });
  figure(answers, "lower_bound", [](const Answer& a) { return a.lower_bound.value_or(unknown); });
  figure(answers, "gap", [](const Answer& a) { return gap_of(a).value_or(unknown); });
  figure(answers, "length", [](const Answer& a) { return a.verified ? a.length : unknown; });
  figure(answers, "min_clearance", [](const Answer& a) { return a.verified ? a.min_clearance : unknown; });
  figure(answers, "raw_length", [](const Answer& a) { return a.raw_length.value_or(unknown); });
  bind_prices(answers);
  figure(answers, "iterations", [](const Answer& a) { return a.iterations; });
  figure(answers, "ended_by",
         [](const Answer& a) { return a.ended_by.empty() ? std::nullopt : std::optional(a.ended_by); });
  figure(answers, "improvements", &improvements_of);
  figure(answers, "turn_rad", [](const Answer& a) { return a.turn_rad.value_or(unknown); });
  figure(answers, "robot", [](const Answer& a) { return robot_text(a.problem.robot); });
  figure(answers, "start", [](const Answer& a) { return a.problem.start; });
  figure(answers, "goal", [](const Answer& a) { return a.problem.goal; });
  figure(answers, "clearance", [](const Answer& a) { return a.problem.clearance; });
  figure(answers, "planner", [](const Answer& a) { return a.planner; });
  figure(answers, "seed", [](const Answer& a) { return a.seed; });
  figure(answers, "solve_s", [](const Answer& a) { return a.solve_s; });
  figure(answers, "seconds", &seconds_of);
  figure(answers, "blocked", &blocked_of);
  figure(answers, "json", &json_of);
  figure(answers, "explained",
         [](const Answer& a) { return a.explained ? std::optional(explanation_json(a)) : std::nullopt; });
  figure(answers, "summary", [](const Answer& a) {
    const Palette plain(false);
    return with_keywords(summary_of(a, plain, {}) + notes_text(a, plain) + explanation_text(a, plain));
  });
  answers.def("sample", [](const KeptAnswer& kept, const py::dict& how) { return sample(kept.answer, how); })
      .def("save",
           [](const KeptAnswer& kept, const std::string& file) {
             CallLimits().run([&](const Execution& execution) {
               OutputFile out(file, execution);
               write_answer_json(kept.answer, execution, [&](std::string_view piece) { out.write(piece); });
               out.commit();
             });
           })
      .def("save_path", [](const KeptAnswer& kept, const std::string& file,
                           const py::dict& how) { return save_path(kept.answer, file, how); })
      .def(py::pickle([](const KeptAnswer& kept) { return bytes_of(kept.answer); },
                      [](const py::bytes& bytes) { return KeptAnswer{from_bytes<Answer>(bytes)}; }));
  module.def("path_keywords", [] { return keyword_table(made_once<saving_paths>()); });
}

}  // namespace warren::python
