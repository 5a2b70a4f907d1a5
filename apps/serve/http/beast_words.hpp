// SPDX-License-Identifier: BSD-3-Clause
// Requests in Beast's words as ours (http_message.hpp); http_server.cpp, which compiles Beast anyway, has the code.
#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/system/error_code.hpp>

#include "apps/serve/http/http_message.hpp"

namespace warren::serve {

using BeastRequest = boost::beast::http::request<boost::beast::http::string_body>;

/// What a parser says of a head or a body.
HttpError error_of_parser(const boost::system::error_code& code);

/// Method, target, fields. Throws HttpError.
HttpRequest request_of(const BeastRequest& head);

}  // namespace warren::serve
