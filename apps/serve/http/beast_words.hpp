// SPDX-License-Identifier: BSD-3-Clause
// Requests and answers between Beast's words and ours (http_message.hpp); http_server.cpp, which compiles Beast anyway,
// has the code.
#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/system/error_code.hpp>

#include "apps/serve/http/http_message.hpp"

namespace warren::serve {

using BeastRequest = boost::beast::http::request<boost::beast::http::string_body>;
using BeastResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// Beast's parser, but lines that are folded into the one before, which are obsolete and which proxies read otherwise,
/// are refused.
class RequestParser : public boost::beast::http::request_parser<boost::beast::http::string_body> {
  void on_field_impl(boost::beast::http::field field, boost::beast::string_view name, boost::beast::string_view value,
                     boost::beast::error_code& code) override;
};

/// What a parser says of a head or a body.
HttpError error_of_parser(const boost::system::error_code& code);

/// Method, target, fields. Throws HttpError.
HttpRequest request_of(const BeastRequest& head);

/// Status and fields, those of every answer too; no body.
BeastResponse beast_response(const HttpResponse& said);

}  // namespace warren::serve
