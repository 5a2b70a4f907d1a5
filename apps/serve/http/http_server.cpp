// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/http_server.hpp"

#include <fmt/format.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/http/parser.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <exception>
#include <limits>
#include <map>
#include <new>
#include <system_error>

#include "apps/serve/http/beast_words.hpp"
#include "core/base/page_pool.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::serve {
namespace {

/// The pages of a task's large blocks are the next one's: fresh ones take longer to touch than a path to find.
class PagesOfTasks {
 public:
  PagesOfTasks() { renew(); }
  void end_task() {
    constexpr std::size_t most_idle_bytes = std::size_t{128} << 20U;
    if (PagePool::idle_bytes() > most_idle_bytes) renew();
  }

 private:
  void renew() {
    try {
      pool_.emplace();
    } catch (const std::bad_alloc&) {  // then all pages are fresh
    }
  }
  std::optional<PagePool> pool_;
};

namespace asio = boost::asio;
namespace http = boost::beast::http;
using Tcp = asio::ip::tcp;
using Code = boost::system::error_code;
using Clock = std::chrono::steady_clock;

constexpr auto never = Clock::time_point::max();
constexpr auto between_looks = std::chrono::milliseconds(50);

using BeastResponse = http::response<http::string_body>;

/// Beast's parser, but lines that are folded into the one before, which are obsolete and which proxies read otherwise,
/// are refused.
class RequestParser : public http::request_parser<http::string_body> {
  void on_field_impl(http::field field, boost::beast::string_view name, boost::beast::string_view value,
                     Code& code) override {
    const char* begin = name.data() + name.size() + 1;  // behind the colon; a line's end follows
    while (*begin == ' ' || *begin == '\t') ++begin;
    if (begin != value.data()) {  // put together elsewhere, or begun on a later line
      code = http::error::bad_value;
    } else {
      get().insert(field, name, value);
    }
  }
};

// One connection of the server, and what is worked on for it: data of the server's own thread, but for what a job's
// task fills in.

/// Where a connection is with its request: in the first three it still waits for a whole one.
enum class Stage : std::uint8_t { idle, head, body, work, write, linger };

struct Connection;

/// A request that is worked on; outlives its connection.
struct Job {
  Connection* connection;  ///< nullptr: it has gone
  HttpRequest request;
  HttpResponse response = {};
  SignalFlag gone{0};
  Clock::time_point offered = Clock::now();
  Clock::time_point begun = {};
};

struct Connection {
  std::uint64_t id;
  Tcp::socket socket;
  asio::ip::address address;
  boost::beast::flat_buffer buffer;
  std::optional<RequestParser> parser = {};
  std::optional<BeastResponse> response = {};
  HttpRequest request = {};
  Job* job = nullptr;
  Stage stage = Stage::idle;
  Clock::time_point waits_since = Clock::now();  ///< for a whole request
  Clock::time_point end = never;                 ///< of the stage
  unsigned pending = 0;                          ///< operations that will call back
  bool closed = false;
  bool keep_alive = true;
  bool has_large_body = false;
  std::size_t unsent_bytes = 0;  ///< of a large answer on its way
};

/// Listens at all addresses that the machine has, at the first one's port. Throws UsageError where the first can't be.
std::vector<Tcp::acceptor> acceptors_at(const HttpPlace& place, asio::io_context& io) {
  std::vector<Tcp::acceptor> acceptors;
  std::uint16_t port = place.port;
  for (const std::string& name : place.addresses) {
    boost::system::error_code code;
    const auto address = asio::ip::make_address(name, code);
    Tcp::acceptor acceptor(io);
    if (!code) acceptor.open(address.is_v4() ? Tcp::v4() : Tcp::v6(), code);
    if (!code) acceptor.set_option(Tcp::acceptor::reuse_address(true), code);
    if (!code && address.is_v6()) acceptor.set_option(asio::ip::v6_only(true), code);
    if (!code) acceptor.bind({address, port}, code);
    if (!code) acceptor.listen(asio::socket_base::max_listen_connections, code);
    if (code == asio::error::address_in_use && acceptors.empty()) {
      throw UsageError(fmt::format("@port: {} of {} is taken; 0 takes a free one", port, name));
    }
    if (code && acceptors.empty())
      throw UsageError(fmt::format("@listen: {}, port {}: {}", name, port, code.message()));
    if (code) continue;
    port = acceptor.local_endpoint().port();
    acceptors.push_back(std::move(acceptor));
  }
  return acceptors;
}

/// Status and fields, those of every answer too; no body.
BeastResponse beast_response(const HttpResponse& said) {
  BeastResponse response(static_cast<http::status>(said.status), 11);
  response.set(http::field::content_type, said.type);
  response.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
      "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(http::field::cache_control, "no-store");
  for (const auto& [name, value] : said.fields) response.set(name, value);
  return response;
}

Clock::time_point in(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}
double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Did the bytes end before a whole request was there?
bool has_ended(const Code& code) {
  return code == http::error::end_of_stream || code == http::error::partial_message ||
         (code && code.category() == boost::system::system_category());
}

/// Has the other end closed the connection? Told even where bytes wait that nobody has read.
bool has_gone(Tcp::socket& socket) {
  tcp_info info{};
  socklen_t size = sizeof info;
  return ::getsockopt(socket.native_handle(), IPPROTO_TCP, TCP_INFO, &info, &size) == 0 &&
         info.tcpi_state != TCP_ESTABLISHED;
}

}  // namespace

