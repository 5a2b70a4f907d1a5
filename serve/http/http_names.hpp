// SPDX-License-Identifier: BSD-3-Clause
// By which names a service may be asked. A page of somebody else can make a browser send requests here: under its own
// name, which it lets point here (DNS rebinding), or as a form. So the Host of a request is one of a few names, and a
// request that changes or computes something comes from no page but its own.
#pragma once

#include <string>
#include <vector>

#include "serve/http/http_message.hpp"

namespace warren::serve {

struct HttpNames {
  std::uint16_t port = 0;
  bool is_loopback = true;              ///< else every address may stand in Host, for none of them can be rebound
  std::vector<std::string> names = {};  ///< that may stand there, too, in lower case
};

/// Throws HttpError: 400 for a Host that is missing or broken, 403 for a wrong one, and for a POST whose Origin is
/// there and is not this service.
void check_names(const HttpRequest& request, const HttpNames& names);

}  // namespace warren::serve
