// SPDX-License-Identifier: BSD-3-Clause
// The interface of `warren serve` (docs/service.md): page, tiles, questions and paths of one world, as a service that
// any server of HTTP may ask.
#pragma once

#include <memory>
#include <string>

#include "parallel/execution.hpp"
#include "serve/api/graph_service.hpp"
#include "serve/api/path_service.hpp"
#include "serve/api/route.hpp"
#include "serve/api/served_world.hpp"
#include "serve/api/service_limits.hpp"
#include "serve/api/world_layers.hpp"
#include "serve/http/http_service.hpp"
#include "serve/http/kept_values.hpp"

namespace warren::serve {

class WorldService : public HttpService {
 public:
  /// Refers to the world.
  WorldService(const ServedWorld& world, const ServiceLimits& limits);

  std::size_t most_body(const HttpRequest& head) const override;
  std::optional<HttpResponse> at_once(const HttpRequest& request, const HttpFigures& figures) override;
  HttpResponse work(const HttpRequest& request, const SignalFlag& gone) override;
  void prepare(const SignalFlag& gone) override;

 private:
  Route route(const HttpRequest& request) const;
  HttpResponse file(const HttpRequest& request, const std::string& name) const;
  HttpResponse tile(const Route& route, const Execution& execution);
  HttpResponse layer(const HttpRequest& request, const Route& route, const Execution& execution);
  HttpResponse query(const HttpRequest& request, const SignalFlag& gone);
  HttpResponse batch(const HttpRequest& request, const Execution& execution) const;
  HttpResponse scene(const HttpRequest& request, const Execution& execution) const;
  HttpResponse metrics(const HttpFigures& figures) const;
  std::string layer_name(const HttpRequest& request, const Route& route) const;
  std::string tile_tag() const;
  HttpResponse tile_response(const Route& route, std::string bytes) const;

  const ServedWorld& world_;
  const ServiceLimits limits_;
  WorldLayers layers_;
  const std::string world_json_;
  const GraphService graphs_;
  KeptValues<std::string> tiles_;
  PathService paths_;
};

}  // namespace warren::serve
