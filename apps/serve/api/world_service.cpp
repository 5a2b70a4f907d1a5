// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/world_service.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/serve/api/kept_path.hpp"
#include "apps/serve/api/request_bodies_io.hpp"
#include "apps/serve/api/world_layers.hpp"
#include "apps/serve/page/served_files.hpp"
#include "pictures/formats/markup.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/kept/ask_batch_io.hpp"
#include "solve/kept/checksum.hpp"
#include "solve/kinds/kind_of_problem.hpp"

namespace warren::serve {

RunningQuestions::Entry::Entry(RunningQuestions& all, std::string name)
    : all_(all), name_(std::move(name)), is_seen_(!name_.empty() && all_.questions_.use([this](auto& questions) {
        return questions.try_emplace(name_).second;
      })) {}

RunningQuestions::Entry::~Entry() {
  if (is_seen_) all_.questions_.use([this](auto& questions) { questions.erase(name_); });
}

void RunningQuestions::Entry::tell(const Improvement& improvement, std::vector<Vec2> way) {
  if (!is_seen_) return;
  if (way.size() > most_points) way.clear();
  all_.questions_.use([&](auto& questions) {
    Question& question = questions.at(name_);
    question.told.push_back({improvement, std::move(way)});
    if (question.told.size() <= most_told) return;
    question.told.pop_front();
    ++question.first;
  });
}

std::string RunningQuestions::told(const std::string& name, std::uint64_t from) const {
  std::vector<Told> fresh;
  std::uint64_t first = from;
  const bool is_running = questions_.use([&](const auto& questions) {
    const auto found = questions.find(name);
    if (found == questions.end()) return false;
    const Question& question = found->second;
    first = std::max(from, question.first);
    std::size_t points = 0;  // written on the thread of all connections: who is told only some of them asks again
    for (std::uint64_t i = first - question.first; i < question.told.size() && points < most_points_told; ++i) {
      fresh.push_back(question.told[i]);
      points += question.told[i].way.size();
    }
    return true;
  });
  if (!is_running) return "{\"running\":false}";
  const auto told_json = [](const Told& one) {
    const Improvement& better = one.improvement;
    const auto bound = better.lower_bound > 0.0 ? std::optional(better.lower_bound) : std::nullopt;
    return json_object("iterations", better.iterations, "seconds", better.seconds, "length", better.length, "cost",
                       better.cost, "by", better.by, "lower_bound", bound, "chains",
                       JsonText{json_chains({one.way}, {})});
  };
  return json_object("running", true, "first", first, "improvements", JsonText{json_list_of(fresh, ", ", told_json)});
}

namespace {

// What is asked about route graphs.

std::vector<DrawnEdge> edges_of(const RouteGraph& graph, const std::vector<RouteEnds>& ends) {
  const auto place = [&](std::size_t node) { return EdgePlace{graph.nodes[node].at, graph.nodes[node].theta}; };
  std::vector<DrawnEdge> edges;
  for (const RouteEnds& e : ends) edges.push_back({place(e.from), place(e.to)});
  return edges;
}

void refuse_blocked(const RouteGraph& graph, const std::vector<EdgeVerdict>& verdicts) {
  const auto first = std::ranges::find(verdicts, false, &EdgeVerdict::free);
  if (first == verdicts.end()) return;
  const auto blocked = std::ranges::count(verdicts, false, &EdgeVerdict::free);
  const RouteEdge& edge = graph.edges[static_cast<std::size_t>(first - verdicts.begin())];
  throw HttpError(422, "not_free", "edges",
                  fmt::format("{} of {} edges are not free, so nothing is saved; edge {} from node {} to {}: {}",
                              blocked, verdicts.size(), edge.id, edge.from, edge.to, words_of(*first)));
}

const EdgeJudge& judge_of(const ServedWorld& world, const Execution& execution) {
  if (world.query() != nullptr) body_on_edges(world.query()->roadmap());  // which may steer otherwise
  check_drives_edges(world.robot());
  if (world.query() != nullptr && world.query()->roadmap().lattice != nullptr) {
    throw UsageError("a large maze is asked by its lattice, and route graphs are for maps and scenes");
  }
  return world.judge(execution);
}

RouteGraph asked_graph(const ServedWorld& world, std::string_view body, const Execution& execution) {
  const GraphOptions options = read_graph_options(body);
  judge_of(world, execution);  // or there are no such graphs
  const bool is_as_it_is = options.kind == GraphKind::roadmap && !options.samples && !options.neighbours;
  if (world.query() != nullptr && is_as_it_is) return graph_of_roadmap(world.query()->roadmap(), execution);
  return graph_of_roadmap(built_roadmap(world.barred(execution), world.robot(), world.clearance(), options, execution),
                          execution);
}

std::size_t sample_count(const HttpRequest& request) {
  constexpr double most = 2000.0;
  const double count = numbers_parameter(request, "samples", 1).value_or(std::vector{200.0})[0];
  if (count >= 2.0 && count <= most && count == std::floor(count)) return static_cast<std::size_t>(count);
  throw HttpError(400, "bad_request", "query", "samples: expected a whole number, 2 to 2000");
}

/// What is drawn of a body: corners, or the radius of one that has none.
void add_outline(JsonObject& json, const RobotSpec& robot) {
  const auto corner_json = [](Vec2 at) { return numbers_json(std::array{at.x, at.y}).text; };
  json.add("radius", robot.outline.empty() ? robot.radius : 0.0, "outline",
           JsonText{json_list_of(robot.outline, ",", corner_json)});
}

// What a service says of its world and of itself.

std::string tiles_json(const TileGrid& grid, const std::string& hash) {
  return json_object("url", "v/" + hash + "/tiles/{z}/{x}/{y}.png", "pixels", TileGrid::pixels, "levels", grid.levels,
                     "corner", numbers_json(std::array{grid.corner.x, grid.corner.y}), "span", grid.span);
}

std::string planners_json(const ServedWorld& world, const Question& body, bool asks_roadmap) {
  std::string text = "[";
  if (!asks_roadmap) {
    for (const PlannerKind planner : planners_there_are()) {
      try {
        choose_solver({.planner = planner}, world.outline(), body);
        text += (text.size() > 1 ? "," : "") + json_string(name_of(planner));
      } catch (const UsageError&) {  // not in this world
      }
    }
  }
  return text + "]";
}

/// A lattice in a file has its walls made later.
std::string words_of_world(const Scene& outline) {
  if (outline.maze && outline.walls.size() == 0) {
    return fmt::format("{} x {} maze", grouped(outline.maze->rows), grouped(outline.maze->cols));
  }
  return description_of(outline);
}

void add_line(std::string& text, std::string_view name, std::string_view kind, std::string_view help, double value) {
  fmt::format_to(std::back_inserter(text), "# HELP warren_{} {}\n# TYPE warren_{} {}\nwarren_{} {}\n", name, help, name,
                 kind, name, value);
}

/// Prices and forbidden areas of file and service, as areas to be drawn; of finer ones than a page draws the words
/// alone.
std::string ground_json(const ServedWorld& world, const Question& body, const Execution& execution) {
  constexpr std::size_t most_points = 300'000;
  const Scene& outline = world.outline();
  const double radius = body.robot->outline.empty() ? body.robot->radius : 0.0;
  std::size_t points = 0;
  const auto layer_json = [&](const PictureLayer& layer) {
    std::vector<std::vector<Vec2>> chains;
    points += layer.lines.corners.size();
    for (std::size_t i = 0; i < layer.lines.size() && points <= most_points; ++i)
      chains.emplace_back(layer.lines[i].begin(), layer.lines[i].end());
    return json_object("label", layer.label, "color", css_color(layer.fill.value_or(layer.color)), "opacity",
                       layer.opacity, "chains", JsonText{json_chains(chains, execution)});
  };
  const Prices prices = world.query() != nullptr ? world.query()->roadmap().prices : prices_of(outline, body);
  return json_list_of(price_layers(prices, outline.map, radius, execution), ",", layer_json);
}

/// warren.service/1: what a page needs to show the world and to ask of this body.
std::string description_json(const ServedWorld& world, const Question& body, const WorldLayers& layers,
                             const ServiceLimits& limits, const Execution& execution) {
  const Scene& outline = world.outline();
  const bool asks_roadmap = world.query() != nullptr && world.is_own(*body.robot, *body.clearance);
  JsonObject json;
  json.add("schema", "warren.service/1", "source", outline.source);
  json.add("opened_as", world.is_roadmap() ? "roadmap" : "world", "description", words_of_world(outline));
  json.add("hash", world.hash(), "unit", unit_of(outline));
  const Box& box = world.box();
  json.add("box", numbers_json(std::array{box.min.x, box.min.y, box.max.x, box.max.y}));
  json.add("robot", robot_text(*body.robot), "state_size", std::uint64_t{state_size(*body.robot)});
  json.add("clearance", *body.clearance);
  add_outline(json, *body.robot);
  json.add("start", numbers_json(outline.start), "goal", numbers_json(outline.goal), "asks_roadmap", asks_roadmap);
  json.add_json("planners", planners_json(world, body, asks_roadmap));
  json.add("budget_ms", 1e3 * limits.budget_s, "changed", world.is_changed());
  const bool is_writable = limits.writable && world.why_fixed().empty();
  json.add("writable", is_writable && !outline.map, "cells_writable", is_writable && outline.map.has_value());
  json.add("wants_token", limits.wants_token);
  json.add_json("options", json_list(std::span(limits.options)));
  json.add_json("tiles", tiles_json(world.tiles().grid(), world.hash()));
  json.add_json("layers", layers.json(*body.robot));
  json.add_json("ground", ground_json(world, body, execution));
  return json.closed() + "\n";
}
/// In the text format of Prometheus. Bytes: of what is kept.
std::string metrics_text(const HttpFigures& f, std::size_t tile_bytes, std::size_t path_bytes) {
  std::string text;
  const auto number = [](auto count) { return static_cast<double>(count); };
  add_line(text, "connections", "gauge", "Open connections.", number(f.connections));
  add_line(text, "connections_total", "counter", "Connections accepted.", number(f.accepted));
  add_line(text, "connections_gave_way_total", "counter", "Connections closed for others.", number(f.gave_way));
  add_line(text, "requests_timed_out_total", "counter", "Requests that did not come in time.", number(f.timed_out));
  add_line(text, "requests_abandoned_total", "counter", "Clients who left before their answer.", number(f.abandoned));
  add_line(text, "requests_working", "gauge", "Requests worked on or waiting for it.", number(f.working));
  add_line(text, "requests_worked_total", "counter", "Requests that were worked on.", number(f.worked));
  add_line(text, "wait_seconds_total", "counter", "Time that they waited for a thread.", f.waited_s);
  add_line(text, "work_seconds_total", "counter", "Time that was worked on them.", f.worked_s);
  text += "# HELP warren_responses_total Answers by the first digit of their status.\n";
  text += "# TYPE warren_responses_total counter\n";
  for (std::size_t digit = 1; digit < f.said.size(); ++digit) {
    fmt::format_to(std::back_inserter(text), "warren_responses_total{{status=\"{}xx\"}} {}\n", digit, f.said[digit]);
  }
  add_line(text, "kept_tile_bytes", "gauge", "Tiles that are kept.", number(tile_bytes));
  add_line(text, "kept_path_bytes", "gauge", "Paths that are kept.", number(path_bytes));
  add_line(text, "resident_bytes", "gauge", "Memory that the process holds.", number(resident_bytes()));
  return text;
}

/// Changes whenever tiles of a world look otherwise than before.
constexpr int tile_style = 1;
/// Ends the name of a path of another body than the service's: bodies may share points.
std::string mark_of_body(const ServedWorld& world, const Problem& problem) {
  if (world.is_own(problem.robot, problem.clearance)) return {};
  const std::string body = fmt::format("{} {}", robot_text(problem.robot), problem.clearance);
  return fmt::format("-{:016x}", checksum(std::as_bytes(std::span(body))));
}

constexpr std::size_t of_an_entry = 256;  // bytes of a kept tile beside its own

std::string tile_name(const TilePlace& tile) { return fmt::format("{}/{}/{}", tile.zoom, tile.x, tile.y); }

HttpResponse not_modified(std::string tag) {
  return {.status = 304, .fields = {{"ETag", std::move(tag)}, {"Cache-Control", "no-cache"}}};
}

HttpError scene_too_large() { return {413, "scene_too_large", "path", "this scene is more than 64 MiB of text"}; }

/// A client asks anew and is told whether it has changed.
HttpResponse tagged_response(const HttpRequest& request, const std::string& tag, std::string_view type,
                             std::string_view bytes) {
  if (request.if_none_match == tag) return not_modified(tag);
  return {
      .type = std::string(type), .body = std::string(bytes), .fields = {{"ETag", tag}, {"Cache-Control", "no-cache"}}};
}

/// The address names the world but not its roadmap.
HttpResponse layer_response(const HttpRequest& request, const std::string& bytes) {
  const std::string tag = fmt::format("\"{:016x}\"", checksum(std::as_bytes(std::span(bytes))));
  return tagged_response(request, tag, "image/png", bytes);
}

bool is_update(const HttpRequest& request) { return request.path == "/api/update" && request.method == "POST"; }

/// Takes the same time for any wrong guess of the right length.
bool is_same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differing |= static_cast<unsigned char>(a[i] ^ b[i]);
  return differing == 0;
}

/// Paths that were found, kept by name, and what is asked about them (docs/service.md): their points, the room around
/// the body along them, the body's sweep. Any number of threads may ask.
class PathService {
 public:
  PathService(const ServedWorld& world, const ServiceLimits& limits)
      : world_(world), most_view_points_(limits.most_view_points), paths_(limits.path_bytes) {}

