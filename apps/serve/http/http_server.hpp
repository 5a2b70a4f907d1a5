// SPDX-License-Identifier: BSD-3-Clause
// HTTP/1.1 by Boost.Beast for one service: the only place with sockets. All connections are looked after by the thread
// that calls run(), which computes nothing; answers that take time are made by a crew of a few threads (TaskCrew).
//
// A connection costs its buffers and no thread, and every stage of it has an end that drop after drop of bytes doesn't
// move: a request's head, its body, its answer's way out. Where all places are taken, the connection that has waited
// longest without a whole request gives way, so that those who hold places for nothing never keep others out. A client
// that leaves stops the work on its answer.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "apps/serve/http/http_message.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"

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

/// What a server asks of whom it serves: the whole of an interface, without sockets.
class HttpService : NotCopied {
 public:
  virtual ~HttpService() = default;

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
  virtual ~HttpServer() = default;

  /// "http://127.0.0.1:8765/", of the first address.
  virtual std::string address() const = 0;
  virtual std::uint16_t port() const = 0;
  virtual bool is_loopback() const = 0;
  /// Serves until the flag isn't 0, looks at it twenty times a second; then takes no more connections, lets what is
  /// worked on end within limits.patience_s, and returns.
  virtual void run(const SignalFlag& stop) = 0;
};
/// Listens; refers to the service. Throws UsageError, naming address and port, where that can't be done.
std::unique_ptr<HttpServer> http_server(const HttpPlace& place, const HttpLimits& limits, HttpService& service);

// A few threads that take tasks from a short queue, so that whoever hands them out never waits: a full queue says no.
// A task may run loops of parallel/chunks.hpp.

class TaskCrew : NotCopied {
 public:
  /// threads >= 1. Where the system makes fewer, there are fewer; where it makes none, offer() does the task itself.
  TaskCrew(unsigned threads, std::size_t most_waiting);
  /// As end().
  ~TaskCrew() { end(); }

  /// Does the task soon, on one of the threads; false: too many wait already. Tasks don't throw.
  bool offer(std::function<void()> task);
  /// Tasks that nobody has begun.
  std::size_t waiting() const;
  /// Waits for the tasks that have begun; the others are never done. offer() then says no.
  void end();

 private:
  void work();

  const std::size_t most_waiting_;
  mutable std::mutex mutex_;  // guards what follows but threads_, which its owner alone touches
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  bool ended_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace warren::serve
