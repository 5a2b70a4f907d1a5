// SPDX-License-Identifier: BSD-3-Clause
// The server by plain sockets of the loopback, with a service of the test's own and limits that a test can wait for.
#include "serve/http/http_server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace warren {
namespace {

using Clock = std::chrono::steady_clock;

/// /quick is there at once; /slow takes until somebody leaves or opens the gate; /echo gives its body back; /large,
/// too; /huge gives much.
class TestService : public HttpService {
 public:
  static constexpr std::size_t huge = std::size_t{32} << 20U;

  std::size_t most_body(const HttpRequest& head) const override {
    if (head.path == "/echo") return 1000;
    if (head.path == "/large") return std::size_t{1} << 20U;
    if (head.path == "/quick" || head.path == "/slow" || head.path == "/throw" || head.path == "/huge") return 0;
    throw HttpError(404, "not_found", "path", "nothing here");
  }
  std::optional<HttpResponse> at_once(const HttpRequest& request, const HttpFigures& figures) override {
    if (request.path != "/quick") return std::nullopt;
    return HttpResponse{.body = "working=" + std::to_string(figures.working) +
                                " gave_way=" + std::to_string(figures.gave_way)};
  }
  HttpResponse work(const HttpRequest& request, const SignalFlag& gone) override {
    if (request.path == "/throw") throw std::runtime_error("a bug");
    if (request.path == "/huge") return {.body = std::string(huge, 'a')};
    if (request.path != "/slow") return {.body = request.body};
    ++begun;
    while (gone == 0 && !open) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    left += gone != 0 ? 1 : 0;
    return {.body = "done"};
  }
  void prepare(const SignalFlag&) override { prepared = true; }
  std::atomic<bool> prepared{false};
  std::atomic<int> begun{0};
  std::atomic<int> left{0};
  std::atomic<bool> open{false};
};

class Socket {
 public:
  explicit Socket(std::uint16_t port) : file_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(file_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;  // NOLINT
  }
  ~Socket() { close(); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  bool connected() const { return connected_; }
  void close() {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }
  bool send(std::string_view text) const {
    return ::send(file_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }
  /// Up to the end of the connection.
  std::string rest() const {
    std::string text;
    while (receive(text)) {
    }
    return text;
  }
  /// One answer.
  std::string answer() const {
    std::string text;
    while (text.size() < whole_size(text)) {
      if (!receive(text)) break;
    }
    return text;
  }
  bool is_closed() const {
    std::string text;
    return !receive(text);
  }

 private:
  bool receive(std::string& text) const {
    char buffer[4096];
    pollfd readable{file_, POLLIN, 0};
    if (::poll(&readable, 1, 60'000) != 1) return false;  // sanitizers on a busy machine
    const ssize_t count = ::recv(file_, buffer, sizeof buffer, 0);
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    return count > 0;
  }
  static std::size_t whole_size(const std::string& text) {
    constexpr std::string_view length = "Content-Length: ";
    const std::size_t head = text.find("\r\n\r\n");
    const std::size_t field = text.find(length);
    if (head == std::string::npos || field > head) return static_cast<std::size_t>(-1);
    return head + 4 + std::stoul(text.substr(field + length.size()));
  }
  int file_;
  bool connected_ = false;
};

class RunningServer {
 public:
  explicit RunningServer(const HttpLimits& limits) : server({.addresses = {"127.0.0.1"}}, limits, service) {
    thread_ = std::thread([this] { server.run(stop_); });
    while (!service.prepared) std::this_thread::yield();  // else it waits for a thread beside the first request
  }
  ~RunningServer() { end(); }
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;
  void end() {
    stop_ = SIGTERM;
    if (thread_.joinable()) thread_.join();
  }
  std::string host() const { return "Host: 127.0.0.1:" + std::to_string(server.port()) + "\r\n"; }
  std::string get(const std::string& target, const std::string& fields = {}) const {
    return "GET " + target + " HTTP/1.1\r\n" + host() + fields + "\r\n";
  }
  std::string post(const std::string& target, const std::string& body) const {
    return "POST " + target + " HTTP/1.1\r\n" + host() + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
           body;
  }
  std::string asked(const std::string& request) const {
    const Socket socket(server.port());
    socket.send(request);
    return socket.answer();
  }

  TestService service;
  HttpServer server;

 private:
  SignalFlag stop_{0};
  std::thread thread_;
};

unsigned status_of(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? static_cast<unsigned>(std::stoul(answer.substr(9, 3))) : 0;
}

TEST(HttpServer, AnswersOneRequestAfterTheOtherOnAConnection) {
  const RunningServer server({});
  const Socket socket(server.server.port());
  for (int i = 0; i < 3; ++i) {
    socket.send(server.post("/echo", "hello " + std::to_string(i)));
    const std::string answer = socket.answer();
    EXPECT_EQ(status_of(answer), 200U);
    EXPECT_TRUE(answer.ends_with("hello " + std::to_string(i))) << answer;
  }
  socket.send(server.get("/quick") + server.post("/echo", "behind it"));  // at once
  EXPECT_EQ(status_of(socket.answer()), 200U);
}

TEST(HttpServer, PipelinedRequestsAreAnsweredInTheirOrder) {
  const RunningServer server({});
  const Socket socket(server.server.port());
  socket.send(server.post("/echo", "first") + server.post("/echo", "second") +
              server.get("/quick", "Connection: close\r\n"));
  const std::string all = socket.rest();
  EXPECT_LT(all.find("first"), all.find("second"));
  EXPECT_LT(all.find("second"), all.find("gave_way"));
}

TEST(HttpServer, EveryAnswerSaysWhatPagesMayDo) {
  const RunningServer server({});
  for (const char* target : {"/quick", "/nothing"}) {
    const std::string answer = server.asked(server.get(target));
    for (const char* field :
         {"Content-Security-Policy: default-src 'none'; script-src 'self'", "X-Content-Type-Options: nosniff",
          "Referrer-Policy: no-referrer", "Cross-Origin-Resource-Policy: same-origin"}) {
      EXPECT_NE(answer.find(field), std::string::npos) << answer;
    }
  }
}

TEST(HttpServer, RefusesWhatIsNoRequest) {
  const RunningServer server({});
  struct Case {
    std::string request;
    unsigned status;
  };
  const std::string host = server.host();
  for (const Case& c :
       {Case{"hello\r\n\r\n", 400},
        Case{"GET / HTTP/9.9\r\n" + host + "\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\n\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\n" + host + host + "\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\nHost: evil.example\r\n\r\n", 403},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Origin: http://evil.example\r\nContent-Length: 0\r\n\r\n", 403},
        Case{"DELETE /quick HTTP/1.1\r\n" + host + "\r\n", 405},
        Case{"BREW /quick HTTP/1.1\r\n" + host + "\r\n", 405},
        Case{"GET /nothing HTTP/1.1\r\n" + host + "\r\n", 404},
        Case{"GET /../../etc/passwd HTTP/1.1\r\n" + host + "\r\n", 404},
        Case{"GET /%2e%2e/etc/passwd HTTP/1.1\r\n" + host + "\r\n", 404},
        Case{"GET /" + std::string(3000, 'a') + " HTTP/1.1\r\n" + host + "\r\n", 414},
        Case{"GET /quick HTTP/1.1\r\n" + host + "X: " + std::string(9000, 'a') + "\r\n\r\n", 431},
        Case{"GET /quick HTTP/1.1\r\n" + host + std::string(9000, 'a'), 431},
        Case{"GET /quick HTTP/1.1\r\n" + host + "Content-Length: 3\r\n\r\nabc", 413},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Content-Length: 1001\r\n\r\n", 413},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Content-Length: 99999999999999999999999\r\n\r\n", 400},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Transfer-Encoding: xchunked\r\n\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\n" + host + "Transfer-Encoding: x\r\n\r\n", 400},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Transfer-Encoding: gzip, chunked\r\n\r\n0\r\n\r\n", 400},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked, identity\r\n\r\n0\r\n\r\n", 400},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n7d0\r\n" + std::string(2000, 'a') +
                 "\r\n0\r\n\r\n",
             413},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\nfffffffffffffffff\r\n", 400}}) {
    SCOPED_TRACE(c.request.substr(0, 90));
    const std::string answer = server.asked(c.request);
    EXPECT_EQ(status_of(answer), c.status) << answer;
    EXPECT_NE(answer.find("{\"error\":{\"code\":\""), std::string::npos) << answer;
  }
}

TEST(HttpServer, AChunkedBodyIsOne) {
  const RunningServer server({});
  const std::string answer = server.asked("POST /echo HTTP/1.1\r\n" + server.host() +
                                          "Transfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n2\r\nde\r\n0\r\n\r\n");
  EXPECT_EQ(status_of(answer), 200U);
  EXPECT_TRUE(answer.ends_with("abcde")) << answer;
}

TEST(HttpServer, HeadHasTheFieldsAlone) {
  const RunningServer server({});
  const Socket socket(server.server.port());
  socket.send("HEAD /quick HTTP/1.1\r\n" + server.host() + "Connection: close\r\n\r\n");
  const std::string answer = socket.rest();
  EXPECT_NE(answer.find("Content-Length: 20\r\n"), std::string::npos) << answer;
  EXPECT_TRUE(answer.ends_with("\r\n\r\n"));
}

TEST(HttpServer, DropAfterDropDoesNotMoveTheEndOfAHead) {
  const RunningServer server({.head_s = 0.3});
  const Socket socket(server.server.port());
  const auto begin = Clock::now();
  std::string answer;
  for (const char c : server.get("/quick", "X: " + std::string(4000, 'a') + "\r\n")) {
    if (!socket.send(std::string(1, c)) || Clock::now() - begin > std::chrono::seconds(20)) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(20));
  answer = socket.rest();
  EXPECT_TRUE(answer.empty() || status_of(answer) == 408) << answer;
}

TEST(HttpServer, ABodyThatDoesNotComeIsGivenUp) {
  const RunningServer server({.body_s = 0.2});
  const Socket socket(server.server.port());
  socket.send("POST /echo HTTP/1.1\r\n" + server.host() + "Content-Length: 10\r\n\r\nabc");
  EXPECT_EQ(status_of(socket.answer()), 408U);
  EXPECT_TRUE(socket.is_closed());
}

/// Bytes come before, while and after the time of their body ends: what still reads them must not meet what reads on.
TEST(HttpServer, ABodyWhoseTimeEndsInABurstIsGivenUp) {
  const RunningServer server({.body_s = 0.3, .linger_s = 0.3, .large_bodies = 100});
  const std::string head = "POST /large HTTP/1.1\r\n" + server.host() + "Content-Length: 1000000\r\n\r\n";
  const std::string burst(4096, 'a');
  for (int round = 0; round < 3; ++round) {
    std::vector<std::unique_ptr<Socket>> many;
    for (int i = 0; i < 60; ++i) {
      many.push_back(std::make_unique<Socket>(server.server.port()));
      many.back()->send(head);
    }
    const auto end = Clock::now() + std::chrono::milliseconds(900);
    while (Clock::now() < end) {
      for (const auto& socket : many) socket->send(burst);
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
  }
  EXPECT_EQ(status_of(server.asked(server.get("/quick"))), 200U);
}

TEST(HttpServer, AnIdleConnectionIsClosedWithoutAWord) {
  const RunningServer server({.idle_s = 0.1});
  const Socket socket(server.server.port());
  EXPECT_EQ(socket.rest(), "");
}

TEST(HttpServer, AnAnswerThatNobodyTakesIsGivenUp) {
  const RunningServer server({.write_s = 0.2});
  const Socket socket(server.server.port());
  const std::string body(std::size_t{1} << 20U, 'a');
  std::string requests;
  for (int i = 0; i < 32; ++i) requests += server.post("/large", body);
  // More than all buffers hold, and nothing is read: it ends since the server closes the connection.
  EXPECT_FALSE(socket.send(requests));
  EXPECT_EQ(status_of(server.asked(server.get("/quick"))), 200U);
}

TEST(HttpServer, WhoHasWaitedLongestWithoutAWholeRequestGivesWay) {
  const RunningServer server({.connections = 4});
  std::vector<std::unique_ptr<Socket>> slow;
  for (int i = 0; i < 4; ++i) {
    slow.push_back(std::make_unique<Socket>(server.server.port()));
    slow.back()->send("GET /quick HTT");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const std::string answer = server.asked(server.get("/quick"));
  EXPECT_TRUE(answer.ends_with("gave_way=1")) << answer;
  EXPECT_TRUE(slow.front()->is_closed());
}

TEST(HttpServer, WhatIsWorkedOnNeverGivesWay) {
  RunningServer server({.connections = 2, .threads = 2});
  std::vector<std::unique_ptr<Socket>> busy;
  for (int i = 0; i < 2; ++i) {
    busy.push_back(std::make_unique<Socket>(server.server.port()));
    busy.back()->send(server.get("/slow"));
    while (server.service.begun <= i) std::this_thread::yield();
  }
  EXPECT_EQ(server.asked(server.get("/quick")), "");  // no place
  server.service.open = true;
  for (const auto& socket : busy) EXPECT_EQ(status_of(socket->answer()), 200U);
}

TEST(HttpServer, AFullQueueSaysWhenToComeAgain) {
  RunningServer server({.waiting = 1, .threads = 1});
  const Socket first(server.server.port());
  first.send(server.get("/slow"));
  while (server.service.begun < 1) std::this_thread::yield();
  const Socket second(server.server.port());
  second.send(server.get("/slow"));
  while (server.asked(server.get("/quick")).find("working=2") == std::string::npos) std::this_thread::yield();
  const std::string answer = server.asked(server.post("/echo", "third"));
  EXPECT_EQ(status_of(answer), 503U);
  EXPECT_NE(answer.find("Retry-After: 1"), std::string::npos) << answer;
  EXPECT_EQ(status_of(server.asked(server.get("/quick"))), 200U);
  server.service.open = true;
  EXPECT_EQ(status_of(first.answer()), 200U);
  EXPECT_EQ(status_of(second.answer()), 200U);
}

TEST(HttpServer, AClientThatLeavesEndsTheWork) {
  RunningServer server({});
  Socket socket(server.server.port());
  socket.send(server.get("/slow"));
  while (server.service.begun < 1) std::this_thread::yield();
  socket.close();
  while (server.service.left < 1) std::this_thread::yield();
  EXPECT_EQ(status_of(server.asked(server.get("/quick"))), 200U);
}

TEST(HttpServer, AClientThatSendsOnAndLeavesEndsTheWork) {
  RunningServer server({});
  for (const char* more : {"X", "GET /quick HTTP/1.1\r\n"}) {
    Socket socket(server.server.port());
    const int before = server.service.begun;
    socket.send(server.get("/slow") + more);
    while (server.service.begun == before) std::this_thread::yield();
    const int left = server.service.left;
    socket.close();
    while (server.service.left == left) std::this_thread::yield();
  }
  EXPECT_EQ(status_of(server.asked(server.get("/quick"))), 200U);
}

TEST(HttpServer, LargeAnswersThatNobodyTakesAreFew) {
  const RunningServer server({.unsent_bytes = TestService::huge + 1});
  const Socket slow(server.server.port());
  slow.send(server.get("/huge"));  // more than all buffers hold
  std::string answer;
  while (status_of(answer) != 503) {
    answer = server.asked(server.get("/huge"));
    ASSERT_TRUE(status_of(answer) == 200 || status_of(answer) == 503);
  }
  EXPECT_NE(answer.find("large answers"), std::string::npos) << answer;
  EXPECT_EQ(status_of(server.asked(server.post("/echo", "small"))), 200U);
}

TEST(HttpServer, LargeBodiesAreFewAtATime) {
  RunningServer server({.large_bodies = 1});
  const Socket large(server.server.port());
  large.send("POST /large HTTP/1.1\r\n" + server.host() + "Content-Length: 1000000\r\n\r\nabc");
  const std::string body(200'000, 'a');
  std::string answer;
  const auto end = Clock::now() + std::chrono::seconds(8);
  while (status_of(answer) != 503 && Clock::now() < end) answer = server.asked(server.post("/large", body));
  EXPECT_EQ(status_of(answer), 503U);
  EXPECT_EQ(status_of(server.asked(server.post("/large", "small"))), 200U);
  large.send(std::string(999'997, 'a'));
  EXPECT_EQ(status_of(large.answer()), 200U);
  EXPECT_EQ(status_of(server.asked(server.post("/large", body))), 200U);
}

TEST(HttpServer, ABugIsAnAnswerAndNotTheEnd) {
  const RunningServer server({});
  EXPECT_EQ(status_of(server.asked(server.get("/throw"))), 500U);
  EXPECT_EQ(status_of(server.asked(server.get("/quick"))), 200U);
}

TEST(HttpServer, EndsWithinItsPatienceAndStopsWhatIsWorkedOn) {
  RunningServer server({.patience_s = 0.1});
  const Socket idle(server.server.port());
  const Socket busy(server.server.port());
  busy.send(server.get("/slow"));
  while (server.service.begun < 1) std::this_thread::yield();
  server.end();
  EXPECT_EQ(server.service.left, 1);
  EXPECT_TRUE(idle.is_closed());
  EXPECT_FALSE(Socket(server.server.port()).connected());
}

TEST(HttpServer, WhatIsWorkedOnMayEndBeforeThat) {
  RunningServer server({.patience_s = 30.0});
  const Socket busy(server.server.port());
  busy.send(server.get("/slow"));
  while (server.service.begun < 1) std::this_thread::yield();
  std::thread ender([&] { server.end(); });
  server.service.open = true;
  EXPECT_EQ(status_of(busy.answer()), 200U);
  ender.join();
  EXPECT_EQ(server.service.left, 0);
}

TEST(HttpServer, SaysWhoHasItsPortAlready) {
  const RunningServer server({});
  TestService service;
  try {
    const HttpServer second({.addresses = {"127.0.0.1"}, .port = server.server.port()}, {}, service);
    FAIL() << "two listen at one port";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("of 127.0.0.1 is taken; 0 takes a free one"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace warren