TaskCrew::TaskCrew(unsigned threads, std::size_t most_waiting) : most_waiting_(most_waiting) {
  try {
    for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {  // as many as there are
  }
}

bool TaskCrew::offer(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (ended_ || tasks_.size() >= most_waiting_) return false;
    if (!threads_.empty()) {
      tasks_.push_back(std::move(task));
      wake_.notify_one();
      return true;
    }
  }
  task();
  return true;
}

std::size_t TaskCrew::waiting() const {
  const std::lock_guard lock(mutex_);
  return tasks_.size();
}

void TaskCrew::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    tasks_.clear();
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void TaskCrew::work() {
  PagesOfTasks pages;
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ended_ || !tasks_.empty(); });
    if (ended_) return;
    const std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    pages.end_task();
    lock.lock();
  }
}

namespace {

/// All of it is the business of the thread of run(), but for jobs' tasks, which touch their job alone.
class Connections : public HttpServer {
 public:
  Connections(const HttpPlace& place, const HttpLimits& limits, HttpService& service)
      : limits_(limits),
        service_(service),
        acceptors_(acceptors_at(place, io_)),
        crew_(limits.threads, limits.waiting) {
    const auto end = acceptors_.front().local_endpoint();
    const std::string name = end.address().to_string();
    address_ = fmt::format("http://{}:{}/", end.address().is_v6() ? "[" + name + "]" : name, end.port());
    names_ = {.port = end.port(), .is_loopback = end.address().is_loopback(), .public_urls = place.public_urls};
  }
  std::string address() const override { return address_; }
  std::uint16_t port() const override { return names_.port; }
  bool is_loopback() const override { return names_.is_loopback; }
  void run(const SignalFlag& stop) override {
    for (Tcp::acceptor& acceptor : acceptors_) accept(acceptor);
    crew_.offer([this]() noexcept {
      try {
        service_.prepare(ended_);
      } catch (...) {  // NOLINT(bugprone-empty-catch): who asks meets it again
      }
    });
    look(stop);
    io_.run();
    crew_.end();
  }

 private:
  // Connections come.
  void accept(Tcp::acceptor& acceptor) {
    acceptor.async_accept([this, &acceptor](const Code& code, Tcp::socket socket) {
      if (ending_ != never) return;
      if (code) {
        idle_acceptors_.push_back(&acceptor);  // out of descriptors: look() tries again
        return;
      }
      take(std::move(socket));
      accept(acceptor);
    });
  }
  void take(Tcp::socket socket) {
    Code code;
    const auto peer = socket.remote_endpoint(code);
    if (code || !has_place_for(peer.address())) return;
    ++figures_.accepted;
    socket.set_option(Tcp::no_delay(true), code);
    socket.non_blocking(true, code);
    const std::uint64_t id = next_connection_++;
    const std::size_t buffer_bytes = limits_.head_bytes + 8192;
    auto& c = connections_[id] = std::unique_ptr<Connection>(
        new Connection{id, std::move(socket), peer.address(), boost::beast::flat_buffer(buffer_bytes)});
    wait_for_request(*c);
  }
  bool has_place_for(const asio::ip::address& address) {
    const auto same = [&](const auto& other) { return other.second->address == address; };
    const auto of_address = [&] { return std::count_if(connections_.begin(), connections_.end(), same); };
    if (!address.is_loopback() && static_cast<std::size_t>(of_address()) >= limits_.of_an_address) return false;
    if (connections_.size() < limits_.connections) return true;
    Connection* longest = nullptr;  // that has waited without a whole request
    for (const auto& [id, other] : connections_) {
      const bool waits = !other->closed && (other->stage <= Stage::body || other->stage == Stage::linger);
      if (waits && (longest == nullptr || other->waits_since < longest->waits_since)) longest = other.get();
    }
    if (longest == nullptr) return false;  // all are worked on or answered
    ++figures_.gave_way;
    close(*longest);
    return true;
  }
  /// Calls visit with each; it may forget the one that it is given.
  template <class Visit>
  void each(const Visit& visit) {
    for (auto next = connections_.begin(); next != connections_.end();) visit(*(next++)->second);
  }
  void close(Connection& c) {
    if (c.closed) return;
    c.closed = true;
    end_bodies(c);
    if (c.job != nullptr) {
      c.job->gone = SIGTERM;
      c.job->connection = nullptr;
      c.job = nullptr;
    }
    Code ignored;
    c.socket.close(ignored);
    if (c.pending == 0) connections_.erase(c.id);
  }
  void enter(Connection& c, Stage stage, double seconds) {
    c.stage = stage;
    c.end = in(seconds);
  }
  /// `then` as what an operation calls: while its connection is open and still in the stage in which it was begun.
  template <class Then>
  auto while_open(Connection& c, const Then& then) {
    ++c.pending;
    return [this, &c, then, stage = c.stage](const Code& code, auto&&...) {
      --c.pending;
      if (c.closed) {
        if (c.pending == 0) connections_.erase(c.id);
      } else if (c.stage == stage) {
        then(code);
      }
    };
  }

