// SPDX-License-Identifier: BSD-3-Clause
// One connection of the server, and what is worked on for it: data of the server's own thread, but for what a job's
// task fills in.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "parallel/deadline.hpp"
#include "serve/http/beast_words.hpp"
#include "serve/http/http_message.hpp"

namespace warren::serve {

using ServerClock = std::chrono::steady_clock;
inline constexpr auto never = ServerClock::time_point::max();

/// Where a connection is with its request: in the first three it still waits for a whole one.
enum class Stage : std::uint8_t { idle, head, body, work, write, linger };

struct Connection;

/// A request that is worked on; outlives its connection.
struct Job {
  Connection* connection;  ///< nullptr: it has gone
  HttpRequest request;
  HttpResponse response = {};
  SignalFlag gone{0};
  ServerClock::time_point offered = ServerClock::now();
  ServerClock::time_point begun = {};
};

struct Connection {
  Connection(std::uint64_t number, boost::asio::ip::tcp::socket&& its_socket, std::size_t buffer_bytes)
      : id(number), socket(std::move(its_socket)), buffer(buffer_bytes) {}
  std::uint64_t id;
  boost::asio::ip::tcp::socket socket;
  boost::asio::ip::address address = {};
  boost::beast::flat_buffer buffer;
  std::optional<RequestParser> parser = {};
  std::optional<BeastResponse> response = {};
  HttpRequest request = {};
  Job* job = nullptr;
  Stage stage = Stage::idle;
  ServerClock::time_point waits_since = ServerClock::now();  ///< for a whole request
  ServerClock::time_point end = never;                       ///< of the stage
  unsigned pending = 0;                                      ///< operations that will call back
  bool closed = false;
  bool keep_alive = true;
  bool has_large_body = false;
  std::size_t unsent_bytes = 0;  ///< of a large answer on its way
};

}  // namespace warren::serve
