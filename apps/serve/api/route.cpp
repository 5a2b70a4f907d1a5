// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/world_service.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/enum_names.hpp"
#include "core/base/printable.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren::serve {
namespace {

[[noreturn]] void refuse_path() { throw HttpError(404, "not_found", "path", "there is nothing at this address"); }

Route api_route(const std::vector<std::string_view>& words) {
  const bool is_path = words.size() > 3 && words[2] == "path" && !words[3].empty();
  std::string name(words[2]);
  for (std::size_t i = is_path ? 4 : 3; i < words.size(); ++i) name.append("/").append(words[i]);
  const auto place = enum_named<Place>(name);
  if (!place || is_path != name.starts_with("path")) refuse_path();
  return {.place = *place, .name = is_path ? std::string(words[3]) : std::string()};
}

Route place_of(std::string_view path, const TileGrid& grid, std::string_view hash) {
  std::vector<std::string_view> words = split(path, "/");  // the first one is empty
  if (words.size() == 2) return {.place = Place::file, .name = std::string(words[1].empty() ? "index.html" : words[1])};
  if (words[1] == "api") return api_route(words);
  const bool has_hash = words.size() > 4 && words[1] == "v" && words[2] == hash;
  if (has_hash) words.erase(words.begin() + 1, words.begin() + 3);
  const bool is_of_layers = has_hash && words[1] == "layers";
  if (is_of_layers && words.size() == 4 && words[3] == "legend") {
    return {.place = Place::legend, .name = std::string(words[2])};
  }
  constexpr std::string_view ending = ".png";
  const std::size_t of_tile = is_of_layers ? 3 : 2;  // zoom, column, row.png
  if (words.size() != of_tile + 3 || !(is_of_layers || words[1] == "tiles")) refuse_path();
  if (!words.back().ends_with(ending)) refuse_path();
  words.back().remove_suffix(ending.size());
  const auto tile = grid.tile_at(words[of_tile], words[of_tile + 1], words.back());
  if (!tile) refuse_path();
  if (is_of_layers) return {.place = Place::layer, .name = std::string(words[2]), .tile = *tile};
  return {.place = Place::tile, .tile = *tile, .has_its_hash = has_hash};
}

}  // namespace

bool is_of_graphs(Place place) { return place <= Place::check; }

Route route_of(const HttpRequest& request, const TileGrid& grid, std::string_view hash) {
  Route route = place_of(request.path, grid, hash);
  const bool is_post = request.method == "POST";
  const bool wants_post = route.place == Place::query || route.place == Place::batch || route.place == Place::update ||
                          is_of_graphs(route.place);
  if (is_post != wants_post) {
    throw HttpError(405, "method_not_allowed", "method", is_post ? "GET is expected" : "POST is expected");
  }
  return route;
}

std::optional<std::string> parameter(const HttpRequest& request, std::string_view name) {
  std::optional<std::string> found;
  for (const auto& [key, value] : request.query) {
    if (key != name) continue;
    if (found) throw HttpError(400, "bad_request", "query", fmt::format("{}: expected once", name));
    found = value;
  }
  return found;
}

std::optional<std::vector<double>> numbers_parameter(const HttpRequest& request, std::string_view name,
                                                     std::size_t count) {
  const auto text = parameter(request, name);
  if (!text) return std::nullopt;
  std::vector<double> numbers;
  const std::vector<std::string_view> words = split(*text, ",");
  for (const std::string_view word : words) {
    const auto number = scene_text::number_in_full<double>(word);
    if (number && std::isfinite(*number)) numbers.push_back(*number);
  }
  if (numbers.size() == count && words.size() == count) return numbers;
  throw HttpError(400, "bad_request", "query", fmt::format("{}: expected {}", name, scene_text::numbers_text(count)));
}

bool flag_parameter(const HttpRequest& request, std::string_view name) {
  const auto text = parameter(request, name);
  if (!text || *text == "0") return false;
  if (*text == "1") return true;
  throw HttpError(400, "bad_request", "query", fmt::format("{}: expected 0 or 1", name));
}

}  // namespace warren::serve