  /// The answer has a path. Throws Stopped.
  void keep(const std::string& name, Answer answer, const Execution& execution) {
    KeptPath kept;
    const bool is_driven = !answer.states.empty() && answer.problem.robot.kind == RobotKind::car;
    kept.curve = KeptCurve(is_driven ? curve_of(answer, execution) : std::move(answer.path), execution);
    kept.way.states = std::move(answer.states);
    kept.way.problem.robot = std::move(answer.problem.robot);
    kept.way.length = answer.length;
    kept.way.min_clearance = answer.min_clearance;
    const std::size_t bytes = kept.curve.bytes() + kept.way.states.numbers.size() * sizeof(double) + sizeof(KeptPath);
    paths_.put(name, std::move(kept), bytes);
  }
  /// Of a path by its name, at Place::path, clearance or sweep. Throws HttpError, UsageError, Stopped.
  HttpResponse answer(const Route& route, const HttpRequest& request, const Execution& execution) {
    const auto kept = paths_.find(route.name);
    if (!kept) {
      throw HttpError(404, "not_found", "path",
                      "no path of this name is kept, or none any more; POST its question to /api/query again, and the "
                      "field Warren-Path of the answer names it");
    }
    if (route.place == Place::clearance) return clearance(*kept, request, execution);
    if (route.place == Place::sweep) return sweep(*kept, request, execution);
    return told(*kept, request, execution);
  }
  std::size_t bytes() const { return paths_.bytes(); }