  // Requests come.
  void wait_for_request(Connection& c) {
    if (ending_ != never) return close(c);
    enter(c, Stage::idle, limits_.idle_s);
    c.waits_since = Clock::now();
    c.response.reset();
    if (c.buffer.size() > 0) return read_head(c);
    c.socket.async_wait(Tcp::socket::wait_read,
                        while_open(c, [this, &c](const Code& code) { code ? close(c) : read_head(c); }));
  }
  void read_head(Connection& c) {
    enter(c, Stage::head, limits_.head_s);
    c.parser.emplace();
    c.parser->header_limit(static_cast<std::uint32_t>(limits_.head_bytes));
    c.parser->body_limit(std::numeric_limits<std::uint64_t>::max());  // read_body() knows it; in 1.74 none is 0
    http::async_read_header(c.socket, c.buffer, *c.parser,
                            while_open(c, [this, &c](const Code& code) { take_head(c, code); }));
  }
  void take_head(Connection& c, const Code& code) {
    if (has_ended(code)) return close(c);
    try {
      if (code) throw error_of_parser(code);
      c.request = request_of(c.parser->get());
      check_names(c.request, names_);
      take_public_path(c.request.path, names_);
      read_body(c, service_.most_body(c.request));
    } catch (const HttpError& error) {
      refuse(c, error);
    }
  }
  void read_body(Connection& c, std::size_t most) {
    const auto length = c.parser->content_length();
    if (length && *length > most) throw HttpError(413, "body_too_large", "body", fmt::format("at most {} bytes", most));
    if (c.parser->is_done()) return take_request(c);
    if (c.request.method != "POST") throw HttpError(400, "bad_request", "body", "GET and HEAD have none");
    const bool is_large = length ? *length > limits_.small_body : most > limits_.small_body;
    if (is_large && large_bodies_ >= limits_.large_bodies) {
      throw HttpError(503, "busy", "body", "too many large requests at a time; try again");
    }
    c.has_large_body = is_large;
    large_bodies_ += is_large ? 1 : 0;
    c.parser->body_limit(most);
    enter(c, Stage::body, limits_.body_s);
    http::async_read(c.socket, c.buffer, *c.parser, while_open(c, [this, &c](const Code& code) {
                       if (code == http::error::body_limit) return refuse(c, error_of_parser(code));
                       if (has_ended(code)) return close(c);
                       code ? refuse(c, error_of_parser(code)) : take_request(c);
                     }));
  }
  /// Room for the bodies of its request and its answer.
  void end_bodies(Connection& c) {
    large_bodies_ -= std::exchange(c.has_large_body, false) ? 1 : 0;
    unsent_bytes_ -= std::exchange(c.unsent_bytes, 0);
  }
  void take_request(Connection& c) {
    c.keep_alive = c.parser->get().keep_alive() && ending_ == never;
    c.request.body = std::move(c.parser->get().body());
    figures_.connections = connections_.size();
    figures_.working = jobs_.size();
    try {
      if (auto said = service_.at_once(c.request, figures_)) return write(c, std::move(*said));
    } catch (const HttpError& error) {
      return refuse(c, error);
    }
    offer(c);
  }

