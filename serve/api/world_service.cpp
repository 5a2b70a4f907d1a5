// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/world_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/base/error.hpp"
#include "roadmaps/file/checksum.hpp"
#include "scenes/formats/scene_io.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/json_text.hpp"
#include "serve/api/path_places.hpp"
#include "serve/api/query_body_io.hpp"
#include "serve/api/swept_bodies.hpp"
#include "serve/api/world_description.hpp"
#include "serve/page/served_files.hpp"
#include "solve/answer/path_hash.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/batches/ask_batch_io.hpp"

namespace warren {
namespace {

/// Changes whenever tiles of a world look otherwise than before.
constexpr int tile_style = 1;
constexpr std::size_t of_an_entry = 256;  // bytes of a kept tile beside its own

std::string tile_name(const TilePlace& tile) { return fmt::format("{}/{}/{}", tile.zoom, tile.x, tile.y); }

[[noreturn]] void refuse_forgotten() {
  throw HttpError(404, "not_found", "path", "this path is not kept any more; ask again");
}

/// Of a profile.
std::size_t sample_count(const HttpRequest& request) {
  constexpr double most = 2000.0;
  const double count = numbers_parameter(request, "samples", 1).value_or(std::vector{200.0})[0];
  if (count >= 2.0 && count <= most && count == std::floor(count)) return static_cast<std::size_t>(count);
  throw HttpError(400, "bad_request", "query", "samples: expected a whole number, 2 to 2000");
}

std::string layer_name(const Route& route) { return route.name + "/" + tile_name(route.tile); }

HttpResponse not_modified(std::string tag) {
  return {.status = 304, .fields = {{"ETag", std::move(tag)}, {"Cache-Control", "no-cache"}}};
}

/// The address names the world but not its roadmap, so that a client asks anew and is told whether it has changed.
HttpResponse layer_response(const HttpRequest& request, const std::string& bytes) {
  std::string tag = fmt::format("\"{:016x}\"", checksum(std::as_bytes(std::span(bytes))));
  if (request.if_none_match == tag) return not_modified(std::move(tag));
  return {.type = "image/png", .body = bytes, .fields = {{"ETag", std::move(tag)}, {"Cache-Control", "no-cache"}}};
}

}  // namespace

WorldService::WorldService(const ServedWorld& world, const ServiceLimits& limits)
    : world_(world),
      limits_(limits),
      layers_(world),
      world_json_(description_json(world, layers_, limits)),
      graphs_(world),
      tiles_(limits.tile_bytes),
      paths_(limits.path_bytes) {}

Route WorldService::route(const HttpRequest& request) const {
  return route_of(request, world_.tiles().grid(), world_.hash());
}

std::size_t WorldService::most_body(const HttpRequest& head) const {
  const Route asked = route(head);
  if (asked.place == Place::file) file(head, asked.name);  // or there is none
  if ((asked.place == Place::layer || asked.place == Place::legend) && !layers_.knows(asked.name)) {
    throw HttpError(404, "not_found", "path", "there is no layer of this name; /api/world lists them");
  }
  if (asked.place == Place::update) {
    throw HttpError(403, "read_only", "path", "this world is not to be changed; 'serve --writable' lets it");
  }
  if (asked.place == Place::batch || is_of_graphs(asked.place)) return limits_.batch_body;
  return asked.place == Place::query ? limits_.small_body : 0;
}

void WorldService::prepare(const SignalFlag& gone) {
  const Deadline deadline(std::numeric_limits<double>::infinity(), limits_.memory_bytes, &gone);
  world_.prepare({.threads = limits_.threads, .deadline = &deadline});
}

std::optional<HttpResponse> WorldService::at_once(const HttpRequest& request, const HttpFigures& figures) {
  const Route asked = route(request);
  switch (asked.place) {
    case Place::file:
      return file(request, asked.name);
    case Place::health:
      return HttpResponse{.body = "{\"status\":\"ok\"}\n"};
    case Place::metrics:
      return metrics(figures);
    case Place::world:
      return HttpResponse{.body = world_json_};
    case Place::tile: {
      if (request.if_none_match == tile_tag()) return not_modified(tile_tag());
      std::optional<HttpResponse> known;
      tiles_.look(tile_name(asked.tile), [&](const std::string& bytes) { known = tile_response(asked, bytes); });
      return known;
    }
    case Place::layer: {
      std::optional<HttpResponse> known;
      tiles_.look(layer_name(asked), [&](const std::string& bytes) { known = layer_response(request, bytes); });
      return known;
    }
    default:
      return std::nullopt;
  }
}

HttpResponse WorldService::work(const HttpRequest& request, const SignalFlag& gone) {
  const Route asked = route(request);
  if (asked.place == Place::query) return query(request, gone);
  const Deadline deadline(limits_.budget_s, limits_.memory_bytes, &gone);
  const Execution execution{.threads = limits_.threads, .deadline = &deadline};
  execution.check();
  if (asked.place == Place::tile) return tile(asked, execution);
  if (asked.place == Place::layer) return layer(request, asked, execution);
  if (asked.place == Place::legend) return {.body = layers_.legend(asked.name, execution) + "\n"};
  if (asked.place == Place::batch) return batch(request, execution);
  if (asked.place == Place::scene) return scene(request, execution);
  if (is_of_graphs(asked.place)) return graphs_.answer(asked.place, request.body, execution);
  if (asked.place == Place::clearance) return clearance(request, asked.name, execution);
  if (asked.place == Place::sweep) return sweep(request, asked.name, execution);
  return path(request, asked.name, execution);
}

HttpResponse WorldService::file(const HttpRequest& request, const std::string& name) const {
  const ServedFile* found = served_file(name);
  if (found == nullptr) throw HttpError(404, "not_found", "path", "there is nothing at this address");
  const std::string tag = fmt::format("\"{}\"", found->tag);
  if (request.if_none_match == tag) return not_modified(tag);
  return {.type = std::string(found->type),
          .body = std::string(found->bytes),
          .fields = {{"ETag", tag}, {"Cache-Control", "no-cache"}}};
}

std::string WorldService::tile_tag() const { return fmt::format("\"{}-{}\"", world_.hash(), tile_style); }

HttpResponse WorldService::tile_response(const Route& route, std::string bytes) const {
  return {.type = "image/png",
          .body = std::move(bytes),
          .fields = {{"ETag", tile_tag()},
                     {"Cache-Control", route.has_its_hash ? "public, max-age=31536000, immutable" : "no-cache"}}};
}

HttpResponse WorldService::tile(const Route& route, const Execution& execution) {
  std::string bytes = world_.tiles().draw(route.tile, execution);
  tiles_.put(tile_name(route.tile), bytes, bytes.size() + of_an_entry);
  return tile_response(route, std::move(bytes));
}

HttpResponse WorldService::layer(const HttpRequest& request, const Route& route, const Execution& execution) {
  const std::string bytes = layers_.draw(route.name, route.tile, execution);
  tiles_.put(layer_name(route), bytes, bytes.size() + of_an_entry);
  return layer_response(request, bytes);
}

HttpResponse WorldService::query(const HttpRequest& request, const SignalFlag& gone) {
  const QueryBody body = read_query_body(request.body);
  const double budget_s = std::min(limits_.budget_s, body.question.budget_s.value_or(limits_.budget_s));
  const Deadline deadline(budget_s, limits_.memory_bytes, &gone);
  const Execution execution{.threads = limits_.threads, .deadline = &deadline};
  execution.check();
  std::string name;
  Answer answer =
      world_.ask(body.question, execution, [&](const Answer& found) { name = path_hash(found, execution); });
  if (answer.outcome == Outcome::stopped) throw Stopped(answer.stop_reason.value_or(StopReason::time));
  HttpResponse response;
  if (answer.verified) {
    if (name.empty()) name = path_hash(answer, execution);
    answer.tells_path = body.tells_path && path_points(answer) <= limits_.most_points;
    if (!answer.tells_path) answer.handed = HandedPath{path_points(answer), name};
    response.fields.emplace_back("Warren-Path", name);
  }
  write_answer_json(answer, execution, [&](std::string_view piece) { response.body += piece; });
  if (answer.verified) {
    KeptPath path = kept(std::move(answer), execution);
    const std::size_t bytes = path.curve.bytes() + path.way.states.numbers.size() * sizeof(double);
    paths_.put(name, std::move(path), bytes + sizeof(KeptPath));
  }
  return response;
}

WorldService::KeptPath WorldService::kept(Answer answer, const Execution& execution) {
  KeptPath kept;
  const bool is_driven = !answer.states.empty() && answer.problem.robot.kind == RobotKind::car;
  kept.curve = KeptCurve(is_driven ? curve_of(answer, execution) : std::move(answer.path), execution);
  kept.way.states = std::move(answer.states);
  kept.way.problem.robot = std::move(answer.problem.robot);
  kept.way.length = answer.length;
  kept.way.min_clearance = answer.min_clearance;
  return kept;
}

HttpResponse WorldService::batch(const HttpRequest& request, const Execution& execution) const {
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

/// What of a path is seen: everything where the request doesn't say.
PathView WorldService::view_of(const HttpRequest& request) const {
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

HttpResponse WorldService::path(const HttpRequest& request, const std::string& name, const Execution& execution) {
  const PathView view = view_of(request);
  JsonObject json;
  const bool is_there = paths_.look(name, [&](const KeptPath& kept) {
    std::string text = "[";
    std::size_t points = 0;
    for (const std::vector<Vec2>& chain : seen_of(kept.curve, view, execution)) {
      execution.check();
      points += chain.size();
      if (points > limits_.most_view_points) {
        throw HttpError(413, "path_too_long", "query",
                        "more than 500,000 points; ask for a part of them by bbox and z");
      }
      text += text.size() > 1 ? ",[" : "[";
      for (const Vec2 p : chain) {
        if (text.back() == ']') text += ',';
        append_json_list(text, std::array{p.x, p.y});
      }
      text += ']';
    }
    json.add("length", kept.way.length);
    json.add("points", std::uint64_t{kept.curve.size()});
    json.add_json("chains", text + "]");
  });
  if (!is_there) refuse_forgotten();
  return {.body = json.closed() + "\n"};
}

HttpResponse WorldService::clearance(const HttpRequest& request, const std::string& name, const Execution& execution) {
  JsonObject json;
  std::vector<PathPlace> places;
  const std::size_t count = sample_count(request);
  const bool is_there = paths_.look(name, [&](const KeptPath& kept) {
    Answer way = kept.way;
    if (way.states.empty()) way.path = kept.curve.whole(execution);
    places = places_along(way, count, execution);
    json.add("length", kept.way.length);
    json.add_or_null("min_clearance", std::isfinite(kept.way.min_clearance), kept.way.min_clearance);
  });
  if (!is_there) refuse_forgotten();
  std::string text;
  for (const PathPlace& place : places) {
    execution.check();
    const double clearance = world_.clearance_at(place.state.used(), execution);
    JsonObject told;
    told.add("along", place.along);
    told.add_json("at", json_list(place.state.used()));
    told.add_or_null("clearance", std::isfinite(clearance), clearance);
    text += (text.empty() ? "" : ",") + told.closed();
  }
  json.add_json("places", "[" + text + "]");
  return {.body = json.closed() + "\n"};
}

HttpResponse WorldService::sweep(const HttpRequest& request, const std::string& name, const Execution& execution) {
  const PathView view = view_of(request);
  SweptBodies bodies;
  const bool is_there =
      paths_.look(name, [&](const KeptPath& kept) { bodies = swept_bodies(kept.way, kept.curve, view, execution); });
  if (!is_there) refuse_forgotten();
  std::string outline;
  for (const Vec2 corner : world_.robot().outline) {
    outline += (outline.empty() ? "" : ",") + json_list(std::span<const double>(std::array{corner.x, corner.y}));
  }
  std::string places;
  for (const PathState& place : bodies.places) places += (places.empty() ? "" : ",") + json_list(place.used());
  JsonObject json;
  json.add("radius", world_.robot().outline.empty() ? world_.robot().radius : 0.0);
  json.add_json("outline", "[" + outline + "]");
  json.add("apart", bodies.apart);
  json.add_json("places", "[" + places + "]");
  return {.body = json.closed() + "\n"};
}

HttpResponse WorldService::scene(const HttpRequest& request, const Execution& execution) const {
  const Scene& whole = world_.whole(execution);
  if (whole.map) throw UsageError("this world is the cells of a map, which no scene holds");
  execution.reserve(whole.walls.size() * sizeof(Segment));
  Scene told = whole;
  told.robot = world_.robot();
  told.clearance = world_.clearance();
  const std::size_t numbers = state_size(world_.robot());
  if (auto start = numbers_parameter(request, "start", numbers)) told.start = std::move(*start);
  const bool any_heading = std::ranges::count(parameter(request, "goal").value_or(""), ',') == 1;
  if (auto goal = numbers_parameter(request, "goal", any_heading ? 2 : numbers)) told.goal = std::move(*goal);
  HttpResponse response{.type = "text/plain; charset=utf-8",
                        .fields = {{"Content-Disposition", "attachment; filename=\"world.scene\""}}};
  write_scene_text(
      told,
      [&](std::string_view piece) {
        response.body += piece;
        if (response.body.size() <= limits_.scene_bytes) return;
        throw HttpError(413, "scene_too_large", "path", "this scene is more than 64 MiB of text");
      },
      execution);
  return response;
}

HttpResponse WorldService::metrics(const HttpFigures& figures) const {
  return {.type = "text/plain; version=0.0.4",
          .body = metrics_text(figures, {.tile_bytes = tiles_.bytes(), .path_bytes = paths_.bytes()})};
}

}  // namespace warren