 private:
  struct KeptPath {
    Answer way;  // states, body, length and clearance alone
    KeptCurve curve;
  };
  /// What of a path is seen: everything where the request doesn't say.
  PathView view_of(const HttpRequest& request) const {
    constexpr double everything = std::numeric_limits<double>::infinity();
    PathView view{.box = {{-everything, -everything}, {everything, everything}}};
    if (const auto box = numbers_parameter(request, "bbox", 4))
      view.box = {{(*box)[0], (*box)[1]}, {(*box)[2], (*box)[3]}};
    if (const auto zoom = numbers_parameter(request, "z", 1)) {
      const TileGrid& grid = world_.tiles().grid();
      constexpr double farthest = -8.0;
      view.pixel = std::ldexp(grid.pixel(0), -static_cast<int>(std::clamp((*zoom)[0], farthest, grid.levels - 1.0)));
    }
    return view;
  }
  HttpResponse told(const KeptPath& kept, const HttpRequest& request, const Execution& execution) const {
    constexpr std::size_t bytes_a_point = 96;  // of text that doubles, and of the answer
    PathView view = view_of(request);
    view.most_points = most_view_points_;
    const std::vector<std::vector<Vec2>> chains = seen_of(kept.curve, view, execution);
    std::size_t points = 0;
    for (const std::vector<Vec2>& chain : chains) points += chain.size();
    execution.reserve(points * bytes_a_point);
    return {.body = json_object("length", kept.way.length, "points", std::uint64_t{kept.curve.size()}, "chains",
                                JsonText{json_chains(chains, execution)}) +
                    "\n"};
  }
  HttpResponse clearance(const KeptPath& kept, const HttpRequest& request, const Execution& execution) const {
    const std::size_t count = sample_count(request);
    Answer way = kept.way;
    if (way.states.empty()) way.path = kept.curve.whole(execution);
    std::optional<EdgeJudge> other;
    if (!world_.is_own(way.problem.robot, world_.clearance())) {
      other.emplace(world_.barred(execution), world_.box(), way.problem.robot, world_.clearance());
    }
    const auto place_told = [&](const PathPlace& place) {
      execution.check();
      const double clearance = world_.clearance_at(place.state.used(), execution, other ? &*other : nullptr);
      return json_object("along", place.along, "at", numbers_json(place.state.used()), "clearance", clearance);
    };
    const JsonText places{json_list_of(places_along(way, count, execution), ",", place_told)};  // infinity is null
    return {.body = json_object("length", kept.way.length, "min_clearance", kept.way.min_clearance, "places", places) +
                    "\n"};
  }
  HttpResponse sweep(const KeptPath& kept, const HttpRequest& request, const Execution& execution) const {
    const SweptBodies bodies = swept_bodies(kept.way, kept.curve, view_of(request), execution);
    JsonObject json;
    add_outline(json, kept.way.problem.robot);
    const auto place_told = [](const PathState& at) { return json_list(at.used()); };
    json.add("apart", bodies.apart, "places", JsonText{json_list_of(bodies.places, ",", place_told)});
    return {.body = json.closed() + "\n"};
  }

