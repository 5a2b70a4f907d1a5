// SPDX-License-Identifier: BSD-3-Clause
// What is asked about route graphs of the served world (docs/service.md): built, opened, judged edge by edge, saved as
// Nav2 loads them. The graph itself is the client's.
#pragma once

#include <string_view>

#include "apps/serve/api/route.hpp"
#include "apps/serve/api/served_world.hpp"
#include "apps/serve/http/http_message.hpp"
#include "core/run/execution.hpp"

namespace warren::serve {

/// place: one that is_of_graphs() knows. Throws HttpError, UsageError, InputError, Stopped.
HttpResponse answer_of_graphs(const ServedWorld& world, Place place, std::string_view body, const Execution& execution);

}  // namespace warren::serve
