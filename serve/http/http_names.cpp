// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http/http_names.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace warren::serve {
namespace {

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
  const auto [read, error] = std::from_chars(text.data() + 1, last, host.port.emplace());
  return error == std::errc() && read == last ? std::optional(host) : std::nullopt;
}

/// Scheme, host, and the rest as it is, which may be nothing.
std::optional<PublicUrl> url_of(std::string_view text) {
  PublicUrl url;
  url.is_https = text.starts_with("https://");
  if (!url.is_https && !text.starts_with("http://")) return std::nullopt;
  text.remove_prefix(url.is_https ? 8 : 7);
  const std::size_t end = std::min(text.find_first_of("/?#"), text.size());
  const auto host = host_of(text.substr(0, end));
  if (!host) return std::nullopt;
  url.host = *host;
  url.path = text.substr(end);
  return url;
}

bool is_address(const std::string& name) {
  in6_addr bytes{};
  return ::inet_pton(AF_INET, name.c_str(), &bytes) == 1 || ::inet_pton(AF_INET6, name.c_str(), &bytes) == 1;
}

constexpr std::uint16_t http_port = 80;

/// By its address, without a name that people gave it?
bool is_own(const HostName& host, const HttpNames& names) {
  if (host.port.value_or(http_port) != names.port) return false;
  if (host.name == "localhost" || host.name == "127.0.0.1" || host.name == "::1") return true;
  return !names.is_loopback && is_address(host.name);
}

bool is_host_of(const PublicUrl& url, const HostName& host) {
  return host.name == url.host.name && host.port.value_or(url.usual_port()) == url.port();
}

bool may_ask(const std::string& origin, const HostName& host, const HttpNames& names) {
  const auto from = url_of(origin);
  if (!from || !from->path.empty()) return false;
  const auto is_from = [&](const PublicUrl& url) {
    return from->is_https == url.is_https && is_host_of(url, from->host);
  };
  return std::any_of(names.public_urls.begin(), names.public_urls.end(), is_from) ||
         (!from->is_https && is_own(host, names) && from->host.name == host.name && from->port() == names.port);
}

}  // namespace

std::optional<PublicUrl> public_url_of(std::string_view text) {
  std::optional<PublicUrl> url = url_of(text);
  if (!url) return std::nullopt;
  if (!url->path.ends_with('/')) url->path += '/';
  const bool is_taken =
      url->path.starts_with("/api/") || url->path.starts_with("/v/") || url->path.starts_with("/tiles/");
  const bool is_plain = url->host.name.find_first_of("@ \t") == std::string::npos &&
                        url->path.find_first_of("?#% \t") == std::string::npos;
  return is_taken || !is_plain ? std::nullopt : url;
}

void check_names(const HttpRequest& request, const HttpNames& names) {
  const auto host = host_of(request.host);
  if (!host) throw HttpError(400, "bad_request", "Host", "a name and a port are expected");
  const auto is_its = [&](const PublicUrl& url) { return is_host_of(url, *host); };
  if (!is_own(*host, names) && std::none_of(names.public_urls.begin(), names.public_urls.end(), is_its)) {
    throw HttpError(403, "forbidden", "Host",
                    "this service is asked by its address, or by a --public-url, not by another name for it");
  }
  if (request.method != "POST" || request.origin.empty() || may_ask(request.origin, *host, names)) return;
  throw HttpError(403, "forbidden", "Origin", "pages of other places may not ask");
}

void take_public_path(std::string& path, const HttpNames& names) {
  for (const PublicUrl& url : names.public_urls) {
    if (url.path.size() == 1 || !path.starts_with(url.path)) continue;
    path.erase(0, url.path.size() - 1);
    return;
  }
}

}  // namespace warren::serve