  const ServedWorld& world_;
  const std::size_t most_view_points_;
  KeptValues<KeptPath> paths_;
};

class AnsweringService : public HttpService {
 public:
  /// Refers to the world, and to what is kept for it and its followers; nullptr: nothing is.
  AnsweringService(const ServedWorld& world, const ServiceLimits& limits, LatestWays* kept)
      : world_(world),
        kept_(kept),
        limits_(limits),
        layers_(world),
        world_json_(description_json(world, world.body_asked({}, {}), layers_, limits, Execution())),
        tiles_(limits.tile_bytes),
        paths_(world, limits) {}

  std::size_t most_body(const HttpRequest& head) const override {
    const Route asked = route(head);
    if (asked.place == Place::file) file(head, asked.name);  // or there is none
    if ((asked.place == Place::layer || asked.place == Place::legend) && layers_.account_of(asked.name) == nullptr) {
      throw HttpError(404, "not_found", "path", "there is no layer of this name; /api/world lists them");
    }
    if (asked.place == Place::update) {
      throw HttpError(403, "read_only", "path", "this world is not to be changed; 'serve --writable' lets it");
    }
    if (asked.place == Place::batch || is_of_graphs(asked.place)) return limits_.batch_body;
    return asked.place == Place::query ? limits_.small_body : 0;
  }
  void prepare(const SignalFlag& gone) override {
    const Deadline deadline(std::numeric_limits<double>::infinity(), limits_.memory_bytes, &gone);
    world_.prepare({.threads = limits_.threads, .deadline = &deadline});
  }
  std::optional<HttpResponse> at_once(const HttpRequest& request, const HttpFigures& figures) override {
    const Route asked = route(request);
    switch (asked.place) {
      case Place::file:
        return file(request, asked.name);
      case Place::health:
        return HttpResponse{.body = "{\"status\":\"ok\"}\n"};
      case Place::metrics:
        return HttpResponse{.type = "text/plain; version=0.0.4",
                            .body = metrics_text(figures, tiles_.bytes(), paths_.bytes())};
      case Place::progress:
        return progress(request);
      case Place::world:
        return request.query.empty() ? std::optional(HttpResponse{.body = world_json_}) : std::nullopt;
      case Place::tile: {
        if (request.if_none_match == tile_tag()) return not_modified(tile_tag());
        const auto known = tiles_.find(tile_name(asked.tile));
        return known ? std::optional(tile_response(asked, *known)) : std::nullopt;
      }
      case Place::layer: {
        const auto known = tiles_.find(layer_name(request, asked));
        return known ? std::optional(layer_response(request, *known)) : std::nullopt;
      }
      default:
        return std::nullopt;
    }
  }
  HttpResponse work(const HttpRequest& request, const SignalFlag& gone) override {
    const Route asked = route(request);
    if (asked.place == Place::query) return query(request, gone);
    const Deadline deadline(limits_.budget_s, limits_.memory_bytes, &gone);
    const Execution execution{.threads = limits_.threads, .deadline = &deadline};
    execution.check();
    if (asked.place == Place::tile) return tile(asked, execution);
    if (asked.place == Place::layer) return layer(request, asked, execution);
    if (asked.place == Place::legend) {
      return {.body = layers_.legend(asked.name, numbers_parameter(request, "from", 2), execution) + "\n"};
    }
    if (asked.place == Place::batch) return batch(request, execution);
    if (asked.place == Place::scene) return scene(request, execution);
    if (asked.place == Place::world)
      return {.body = description_json(world_, body_in(request), layers_, limits_, execution)};
    if (is_of_graphs(asked.place)) return answer_of_graphs(world_, asked.place, request.body, execution);
    return paths_.answer(asked, request, execution);
  }