  // They are worked on.
  void offer(Connection& c) {
    const std::uint64_t number = next_job_++;
    auto& job = jobs_[number] = std::unique_ptr<Job>(new Job{&c, std::move(c.request)});
    Job* const working = c.job = job.get();
    c.stage = Stage::work;
    c.end = never;
    const bool taken = crew_.offer([this, working, number] {
      working->begun = Clock::now();
      working->response = answer_of(service_, working->request, working->gone);
      asio::post(io_, [this, number] { finish(number); });
    });
    if (taken) return;
    jobs_.erase(number);
    c.job = nullptr;
    write(c, busy_response("too many requests wait; try again"));
  }
  void finish(std::uint64_t number) {
    const auto found = jobs_.find(number);
    const std::unique_ptr<Job> job = std::move(found->second);
    jobs_.erase(found);
    const auto now = Clock::now();
    const double waited_s = seconds_between(job->offered, job->begun);
    const double worked_s = seconds_between(job->begun, now);
    ++figures_.worked;
    figures_.waited_s += waited_s;
    figures_.worked_s += worked_s;
    if (job->connection == nullptr) return;
    Connection& c = *job->connection;
    c.job = nullptr;
    c.request.method = job->request.method;
    job->response.fields.emplace_back("Server-Timing",
                                      fmt::format("queue;dur={:.3f}, work;dur={:.3f}", 1e3 * waited_s, 1e3 * worked_s));
    write(c, std::move(job->response));
  }

  // Answers go.
  void refuse(Connection& c, const HttpError& error) {
    c.keep_alive = false;  // what follows may be a body
    HttpResponse said = error_response(error);
    if (error.status == 405) said.fields.emplace_back("Allow", "GET, HEAD, POST");
    if (error.status == 503) said.fields.emplace_back("Retry-After", "1");
    write(c, std::move(said));
  }
  void write(Connection& c, HttpResponse said) {
    enter(c, Stage::write, limits_.write_s);
    Code ignored;
    c.socket.cancel(ignored);  // a read that took too long; it may still go on for a while, by buffer and parser
    if (said.body.size() > limits_.small_body && unsent_bytes_ > 0 &&
        unsent_bytes_ + said.body.size() > limits_.unsent_bytes) {
      said = busy_response("too many large answers are on their way; try again");
    }
    c.unsent_bytes = said.body.size() > limits_.small_body ? said.body.size() : 0;
    unsent_bytes_ += c.unsent_bytes;
    ++figures_.said[std::min<std::size_t>(said.status / 100, 5)];
    c.response = beast_response(said);
    c.response->keep_alive(c.keep_alive && ending_ == never);
    c.response->content_length(said.body.size());
    if (c.request.method != "HEAD" && said.status != 304) c.response->body() = std::move(said.body);
    http::async_write(c.socket, *c.response, while_open(c, [this, &c](const Code& code) { wrote(c, code); }));
  }
  void wrote(Connection& c, const Code& code) {
    end_bodies(c);
    if (code) return close(c);
    if (c.response->keep_alive()) return wait_for_request(c);
    Code ignored;
    c.socket.shutdown(Tcp::socket::shutdown_send, ignored);
    enter(c, Stage::linger, limits_.linger_s);
    linger(c);
  }
  /// A connection that is closed while the client still sends loses the answer on its way.
  void linger(Connection& c) {
    c.socket.async_read_some(asio::buffer(unread_),
                             while_open(c, [this, &c](const Code& code) { code ? close(c) : linger(c); }));
  }

  // Time goes by.
  void look(const SignalFlag& stop) {
    if (stop.load() != 0 && ending_ == never) begin_end();
    if (Clock::now() >= ending_) {
      for (const auto& [number, job] : jobs_) job->gone = SIGTERM;
      each([this](Connection& c) { close(c); });
    }
    if (ending_ != never && connections_.empty() && jobs_.empty()) return io_.stop();
    const auto now = Clock::now();
    each([this, now](Connection& c) {
      if (!c.closed && now >= c.end) end_stage(c);
    });
    each([this](Connection& c) {  // whoever has gone wants no answer, whatever was sent before that
      if (c.closed || c.stage != Stage::work || !has_gone(c.socket)) return;
      ++figures_.abandoned;
      close(c);
    });
    if (ending_ == never) {
      for (Tcp::acceptor* acceptor : std::exchange(idle_acceptors_, {})) accept(*acceptor);
    }
    timer_.expires_after(between_looks);
    timer_.async_wait([this, &stop](const Code&) { look(stop); });
  }
  void begin_end() {
    ending_ = in(limits_.patience_s);
    ended_ = SIGTERM;
    Code ignored;
    for (Tcp::acceptor& acceptor : acceptors_) acceptor.close(ignored);
    each([this](Connection& c) {
      if (c.stage <= Stage::body) close(c);
    });
  }
  void end_stage(Connection& c) {
    if (c.stage != Stage::head && c.stage != Stage::body) return close(c);
    ++figures_.timed_out;
    refuse(c, {408, "timeout", c.stage == Stage::head ? "head" : "body", "the request did not come in time"});
  }

