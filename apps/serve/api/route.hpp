// SPDX-License-Identifier: BSD-3-Clause
// Which of a service's places a request is for.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/serve/http/http_message.hpp"
#include "apps/serve/tiles/web_tile.hpp"

namespace warren::serve {

enum class Place : std::uint8_t {
  graph,
  open_graph,
  save_graph,
  check,
  health,
  metrics,
  world,
  query,
  batch,
  progress,
  scene,
  update,
  path,
  clearance,
  sweep,
  file,
  tile,
  layer,
  legend
};
/// Of those below api/, but for a path's own name; the last ones have other addresses.
constexpr auto enum_names(Place) {
  return std::array<std::string_view, 15>{"graph",   "graph/open", "graph/save", "check",          "health",
                                          "metrics", "world",      "query",      "query/batch",    "progress",
                                          "scene",   "update",     "path",       "path/clearance", "path/sweep"};
}

struct Route {
  Place place;
  std::string name = {};  ///< of a file, of a path, of a layer
  TilePlace tile = {};
  bool has_its_hash = false;  ///< a tile's address names its world, so what it shows never changes
};

/// Is it a question about a route graph?
bool is_of_graphs(Place place);

/// hash: of the world. Throws HttpError: 404 for a path that is none, 405 for the wrong method.
Route route_of(const HttpRequest& request, const TileGrid& grid, std::string_view hash);

/// A parameter of the query; nothing where it is missing. Throws HttpError where it is there twice.
std::optional<std::string> parameter(const HttpRequest& request, std::string_view name);
/// The same as numbers apart by commas. Throws HttpError where they are others than so many finite ones.
std::optional<std::vector<double>> numbers_parameter(const HttpRequest& request, std::string_view name,
                                                     std::size_t count);
/// Is it 1, or else missing or 0? Throws HttpError.
bool flag_parameter(const HttpRequest& request, std::string_view name);

}  // namespace warren::serve