 private:
  Route route(const HttpRequest& request) const { return route_of(request, world_.tiles().grid(), world_.hash()); }
  Question body_in(const HttpRequest& request) const {
    std::optional<RobotSpec> robot;
    if (const auto text = parameter(request, "robot")) robot = robot_value("robot", *text);
    const auto clearance = numbers_parameter(request, "clearance", 1);
    return world_.body_asked(robot, clearance ? std::optional((*clearance)[0]) : std::nullopt);
  }
  HttpResponse file(const HttpRequest& request, const std::string& name) const {
    const auto found = served_file(name);
    if (!found) throw HttpError(404, "not_found", "path", "there is nothing at this address");
    return tagged_response(request, fmt::format("\"{}\"", found->tag), found->type, found->bytes);
  }
  std::string layer_name(const HttpRequest& request, const Route& route) const {
    const std::string name = route.name + "/" + tile_name(route.tile);
    const LayerAccount* const layer = layers_.account_of(route.name);
    if (layer == nullptr || !layer->is_of_start) return name;
    return fmt::format("{}?{}", name,
                       fmt::join(numbers_parameter(request, "from", 2).value_or(std::vector<double>()), ","));
  }
  std::string tile_tag() const { return fmt::format("\"{}-{}\"", world_.hash(), tile_style); }
  HttpResponse tile_response(const Route& route, std::string bytes) const {
    return {.type = "image/png",
            .body = std::move(bytes),
            .fields = {{"ETag", tile_tag()},
                       {"Cache-Control", route.has_its_hash ? "public, max-age=31536000, immutable" : "no-cache"}}};
  }
  HttpResponse tile(const Route& route, const Execution& execution) {
    std::string bytes = world_.tiles().draw(route.tile, execution);
    tiles_.put(tile_name(route.tile), bytes, bytes.size() + of_an_entry);
    return tile_response(route, std::move(bytes));
  }
  HttpResponse layer(const HttpRequest& request, const Route& route, const Execution& execution) {
    const std::string bytes = layers_.draw(route.name, route.tile, numbers_parameter(request, "from", 2), execution);
    tiles_.put(layer_name(request, route), bytes, bytes.size() + of_an_entry);
    return layer_response(request, bytes);
  }
  HttpResponse query(const HttpRequest& request, const SignalFlag& gone) {
    const QueryBody body = read_query_body(request.body);
    const double budget_s = std::min(limits_.budget_s, body.question.budget_s.value_or(limits_.budget_s));
    const Deadline deadline(budget_s, limits_.memory_bytes, &gone);
    Execution execution{.threads = limits_.threads, .deadline = &deadline};
    execution.check();
    std::string name;
    RunningQuestions::Entry entry(running_, body.watch);
    ByProducts made;
    const std::function<bool(const Improvement&)> tell = [&](const Improvement& better) {
      std::vector<Vec2> way;
      if (!made.improved.empty()) {
        const auto newest = made.improved[made.improved.size() - 1];
        way.assign(newest.begin(), newest.end());
      }
      entry.tell(better, std::move(way));
      return true;
    };
    const bool is_seen = entry.is_seen() && body.question.planner && gets_better(*body.question.planner);
    if (is_seen) execution.on_improvement = &tell;
    Answer answer = world_.ask(
        body.question, execution, [&](const Answer& found) { name = path_hash(found, execution); },
        is_seen ? &made : nullptr, kept_);
    if (answer.outcome == Outcome::stopped) throw Stopped(answer.stop_reason.value_or(StopReason::time));
    const Deadline unhurried(std::numeric_limits<double>::infinity(), limits_.memory_bytes, &gone);
    if (answer.stop_reason) execution.deadline = &unhurried;  // what gets better has used the time up
    HttpResponse response;
    if (answer.verified) {
      if (name.empty()) name = path_hash(answer, execution);
      answer.tells_path = body.tells_path && path_points(answer) <= limits_.most_points;
      if (!answer.tells_path) answer.handed = HandedPath{path_points(answer), name};
      name += mark_of_body(world_, answer.problem);
      response.fields.emplace_back("Warren-Path", name);
    }
    write_answer_json(answer, execution, [&](std::string_view piece) { response.body += piece; });
    if (answer.verified) paths_.keep(name, std::move(answer), execution);
    return response;
  }
  HttpResponse progress(const HttpRequest& request) const {
    constexpr double most = 1e15;
    const double from = numbers_parameter(request, "from", 1).value_or(std::vector{0.0})[0];
    if (!(from >= 0.0 && from < most)) throw HttpError(400, "bad_request", "query", "from: expected a count");
    return {.body = running_.told(parameter(request, "watch").value_or(""), static_cast<std::uint64_t>(from)) + "\n"};
  }
  HttpResponse batch(const HttpRequest& request, const Execution& execution) const {
    if (world_.query() == nullptr) {
      throw HttpError(400, "no_roadmap", "",
                      "many questions are for roadmaps; serve what 'warren build' makes of this world");
    }
    if (nesting_of(request.body) > deepest_json) {
      throw HttpError(400, "bad_request", "body", "JSON that is nested at most 8 deep is expected");
    }
    const BatchOptions options{.how = {.optimise = flag_parameter(request, "optimise")},
                               .lengths_only = flag_parameter(request, "lengths_only")};
    const InputFile questions = InputFile::of_bytes("body", request.body);
    HttpResponse response{.type = "application/x-ndjson"};
    ask_batch(*world_.query(), questions, options, execution, [&](std::string_view piece) {
      response.body += piece;
      if (response.body.size() <= limits_.batch_answers) return;
      throw HttpError(413, "answers_too_large", "body",
                      "the answers are more than 32 MiB; ask fewer questions, or lengths_only=1");
    });
    return response;
  }
  HttpResponse scene(const HttpRequest& request, const Execution& execution) const {
    constexpr std::string_view shortest = "wall 1 1 1 2\n";
    if (world_.outline().map) throw UsageError("this world is the cells of a map, which no scene holds");
    const Question body = body_in(request);
    const std::size_t walls = world_.wall_count(execution);
    if (walls > limits_.scene_bytes / shortest.size()) throw scene_too_large();
    execution.reserve(walls * sizeof(Segment));
    Scene told = world_.copy_of_whole(execution);
    told.robot = body.robot;
    told.clearance = body.clearance;
    const std::size_t numbers = state_size(*body.robot);
    if (auto start = numbers_parameter(request, "start", numbers)) told.start = std::move(*start);
    const bool any_heading = std::ranges::count(parameter(request, "goal").value_or(""), ',') == 1;
    if (auto goal = numbers_parameter(request, "goal", any_heading ? 2 : numbers)) {
      told.goal = std::move(*goal);
      told.other_goals.clear();
    }
    add_prices(told.prices, world_.query() != nullptr ? world_.query()->roadmap().prices : body.prices);
    Question{.start = told.start, .goal = told.goal}.validate();
    HttpResponse response{.type = "text/plain; charset=utf-8",
                          .fields = {{"Content-Disposition", "attachment; filename=\"world.scene\""}}};
    write_scene_text(
        told,
        [&](std::string_view piece) {
          response.body += piece;
          if (response.body.size() <= limits_.scene_bytes) return;
          throw scene_too_large();
        },
        execution);
    return response;
  }

