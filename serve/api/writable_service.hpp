// SPDX-License-Identifier: BSD-3-Clause
// A service whose world may be changed while it is asked (docs/service.md): each change makes a new world with a
// service of its own, and requests that have begun go on in the one that they began in. One change at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "serve/api/served_world.hpp"
#include "serve/api/world_service.hpp"
#include "serve/http/current_value.hpp"
#include "serve/http/http_service.hpp"

namespace warren::serve {

/// Takes the same time for any wrong guess of the right length.
bool is_same_secret(std::string_view a, std::string_view b);

class WritableService : public HttpService {
 public:
  /// Changes are refused where limits.writable is false. token: who sends it as `Authorization: Bearer TOKEN` may
  /// change the world; empty: whoever reaches it.
  WritableService(std::unique_ptr<ServedWorld> world, const ServiceLimits& limits, std::string token);

  std::size_t most_body(const HttpRequest& head) const override;
  std::optional<HttpResponse> at_once(const HttpRequest& request, const HttpFigures& figures) override;
  HttpResponse work(const HttpRequest& request, const SignalFlag& gone) override;
  void prepare(const SignalFlag& gone) override;

 private:
  struct Version {
    Version(std::unique_ptr<ServedWorld> its_world, const ServiceLimits& limits)
        : world(std::move(its_world)), service(*world, limits) {}
    std::unique_ptr<ServedWorld> world;
    WorldService service;
  };
  void check_token(const HttpRequest& request) const;
  HttpResponse update(const HttpRequest& request, const Execution& execution);

  const ServiceLimits limits_;
  const std::string token_;
  std::optional<MazeHint> maze_;  // what the walls were of; of whoever changes the world
  mutable CurrentValue<Version> current_;
};

}  // namespace warren::serve
