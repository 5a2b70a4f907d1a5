// SPDX-License-Identifier: BSD-3-Clause
// Requests and answers of HTTP as plain data: what a service is asked and what it says, without sockets.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.hpp"

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
  std::string_view code;   ///< a literal: "not_found"
  std::string_view where;  ///< a literal: "path", "Host"; may be empty
};

/// The same as an answer.
HttpResponse error_response(unsigned status, std::string_view code, std::string_view where, std::string_view message);
HttpResponse error_response(const HttpError& error);

}  // namespace warren::serve