  const ServedWorld& world_;
  LatestWays* const kept_;
  const ServiceLimits limits_;
  WorldLayers layers_;
  const std::string world_json_;
  KeptValues<std::string> tiles_;
  PathService paths_;
  RunningQuestions running_;
};

class WritableService : public HttpService {
 public:
  WritableService(std::unique_ptr<ServedWorld> world, const ServiceLimits& limits, std::string token)
      : limits_(limits), token_(std::move(token)) {
    versions_.put("", std::make_unique<Version>(std::move(world), limits, limits.writable ? &kept_ : nullptr), 0);
  }

  std::size_t most_body(const HttpRequest& head) const override {
    if (!limits_.writable || !is_update(head)) return (*now())->service.most_body(head);
    check_token(head);
    return limits_.batch_body;
  }
  std::optional<HttpResponse> at_once(const HttpRequest& request, const HttpFigures& figures) override {
    if (is_update(request)) return std::nullopt;
    return (*now())->service.at_once(request, figures);
  }
  HttpResponse work(const HttpRequest& request, const SignalFlag& gone) override {
    if (!is_update(request)) return (*now())->service.work(request, gone);
    check_token(request);
    const Deadline deadline(limits_.budget_s, limits_.memory_bytes, &gone);
    const Execution execution{.threads = limits_.threads, .deadline = &deadline};
    const SceneChange wanted = read_scene_change(request.body, execution);
    HttpResponse said;
    if (changing_.unless_busy([&] { said = change(wanted, execution); })) return said;
    return busy_response("somebody else changes the world now; try again");
  }
  void prepare(const SignalFlag& gone) override { (*now())->service.prepare(gone); }

