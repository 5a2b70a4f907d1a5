// SPDX-License-Identifier: BSD-3-Clause
// Those who are slow, many, greedy or gone: what the server gives them, and that others are answered beside them.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/apps/serve/http/running_server.hpp"

namespace warren::serve {
namespace {

using Clock = std::chrono::steady_clock;
using test::RunningServer;
using test::Socket;
using test::status_of;
using test::TestService;

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
  const auto end = Clock::now() + std::chrono::seconds(120);
  while (status_of(answer) != 503 && Clock::now() < end) answer = server.asked(server.post("/large", body));
  EXPECT_EQ(status_of(answer), 503U);
  EXPECT_EQ(status_of(server.asked(server.post("/large", "small"))), 200U);
  large.send(std::string(999'997, 'a'));
  EXPECT_EQ(status_of(large.answer()), 200U);
  EXPECT_EQ(status_of(server.asked(server.post("/large", body))), 200U);
}

}  // namespace
}  // namespace warren::serve
