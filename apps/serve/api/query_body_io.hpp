// SPDX-License-Identifier: BSD-3-Clause
// The body of POST /api/query: one JSON object.
#pragma once

#include <string_view>

#include "apps/serve/api/served_world.hpp"
#include "apps/serve/http/http_message.hpp"

namespace warren::serve {

/// What it asks, and how the answer shall be told.
struct QueryBody {
  ServedQuestion question;
  bool tells_path = true;  ///< else the path is kept, to be seen part by part
};

/// Throws HttpError: 400 for what is no such object, nested deeper than deepest_json or has another key.
QueryBody read_query_body(std::string_view json);

}  // namespace warren::serve