 private:
  struct Version {
    Version(std::unique_ptr<ServedWorld> its_world, const ServiceLimits& limits, LatestWays* kept)
        : world(std::move(its_world)), service(*world, limits, kept) {}
    std::unique_ptr<ServedWorld> world;
    AnsweringService service;
  };
  using Versions = KeptValues<std::unique_ptr<Version>>;  // the current one is kept; the others are leased

  Versions::Lease now() const { return versions_.find(""); }
  void check_token(const HttpRequest& request) const {
    if (token_.empty() || is_same_secret(request.authorization, "Bearer " + token_)) return;
    throw HttpError(request.authorization.empty() ? 401 : 403, "token", "Authorization",
                    "who changes this world must send 'Bearer TOKEN', the token that the service was started with");
  }
  HttpResponse change(const SceneChange& wanted, const Execution& execution) {
    const Versions::Lease held = now();
    const ServedWorld& before = *(*held)->world;
    if (const std::string_view why = before.why_fixed(); !why.empty()) throw UsageError(std::string(why));
    const Scene& scene = before.whole(execution);
    if (scene.maze) maze_ = scene.maze;
    ChangedScene made = changed(scene, wanted, maze_, execution);
    auto next = std::make_unique<Version>(before.changed(std::move(made.scene), execution), limits_, &kept_);
    JsonObject json;
    json.add("schema", "warren.change/1", "before", before.hash(), "hash", next->world->hash());
    tell_change(json, made);
    execution.check();
    versions_.put("", std::move(next), 0);
    return {.body = json.closed() + "\n"};
  }

