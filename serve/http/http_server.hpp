// SPDX-License-Identifier: BSD-3-Clause
// HTTP/1.1 by Boost.Beast for one service: the only place with sockets. All connections are looked after by the thread
// that calls run(), which computes nothing; answers that take time are made by a crew of a few threads.
//
// A connection costs its buffers and no thread, and every stage of it has an end that drop after drop of bytes doesn't
// move: a request's head, its body, its answer's way out. Where all places are taken, the connection that has waited
// longest without a whole request gives way, so that those who hold places for nothing never keep others out. A client
// that leaves stops the work on its answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "parallel/deadline.hpp"
#include "serve/http/http_names.hpp"
#include "serve/http/http_service.hpp"

namespace warren::serve {

/// Seconds are of the wall-clock, each for the whole of what it names.
struct HttpLimits {
  double head_s = 5.0;                 ///< from a request's first byte to the end of its head
  double body_s = 10.0;                ///< of its body
  double write_s = 30.0;               ///< of its answer
  double idle_s = 30.0;                ///< before the first byte of a request
  double linger_s = 1.0;               ///< between the last byte of an answer and the end, for those who still send
  double patience_s = 1.0;             ///< at the end, for what is worked on
  std::size_t head_bytes = 8192;       ///< of a request's first line and fields
  std::size_t connections = 256;       ///< in all
  std::size_t of_an_address = 16;      ///< the same, but for loopback
  std::size_t small_body = 64 * 1024;  ///< larger bodies are taken few at a time
  std::size_t large_bodies = 8;        ///< at a time, up to the end of their answers
  std::size_t unsent_bytes = std::size_t{128} << 20;  ///< of large answers on their way; one of any size always may
  std::size_t waiting = 64;  ///< requests that wait for a thread; further ones are told to come again
  unsigned threads = 1;      ///< that make answers; >= 1
};

struct HttpPlace {
  std::vector<std::string> addresses = {"127.0.0.1", "::1"};  ///< the second and later ones where the machine has them
  std::uint16_t port = 0;                                     ///< 0: one that is free
  std::vector<PublicUrl> public_urls = {};                    ///< that lead here, too
};

class HttpServer {
 public:
  /// Listens. Throws UsageError, naming address and port, where that can't be done.
  HttpServer(const HttpPlace& place, const HttpLimits& limits, HttpService& service);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// "http://127.0.0.1:8765/", of the first address.
  std::string address() const;
  std::uint16_t port() const;
  bool is_loopback() const;
  /// Serves until the flag isn't 0, looks at it twenty times a second; then takes no more connections, lets what is
  /// worked on end within limits.patience_s, and returns.
  void run(const SignalFlag& stop);

 private:
  class Connections;
  std::unique_ptr<Connections> connections_;
};

}  // namespace warren::serve
