// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/writable_service.hpp"

#include <utility>

#include "scenes/text/json_text.hpp"
#include "serve/changes/scene_change_io.hpp"

namespace warren::serve {
namespace {

bool is_update(const HttpRequest& request) { return request.path == "/api/update" && request.method == "POST"; }

}  // namespace

bool is_same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differing |= static_cast<unsigned char>(a[i] ^ b[i]);
  return differing == 0;
}

WritableService::WritableService(std::unique_ptr<ServedWorld> world, const ServiceLimits& limits, std::string token)
    : limits_(limits), token_(std::move(token)), current_(std::make_unique<Version>(std::move(world), limits)) {}

std::size_t WritableService::most_body(const HttpRequest& head) const {
  if (!limits_.writable || !is_update(head)) return current_.now()->service.most_body(head);
  check_token(head);
  return limits_.batch_body;
}

std::optional<HttpResponse> WritableService::at_once(const HttpRequest& request, const HttpFigures& figures) {
  if (is_update(request)) return std::nullopt;
  return current_.now()->service.at_once(request, figures);
}

HttpResponse WritableService::work(const HttpRequest& request, const SignalFlag& gone) {
  if (!is_update(request)) return current_.now()->service.work(request, gone);
  check_token(request);
  const Deadline deadline(limits_.budget_s, limits_.memory_bytes, &gone);
  const Execution execution{.threads = limits_.threads, .deadline = &deadline};
  return update(request, execution);
}

void WritableService::prepare(const SignalFlag& gone) { current_.now()->service.prepare(gone); }

void WritableService::check_token(const HttpRequest& request) const {
  if (token_.empty() || is_same_secret(request.authorization, "Bearer " + token_)) return;
  throw HttpError(request.authorization.empty() ? 401 : 403, "token", "Authorization",
                  "who changes this world must send 'Bearer TOKEN', the token that the service was started with");
}

HttpResponse WritableService::update(const HttpRequest& request, const Execution& execution) {
  const SceneChange wanted = read_scene_change(request.body, execution);
  CurrentValue<Version>::Change change(current_);
  if (!change.is_mine()) {
    HttpResponse busy = error_response(503, "busy", "", "somebody else changes the world now; try again");
    busy.fields.emplace_back("Retry-After", "1");
    return busy;
  }
  const auto before = current_.now();
  if (const std::string_view why = before->world->why_fixed(); !why.empty()) throw UsageError(std::string(why));
  const Scene& scene = before->world->whole(execution);
  if (scene.maze) maze_ = scene.maze;
  ChangedScene now = changed(scene, wanted, maze_, execution);
  auto next = std::make_unique<Version>(before->world->changed(std::move(now.scene), execution), limits_);
  JsonObject json;
  json.add("schema", "warren.change/1");
  json.add("before", std::string_view(before->world->hash()));
  json.add("hash", std::string_view(next->world->hash()));
  json.add_json("added", shapes_json(now.made.add));
  json.add_json("removed", shapes_json(now.made.remove));
  execution.check();
  change.replace(std::move(next));
  return {.body = json.closed() + "\n"};
}

}  // namespace warren::serve