  const HttpLimits limits_;
  HttpService& service_;
  asio::io_context io_{1};
  std::vector<Tcp::acceptor> acceptors_;
  std::vector<Tcp::acceptor*> idle_acceptors_;
  asio::steady_timer timer_{io_};
  HttpNames names_;
  std::string address_;
  HttpFigures figures_;
  Clock::time_point ending_ = never;
  SignalFlag ended_{0};  // stops prepare()
  std::uint64_t next_job_ = 0;
  std::size_t large_bodies_ = 0;
  std::size_t unsent_bytes_ = 0;
  std::array<char, 4096> unread_{};  // what nobody looks at; all connections may share it
  std::uint64_t next_connection_ = 0;
  std::map<std::uint64_t, std::unique_ptr<Connection>> connections_;
  std::map<std::uint64_t, std::unique_ptr<Job>> jobs_;
  TaskCrew crew_;  // last: it ends before what its tasks look at
};

}  // namespace

HttpError error_of_parser(const boost::system::error_code& code) {
  if (code == http::error::header_limit || code == http::error::buffer_overflow) {
    return {431, "head_too_large", "head", "at most 8,192 bytes of head are expected"};
  }
  if (code == http::error::body_limit) return {413, "body_too_large", "body", "the body is too large"};
  return {400, "bad_request", "head", fmt::format("no request of HTTP/1.1: {}", code.message())};
}

HttpRequest request_of(const BeastRequest& head) {
  HttpRequest request;
  request.method = std::string(head.method_string());
  if (head.method() != http::verb::get && head.method() != http::verb::head && head.method() != http::verb::post) {
    throw HttpError(405, "method_not_allowed", "method", "GET, HEAD and POST are expected");
  }
  read_target({head.target().data(), head.target().size()}, request);
  const bool is_coded = head.count(http::field::transfer_encoding) > 0;
  if (is_coded && (head.count(http::field::transfer_encoding) > 1 ||
                   !boost::beast::iequals(head[http::field::transfer_encoding], "chunked"))) {
    throw HttpError(400, "bad_request", "Transfer-Encoding", "chunked is the only one");  // where bodies end is certain
  }
  if (head.count(http::field::host) != 1) throw HttpError(400, "bad_request", "Host", "expected once");
  if (head.count(http::field::origin) > 1) throw HttpError(400, "bad_request", "Origin", "expected once at most");
  if (head.count(http::field::authorization) > 1) {
    throw HttpError(400, "bad_request", "Authorization", "expected once at most");
  }
  const auto field = [&](http::field name) { return std::string(head[name]); };
  if (request.host.empty()) request.host = field(http::field::host);
  request.origin = field(http::field::origin);
  request.authorization = field(http::field::authorization);
  request.if_none_match = field(http::field::if_none_match);
  return request;
}

std::unique_ptr<HttpServer> http_server(const HttpPlace& place, const HttpLimits& limits, HttpService& service) {
  return std::make_unique<Connections>(place, limits, service);
}

HttpResponse answer_of(HttpService& service, const HttpRequest& request, const SignalFlag& gone) noexcept {
  try {
    return service.work(request, gone);
  } catch (const HttpError& error) {
    return error_response(error);
  } catch (const UsageError& error) {
    return error_response({400, "usage", "", error.what()});
  } catch (const InputError& error) {
    return error_response({400, "bad_data", error.where(), error.what()});
  } catch (const Stopped& stopped) {
    const bool is_memory = stopped.reason == StopReason::memory;
    return is_memory ? error_response({503, "memory", "", stop_text(stopped.reason, stopped.wanted_bytes)})
                     : error_response({504, "budget", "budget_ms", "this takes longer than it may"});
  } catch (const std::bad_alloc&) {
    return error_response({503, "memory", "", "memory is out"});
  } catch (const std::exception& error) {
    return error_response({500, "internal", "", error.what()});
  }
}

}  // namespace warren::serve
