// SPDX-License-Identifier: BSD-3-Clause
// By which names a service may be asked. A page of somebody else can make a browser send requests here: under its own
// name, which it lets point here (DNS rebinding), or as a form. So the Host of a request is one of a few names, and a
// request that changes or computes something comes from no page but its own.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "serve/http/http_message.hpp"

namespace warren::serve {

/// What stands in Host, or in an address behind its scheme.
struct HostName {
  std::string name;  ///< in lower case, without brackets
  std::optional<std::uint16_t> port = {};
};

/// An address that leads to the service: of the machine under a name, or of a proxy before it.
struct PublicUrl {
  bool is_https = false;
  HostName host;
  std::string path = "/";  ///< begins and ends with /

  std::uint16_t usual_port() const { return is_https ? 443 : 80; }
  std::uint16_t port() const { return host.port.value_or(usual_port()); }
};

/// Takes "https://planner.example.org/robots/" apart, the last / may be missing; nothing where it is no such address,
/// or its path one that the service has of its own.
std::optional<PublicUrl> public_url_of(std::string_view text);

struct HttpNames {
  std::uint16_t port = 0;
  bool is_loopback = true;                  ///< else every address may stand in Host, for none of them can be rebound
  std::vector<PublicUrl> public_urls = {};  ///< their hosts may stand there, too, and their pages may ask
};

/// Throws HttpError: 400 for a Host that is missing or broken, 403 for a wrong one, and for a POST whose Origin is
/// there and is neither this service nor a public address.
void check_names(const HttpRequest& request, const HttpNames& names);

/// A path below that of a public address, as proxies send it that do not take that away, becomes one of the service.
void take_public_path(std::string& path, const HttpNames& names);

}  // namespace warren::serve
