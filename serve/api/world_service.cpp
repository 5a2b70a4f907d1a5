// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/world_service.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "core/base/error.hpp"
#include "roadmaps/file/checksum.hpp"
#include "scenes/formats/scene_io.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/json_text.hpp"
#include "serve/api/query_body_io.hpp"
#include "serve/api/world_description.hpp"
#include "serve/page/served_files.hpp"
#include "solve/answer/path_hash.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/batches/ask_batch_io.hpp"

namespace warren::serve {
namespace {

/// Changes whenever tiles of a world look otherwise than before.
constexpr int tile_style = 1;
constexpr std::size_t of_an_entry = 256;  // bytes of a kept tile beside its own

std::string tile_name(const TilePlace& tile) { return fmt::format("{}/{}/{}", tile.zoom, tile.x, tile.y); }

HttpResponse not_modified(std::string tag) {
  return {.status = 304, .fields = {{"ETag", std::move(tag)}, {"Cache-Control", "no-cache"}}};
}

HttpError scene_too_large() { return {413, "scene_too_large", "path", "this scene is more than 64 MiB of text"}; }

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
      paths_(world, limits) {}

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

HttpResponse WorldService::work(const HttpRequest& request, const SignalFlag& gone) {
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
  if (is_of_graphs(asked.place)) return graphs_.answer(asked.place, request.body, execution);
  return paths_.answer(asked, request, execution);
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

std::string WorldService::layer_name(const HttpRequest& request, const Route& route) const {
  const std::string name = route.name + "/" + tile_name(route.tile);
  if (!layers_.is_of_start(route.name)) return name;
  return fmt::format("{}?{}", name,
                     fmt::join(numbers_parameter(request, "from", 2).value_or(std::vector<double>()), ","));
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
  const std::string bytes = layers_.draw(route.name, route.tile, numbers_parameter(request, "from", 2), execution);
  tiles_.put(layer_name(request, route), bytes, bytes.size() + of_an_entry);
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
  if (answer.verified) paths_.keep(name, std::move(answer), execution);
  return response;
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

HttpResponse WorldService::scene(const HttpRequest& request, const Execution& execution) const {
  constexpr std::string_view shortest = "wall 1 1 1 2\n";
  if (world_.outline().map) throw UsageError("this world is the cells of a map, which no scene holds");
  const std::size_t walls = world_.wall_count(execution);
  if (walls > limits_.scene_bytes / shortest.size()) throw scene_too_large();
  execution.reserve(walls * sizeof(Segment));
  Scene told = world_.copy_of_whole(execution);
  told.robot = world_.robot();
  told.clearance = world_.clearance();
  const std::size_t numbers = state_size(world_.robot());
  if (auto start = numbers_parameter(request, "start", numbers)) told.start = std::move(*start);
  const bool any_heading = std::ranges::count(parameter(request, "goal").value_or(""), ',') == 1;
  if (auto goal = numbers_parameter(request, "goal", any_heading ? 2 : numbers)) told.goal = std::move(*goal);
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

HttpResponse WorldService::metrics(const HttpFigures& figures) const {
  return {.type = "text/plain; version=0.0.4",
          .body = metrics_text(figures, {.tile_bytes = tiles_.bytes(), .path_bytes = paths_.bytes()})};
}

}  // namespace warren::serve
