// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http/http_message.hpp"

#include "scenes/text/json_text.hpp"

namespace warren::serve {

HttpResponse error_response(unsigned status, std::string_view code, std::string_view where, std::string_view message) {
  JsonObject error;
  error.add("code", code);
  error.add("where", where);
  error.add("message", message);
  JsonObject json;
  json.add_json("error", error.closed());
  return {.status = status, .body = json.closed() + "\n"};
}

HttpResponse error_response(const HttpError& error) {
  return error_response(error.status, error.code, error.where, error.what());
}

}  // namespace warren::serve
