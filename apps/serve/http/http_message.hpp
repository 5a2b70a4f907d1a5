// SPDX-License-Identifier: BSD-3-Clause
// Requests and answers of HTTP as plain data: what a service is asked and what it says, without sockets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/text/json_text.hpp"

namespace warren::serve {

struct HttpRequest {
  std::string method = "GET";  ///< "GET", "HEAD", "POST"; others are refused
  std::string path = "/";      ///< up to the question mark, decoded: begins with /, printable
  std::vector<std::pair<std::string, std::string>> query = {};  ///< behind it: names and values, decoded
  std::string host = {};                                        ///< the fields of that name; empty: none
  std::string origin = {};
  std::string authorization = {};
  std::string if_none_match = {};
  std::string body = {};
};

struct HttpResponse {
  unsigned status = 200;
  std::string type = "application/json";
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> fields = {};  ///< beside those that every answer has
};

/// A request that is refused: by this status and {"error": {"code", "where", "message"}}.
struct HttpError : TextError {
  HttpError(unsigned status_code, std::string_view short_code, std::string_view place, std::string_view message)
      : TextError(message), status(status_code), code(short_code), where(place) {}
  unsigned status;
  std::string_view code;  ///< a literal: "not_found"
  std::string where;      ///< "path", "Host", or a key of the body that is gone by then; may be empty
};

/// The same as an answer.
HttpResponse error_response(const HttpError& error);
/// 503 "busy", for one who may ask again in a second.
HttpResponse busy_response(std::string_view message);

inline constexpr std::size_t longest_target = 2048;

/// What a request is for: the target of its first line, taken apart and decoded once. Fills in path and query, of a
/// target that is a whole address (absolute-form) also the host. Throws HttpError: 414 for more than longest_target
/// bytes; 400 for what is no address and begins with no /, for broken escapes, and for escaped bytes that no name here
/// has: controls, beyond ASCII.
void read_target(std::string_view target, HttpRequest& request);

// By which names a service may be asked. A page of somebody else can make a browser send requests here: under its own
// name, which it lets point here (DNS rebinding), or as a form. So the Host of a request is one of a few names, and a
// request that changes or computes something comes from no page but its own.

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

/// JSON already: a value of json_object() that is a list or an object.
struct JsonText {
  std::string text;
};
inline std::string_view json_of(const JsonText& json) { return json.text; }
inline JsonText numbers_json(std::span<const double> numbers) { return {json_list(numbers)}; }

inline constexpr std::size_t deepest_json = 8;

/// Is each line a text of its own, or is it the whole?
enum class NestedIn : std::uint8_t { lines, whole };

/// How deep JSON is nested, before anybody parses it: a parser's stack is not for strangers to choose. How deep
/// brackets and braces lie in each other, in the deepest line or in the whole.
std::size_t nesting_of(std::string_view text, NestedIn what = NestedIn::lines);

}  // namespace warren::serve
