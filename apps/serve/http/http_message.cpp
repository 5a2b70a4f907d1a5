// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/http_message.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "scenes/text/scene_text.hpp"

namespace warren::serve {

HttpResponse error_response(const HttpError& error) {
  const JsonText said{json_object("code", error.code, "where", error.where, "message", error.what())};
  return {.status = error.status, .body = json_object("error", said) + "\n"};
}

HttpResponse busy_response(std::string_view message) {
  HttpResponse busy = error_response({503, "busy", "", message});
  busy.fields.emplace_back("Retry-After", "1");
  return busy;
}

namespace {

std::string decoded(std::string_view text, bool plus_is_blank) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '+' && plus_is_blank) c = ' ';
    if (c == '%') {
      unsigned value = 0;
      const char* first = text.data() + i + 1;
      const bool is_whole = i + 2 < text.size();
      if (!is_whole || std::from_chars(first, first + 2, value, 16).ptr != first + 2) {
        throw HttpError(400, "bad_request", "target", "a % is not followed by two digits");
      }
      c = static_cast<char>(value);
      i += 2;
    }
    if (c < ' ' || c > '~') throw HttpError(400, "bad_request", "target", "only printable ASCII is expected");
    bytes += c;
  }
  return bytes;
}

/// Up to the mark, which goes; text becomes what follows.
std::string_view taken(std::string_view& text, char mark) {
  const std::size_t end = text.find(mark);
  const std::string_view piece = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return piece;
}

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
  host.port = text[0] == ':' ? scene_text::number_in_full<std::uint16_t>(text.substr(1)) : std::nullopt;
  return host.port ? std::optional(host) : std::nullopt;
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

void read_target(std::string_view target, HttpRequest& request) {
  if (target.size() > longest_target) {
    throw HttpError(414, "target_too_long", "target", "at most 2,048 bytes are expected");
  }
  const std::size_t scheme = target.starts_with("http://") ? 7 : target.starts_with("https://") ? 8 : 0;
  if (scheme > 0) {
    target.remove_prefix(scheme);
    request.host = target.substr(0, target.find_first_of("/?"));
    target.remove_prefix(request.host.size());
  }
  if (scheme > 0 ? request.host.empty() : !target.starts_with('/')) {
    throw HttpError(400, "bad_request", "target", "a path that begins with / is expected");
  }
  request.path = decoded(taken(target, '?'), false);
  if (request.path.empty()) request.path = "/";
  request.query.clear();
  while (!target.empty()) {
    std::string_view value = taken(target, '&');
    const std::string_view name = taken(value, '=');
    request.query.emplace_back(decoded(name, true), decoded(value, true));
  }
}

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

std::size_t nesting_of(std::string_view text, NestedIn what) {
  std::size_t deepest = 0;
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n' && what == NestedIn::lines) {  // a string holds none
      depth = 0;
      in_string = false;
    } else if (in_string) {
      i += c == '\\' ? 1 : 0;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

}  // namespace warren::serve
