// SPDX-License-Identifier: BSD-3-Clause
// The interface of `warren serve` (docs/service.md): page, tiles, questions and paths of one world, as a service that
// any server of HTTP may ask.
#pragma once

#include <memory>
#include <string>

#include "parallel/execution.hpp"
#include "serve/api/graph_service.hpp"
#include "serve/api/kept_curve.hpp"
#include "serve/api/path_view.hpp"
#include "serve/api/route.hpp"
#include "serve/api/served_world.hpp"
#include "serve/api/world_layers.hpp"
#include "serve/http/http_service.hpp"
#include "serve/http/kept_values.hpp"

namespace warren {

struct ServiceLimits {
  double budget_s = 10.0;  ///< of each request that is worked on; questions may ask for less
  std::size_t memory_bytes = static_cast<std::size_t>(-1);  ///< that the process may hold
  unsigned threads = 0;                                     ///< of each request
  bool writable = false;                                    ///< does whoever owns the service take changes?
  bool wants_token = false;                                 ///< from those who change
  std::size_t scene_bytes = std::size_t{64} << 20U;         ///< of a scene that is told
  std::size_t tile_bytes = std::size_t{64} << 20U;          ///< of tiles that are kept
  std::size_t path_bytes = std::size_t{1} << 30U;           ///< of paths that are kept; one has half of it at most
  std::size_t most_points = 10'000;                         ///< of a path that an answer lists
  std::size_t most_view_points = 500'000;                   ///< of a path that is told by itself
  std::size_t small_body = std::size_t{64} << 10U;
  std::size_t batch_body = std::size_t{4} << 20U;      ///< of a route graph, too
  std::size_t batch_answers = std::size_t{32} << 20U;  ///< bytes
};

class WorldService : public HttpService {
 public:
  /// Refers to the world.
  WorldService(const ServedWorld& world, const ServiceLimits& limits);

  std::size_t most_body(const HttpRequest& head) const override;
  std::optional<HttpResponse> at_once(const HttpRequest& request, const HttpFigures& figures) override;
  HttpResponse work(const HttpRequest& request, const SignalFlag& gone) override;
  void prepare(const SignalFlag& gone) override;

 private:
  /// A path that was found.
  struct KeptPath {
    Answer way;  // states, body, length and clearance alone
    KeptCurve curve;
  };
  static KeptPath kept(Answer answer, const Execution& execution);
  Route route(const HttpRequest& request) const;
  HttpResponse file(const HttpRequest& request, const std::string& name) const;
  HttpResponse tile(const Route& route, const Execution& execution);
  HttpResponse layer(const HttpRequest& request, const Route& route, const Execution& execution);
  HttpResponse query(const HttpRequest& request, const SignalFlag& gone);
  HttpResponse batch(const HttpRequest& request, const Execution& execution) const;
  HttpResponse scene(const HttpRequest& request, const Execution& execution) const;
  HttpResponse path(const HttpRequest& request, const std::string& name, const Execution& execution);
  HttpResponse clearance(const HttpRequest& request, const std::string& name, const Execution& execution);
  HttpResponse sweep(const HttpRequest& request, const std::string& name, const Execution& execution);
  PathView view_of(const HttpRequest& request) const;
  HttpResponse metrics(const HttpFigures& figures) const;
  std::string tile_tag() const;
  HttpResponse tile_response(const Route& route, std::string bytes) const;

  const ServedWorld& world_;
  const ServiceLimits limits_;
  WorldLayers layers_;
  const std::string world_json_;
  const GraphService graphs_;
  KeptValues<std::string> tiles_;
  KeptValues<KeptPath> paths_;
};

}  // namespace warren
