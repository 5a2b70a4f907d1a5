// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http/http_target.hpp"

#include <charconv>
#include <string>

namespace warren::serve {
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

}  // namespace warren::serve
