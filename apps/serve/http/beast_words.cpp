// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/beast_words.hpp"

#include <fmt/format.h>

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/error.hpp>
#include <string>

namespace warren::serve {

namespace http = boost::beast::http;

void RequestParser::on_field_impl(http::field field, boost::beast::string_view name, boost::beast::string_view value,
                                  boost::beast::error_code& code) {
  const char* begin = name.data() + name.size() + 1;  // behind the colon; a line's end follows
  while (*begin == ' ' || *begin == '\t') ++begin;
  if (begin != value.data()) {  // put together elsewhere, or begun on a later line
    code = http::error::bad_value;
  } else {
    get().insert(field, name, value);
  }
}

HttpError error_of_parser(const boost::system::error_code& code) {
  if (code == http::error::header_limit || code == http::error::buffer_overflow) {
    return {431, "head_too_large", "head", "at most 8,192 bytes of head are expected"};
  }
  if (code == http::error::body_limit) return {413, "body_too_large", "body", "the body is too large"};
  return {400, "bad_request", "head", fmt::format("no request of HTTP/1.1: {}", code.message())};
}

BeastResponse beast_response(const HttpResponse& said) {
  BeastResponse response(static_cast<http::status>(said.status), 11);
  response.set(http::field::content_type, said.type);
  response.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
      "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(http::field::cache_control, "no-store");
  for (const auto& [name, value] : said.fields) response.set(name, value);
  return response;
}

HttpRequest request_of(const BeastRequest& head) {
  HttpRequest request;
  request.method = std::string(head.method_string());
  if (head.method() != http::verb::get && head.method() != http::verb::head && head.method() != http::verb::post) {
    throw HttpError(405, "method_not_allowed", "method", "GET, HEAD and POST are expected");
  }
  read_target({head.target().data(), head.target().size()}, request);
  const bool is_coded = head.count(http::field::transfer_encoding) > 0;
  if (is_coded && (head.count(http::field::transfer_encoding) > 1 ||
                   !boost::beast::iequals(head[http::field::transfer_encoding], "chunked"))) {
    throw HttpError(400, "bad_request", "Transfer-Encoding", "chunked is the only one");  // where bodies end is certain
  }
  if (head.count(http::field::host) != 1) throw HttpError(400, "bad_request", "Host", "expected once");
  if (head.count(http::field::origin) > 1) throw HttpError(400, "bad_request", "Origin", "expected once at most");
  if (head.count(http::field::authorization) > 1) {
    throw HttpError(400, "bad_request", "Authorization", "expected once at most");
  }
  const auto field = [&](http::field name) { return std::string(head[name]); };
  if (request.host.empty()) request.host = field(http::field::host);
  request.origin = field(http::field::origin);
  request.authorization = field(http::field::authorization);
  request.if_none_match = field(http::field::if_none_match);
  return request;
}

}  // namespace warren::serve
