// SPDX-License-Identifier: BSD-3-Clause
// Paths that were found, kept by name, and what is asked about them (docs/service.md): their points, the room around
// the body along them, the body's sweep.
#pragma once

#include <cstddef>
#include <string>

#include "parallel/execution.hpp"
#include "serve/api/kept_curve.hpp"
#include "serve/api/path_view.hpp"
#include "serve/api/route.hpp"
#include "serve/api/served_world.hpp"
#include "serve/api/service_limits.hpp"
#include "serve/http/http_message.hpp"
#include "serve/http/kept_values.hpp"
#include "solve/answer/answer.hpp"

namespace warren::serve {

/// Any number of threads may ask.
class PathService {
 public:
  /// Refers to the world.
  PathService(const ServedWorld& world, const ServiceLimits& limits)
      : world_(world), most_view_points_(limits.most_view_points), paths_(limits.path_bytes) {}

  /// The answer has a path. Throws Stopped.
  void keep(const std::string& name, Answer answer, const Execution& execution);
  /// Of a path by its name, at Place::path, clearance or sweep. Throws HttpError, UsageError, Stopped.
  HttpResponse answer(const Route& route, const HttpRequest& request, const Execution& execution);
  /// Of all that is kept.
  std::size_t bytes() const { return paths_.bytes(); }

 private:
  struct KeptPath {
    Answer way;  // states, body, length and clearance alone
    KeptCurve curve;
  };
  HttpResponse told(const KeptPath& kept, const HttpRequest& request, const Execution& execution) const;
  HttpResponse clearance(const KeptPath& kept, const HttpRequest& request, const Execution& execution) const;
  HttpResponse sweep(const KeptPath& kept, const HttpRequest& request, const Execution& execution) const;
  PathView view_of(const HttpRequest& request) const;

  const ServedWorld& world_;
  const std::size_t most_view_points_;
  KeptValues<KeptPath> paths_;
};

}  // namespace warren::serve
