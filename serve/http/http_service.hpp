// SPDX-License-Identifier: BSD-3-Clause
// What a server asks of whom it serves: the whole of an interface, without sockets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "parallel/deadline.hpp"
#include "serve/http/http_message.hpp"

namespace warren::serve {

/// What a server has done so far, and does now.
struct HttpFigures {
  std::uint64_t connections = 0;        ///< open now
  std::uint64_t accepted = 0;           ///< connections so far
  std::uint64_t gave_way = 0;           ///< connections closed because others wanted their places
  std::uint64_t timed_out = 0;          ///< requests that did not come in time
  std::uint64_t abandoned = 0;          ///< clients who left while their answer was made
  std::array<std::uint64_t, 6> said{};  ///< answers so far by the first digit of their status
  std::uint64_t working = 0;            ///< requests that are worked on, or wait for it
  std::uint64_t worked = 0;             ///< requests that were worked on so far
  double waited_s = 0.0;                ///< they, for a thread, all together
  double worked_s = 0.0;                ///< on them, all together
};

class HttpService {
 public:
  HttpService() = default;
  virtual ~HttpService() = default;
  HttpService(const HttpService&) = delete;
  HttpService& operator=(const HttpService&) = delete;

  /// Bytes that the body of such a request may have; asked before it is read. Throws HttpError for what there isn't.
  virtual std::size_t most_body(const HttpRequest& head) const = 0;
  /// An answer that is there already; nothing where work() shall make it. Called on the server's own thread: takes
  /// microseconds.
  virtual std::optional<HttpResponse> at_once(const HttpRequest& request, const HttpFigures& figures) = 0;
  /// Makes an answer; any number of threads may call. `gone`: not 0 as soon as nobody wants it any more. Throws what
  /// answer_of() knows.
  virtual HttpResponse work(const HttpRequest& request, const SignalFlag& gone) = 0;
  /// Makes what first requests would wait for; called once, as work() is. What it throws means nothing.
  virtual void prepare(const SignalFlag& /*gone*/) {}
};

/// work(), or what it throws as an answer: HttpError as it says; 400 for UsageError and InputError, 504 and 503 for
/// Stopped at a budget and by memory, 503 for memory that is out, 500 for bugs.
HttpResponse answer_of(HttpService& service, const HttpRequest& request, const SignalFlag& gone) noexcept;

}  // namespace warren::serve
