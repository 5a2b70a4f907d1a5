// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/path_service.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "scenes/text/json_text.hpp"
#include "serve/api/path_places.hpp"
#include "serve/api/swept_bodies.hpp"

namespace warren::serve {
namespace {

/// Of a profile.
std::size_t sample_count(const HttpRequest& request) {
  constexpr double most = 2000.0;
  const double count = numbers_parameter(request, "samples", 1).value_or(std::vector{200.0})[0];
  if (count >= 2.0 && count <= most && count == std::floor(count)) return static_cast<std::size_t>(count);
  throw HttpError(400, "bad_request", "query", "samples: expected a whole number, 2 to 2000");
}

}  // namespace

void PathService::keep(const std::string& name, Answer answer, const Execution& execution) {
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

HttpResponse PathService::answer(const Route& route, const HttpRequest& request, const Execution& execution) {
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

/// What of a path is seen: everything where the request doesn't say.
PathView PathService::view_of(const HttpRequest& request) const {
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

HttpResponse PathService::told(const KeptPath& kept, const HttpRequest& request, const Execution& execution) const {
  constexpr std::size_t bytes_a_point = 96;  // of text that doubles, and of the answer
  PathView view = view_of(request);
  view.most_points = most_view_points_;
  const std::vector<std::vector<Vec2>> chains = seen_of(kept.curve, view, execution);
  std::size_t points = 0;
  for (const std::vector<Vec2>& chain : chains) points += chain.size();
  execution.reserve(points * bytes_a_point);
  std::string text = "[";
  for (const std::vector<Vec2>& chain : chains) {
    execution.check();
    text += text.size() > 1 ? ",[" : "[";
    for (const Vec2 p : chain) {
      if (text.back() == ']') text += ',';
      append_json_list(text, std::array{p.x, p.y});
    }
    text += ']';
  }
  JsonObject json;
  json.add("length", kept.way.length);
  json.add("points", std::uint64_t{kept.curve.size()});
  json.add_json("chains", text + "]");
  return {.body = json.closed() + "\n"};
}

HttpResponse PathService::clearance(const KeptPath& kept, const HttpRequest& request,
                                    const Execution& execution) const {
  const std::size_t count = sample_count(request);
  Answer way = kept.way;
  if (way.states.empty()) way.path = kept.curve.whole(execution);
  std::string text;
  for (const PathPlace& place : places_along(way, count, execution)) {
    execution.check();
    const double clearance = world_.clearance_at(place.state.used(), execution);
    JsonObject told;
    told.add("along", place.along);
    told.add_json("at", json_list(place.state.used()));
    told.add_or_null("clearance", std::isfinite(clearance), clearance);
    text += (text.empty() ? "" : ",") + told.closed();
  }
  JsonObject json;
  json.add("length", kept.way.length);
  json.add_or_null("min_clearance", std::isfinite(kept.way.min_clearance), kept.way.min_clearance);
  json.add_json("places", "[" + text + "]");
  return {.body = json.closed() + "\n"};
}

HttpResponse PathService::sweep(const KeptPath& kept, const HttpRequest& request, const Execution& execution) const {
  const SweptBodies bodies = swept_bodies(kept.way, kept.curve, view_of(request), execution);
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

}  // namespace warren::serve