  const ServiceLimits limits_;
  const std::string token_;
  std::optional<MazeHint> maze_;  // what the walls were of; of whoever changes the world
  LatestWays kept_;
  mutable Versions versions_{1};
  OneAtATime changing_;
};

}  // namespace

HttpResponse answer_of_graphs(const ServedWorld& world, Place place, std::string_view body,
                              const Execution& execution) {
  if (place == Place::check) {
    return {.body = verdicts_json(judge_of(world, execution).judge(read_drawn_edges(body, execution), execution))};
  }
  const bool is_saved = place == Place::save_graph;
  const RouteGraph graph = is_saved                     ? read_graph_json(body, execution)
                           : place == Place::open_graph ? read_nav2_graph(body, execution)
                                                        : asked_graph(world, body, execution);
  if (!is_saved) judge_of(world, execution);  // or there are no such graphs
  const std::vector<RouteEnds> ends = ends_of(graph);
  const std::vector<EdgeVerdict> verdicts = judge_of(world, execution).judge(edges_of(graph, ends), execution);
  if (!is_saved) return {.body = graph_json(graph, verdicts, execution)};
  refuse_blocked(graph, verdicts);
  return {.type = "application/geo+json", .body = nav2_graph_text(graph, ends, execution)};
}

std::unique_ptr<HttpService> world_service(const ServedWorld& world, const ServiceLimits& limits) {
  return std::make_unique<AnsweringService>(world, limits, nullptr);
}

std::unique_ptr<HttpService> writable_service(std::unique_ptr<ServedWorld> world, const ServiceLimits& limits,
                                              std::string token) {
  return std::make_unique<WritableService>(std::move(world), limits, std::move(token));
}

}  // namespace warren::serve
