// SPDX-License-Identifier: BSD-3-Clause
// What comes over a socket: a request's bytes, to the answer of a small world. Of whatever bytes, the answer has one of
// the statuses that docs/service.md names, never 500, and a refusal has its form.
#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/serve/api/world_service.hpp"
#include "apps/serve/http/beast_words.hpp"
#include "apps/serve/http/http_message.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/text/input_file_io.hpp"
#include "tests/fuzz/fuzz_reader.hpp"
#include "tests/fuzz/properties.hpp"

namespace warren::fuzz {
namespace {

namespace http = boost::beast::http;

/// The service of a few walls and a polygon; paths and tiles that were asked for stay, as in a service.
serve::HttpService& small_service() {
  constexpr const char* town =
      "bounds 0 0 100 60\nwall 10 10 50 40\npolygon 60 10 90 10 90 50 60 50\nstart 5 30\ngoal 95 30\n";
  static const serve::ServedWorld world(read_scene(InputFile::of_bytes("town.scene", town), {}), {}, fuzz_execution());
  static const auto service = serve::world_service(world, {.budget_s = 1.0, .threads = 1});
  return *service;
}

/// As the server reads it, but in one piece. Throws HttpError.
serve::HttpRequest request_in(std::string_view bytes) {
  http::request_parser<http::string_body> parser;
  parser.eager(true);
  parser.header_limit(8192);
  parser.body_limit(std::uint64_t{1} << 16U);
  boost::system::error_code code;
  while (!bytes.empty() && !parser.is_done() && !code) {
    const std::size_t taken = parser.put(boost::asio::buffer(bytes.data(), bytes.size()), code);
    if (taken == 0 && !code) break;
    bytes.remove_prefix(taken);
  }
  if (!code && !parser.got_some()) code = http::error::end_of_stream;
  if (!code && !parser.is_done()) parser.put_eof(code);
  if (code) throw serve::error_of_parser(code);
  serve::HttpRequest request = serve::request_of(parser.get());
  request.body = std::move(parser.get().body());
  serve::check_names(request, {.port = 8765});
  return request;
}

serve::HttpResponse answer_to(std::string_view bytes) {
  try {
    const serve::HttpRequest request = request_in(bytes);
    serve::HttpService& service = small_service();
    if (request.body.size() > service.most_body(request))
      return serve::error_response({413, "body_too_large", "body", "large"});
    if (auto said = service.at_once(request, {})) return std::move(*said);
    const SignalFlag gone{0};
    return serve::answer_of(service, request, gone);
  } catch (const serve::HttpError& error) {
    return serve::error_response(error);
  }
}

void read_requests(std::string_view bytes) {
  const serve::HttpResponse said = answer_to(bytes);
  constexpr std::array statuses{200U, 304U, 400U, 403U, 404U, 405U, 413U, 414U, 422U, 431U, 503U, 504U};
  demand(std::find(statuses.begin(), statuses.end(), said.status) != statuses.end(), "a status that is documented");
  for (const auto& [name, value] : said.fields)
    demand(value.find_first_of("\r\n") == std::string::npos, "a field is one line");
  if (said.status < 400) return;
  const auto json = nlohmann::json::parse(said.body, nullptr, false);
  demand(json.is_object() && json.size() == 1 && json.contains("error"), "a refusal has its form");
  const auto& error = json["error"];
  demand(error.size() == 3 && error.contains("code") && error.contains("where"), "a refusal says code and place");
  demand_message(error.at("message").get<std::string>());
}

constexpr std::array request_table{FuzzReader{"http_request", read_requests}};

}  // namespace

std::span<const FuzzReader> request_readers() { return request_table; }

}  // namespace warren::fuzz
