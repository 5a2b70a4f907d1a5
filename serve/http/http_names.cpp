// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http/http_names.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace warren::serve {
namespace {

struct HostName {
  std::string name;  ///< in lower case, without brackets
  std::uint16_t port = 80;
};

std::optional<HostName> host_of(std::string_view text) {
  HostName host;
  const bool bracketed = text.starts_with('[');
  const std::size_t end = bracketed ? text.find(']') : text.find(':');
  if (bracketed && end == std::string_view::npos) return std::nullopt;
  host.name = text.substr(bracketed ? 1 : 0, end == std::string_view::npos ? end : end - (bracketed ? 1 : 0));
  std::transform(host.name.begin(), host.name.end(), host.name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (host.name.empty()) return std::nullopt;
  if (end == std::string_view::npos) return host;
  text = text.substr(end + (bracketed ? 1 : 0));
  if (text.empty()) return host;
  const char* last = text.data() + text.size();
  if (text[0] != ':' || text.size() == 1) return std::nullopt;
  const auto [read, error] = std::from_chars(text.data() + 1, last, host.port);
  return error == std::errc() && read == last ? std::optional(host) : std::nullopt;
}

bool is_address(const std::string& name) {
  in6_addr bytes{};
  return ::inet_pton(AF_INET, name.c_str(), &bytes) == 1 || ::inet_pton(AF_INET6, name.c_str(), &bytes) == 1;
}

bool is_one_of(const HostName& host, const HttpNames& names) {
  if (host.port != names.port) return false;
  if (host.name == "localhost" || host.name == "127.0.0.1" || host.name == "::1") return true;
  if (!names.is_loopback && is_address(host.name)) return true;
  return std::find(names.names.begin(), names.names.end(), host.name) != names.names.end();
}

}  // namespace

void check_names(const HttpRequest& request, const HttpNames& names) {
  const auto host = host_of(request.host);
  if (!host) throw HttpError(400, "bad_request", "Host", "a name and a port are expected");
  if (!is_one_of(*host, names)) {
    throw HttpError(403, "forbidden", "Host", "this service is asked by its address, not by a name that points to it");
  }
  if (request.method != "POST" || request.origin.empty()) return;
  constexpr std::string_view scheme = "http://";
  const std::string_view origin = request.origin;
  const auto from = origin.starts_with(scheme) ? host_of(origin.substr(scheme.size())) : std::nullopt;
  if (!from || from->name != host->name || from->port != host->port) {
    throw HttpError(403, "forbidden", "Origin", "pages of other places may not ask");
  }
}

}  // namespace warren::serve
