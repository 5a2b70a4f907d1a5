// SPDX-License-Identifier: BSD-3-Clause
// What a service says of its world and of itself.
#pragma once

#include <string>

#include "serve/api/served_world.hpp"
#include "serve/http/http_service.hpp"

namespace warren::serve {

struct ServiceLimits;
class WorldLayers;

/// warren.service/1: what a page needs to show the world and to ask.
std::string description_json(const ServedWorld& world, const WorldLayers& layers, const ServiceLimits& limits);

/// What is kept.
struct KeptBytes {
  std::size_t tile_bytes = 0;
  std::size_t path_bytes = 0;
};
/// In the text format of Prometheus.
std::string metrics_text(const HttpFigures& figures, const KeptBytes& kept);

}  // namespace warren::serve
