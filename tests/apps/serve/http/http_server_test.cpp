// SPDX-License-Identifier: BSD-3-Clause
// What the server takes for a request and how it answers, and its end. Limits: http_limits_test.cpp.
#include "apps/serve/http/http_server.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/apps/serve/http/running_server.hpp"
#include "tests/refusals.hpp"

namespace warren::serve {
namespace {

using test::RunningServer;
using test::Socket;
using test::status_of;
using test::TestService;

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
  const std::string own_origin = "Origin: http://127.0.0.1:" + std::to_string(server.server.port()) + "\r\n";
  for (const Case& c :
       {Case{"hello\r\n\r\n", 400},
        Case{"GET / HTTP/9.9\r\n" + host + "\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\n\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\n" + host + host + "\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\nHost: evil.example\r\n\r\n", 403},
        Case{"POST /echo HTTP/1.1\r\n" + host + "Origin: http://evil.example\r\nContent-Length: 0\r\n\r\n", 403},
        Case{"POST /echo HTTP/1.1\r\n" + host + own_origin + "Origin: http://evil.example\r\nContent-Length: 0\r\n\r\n",
             400},
        Case{"GET http://evil.example/quick HTTP/1.1\r\n" + host + "\r\n", 403},
        Case{"GET /quick HTTP/1.1\r\n" + host + "X: a\r\n b\r\n\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\n" + host + "X:\r\n\tb\r\n\r\n", 400},
        Case{"GET /quick HTTP/1.1\r\n" + host + "X: \r\n \r\n\r\n", 400},
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

TEST(HttpServer, AnAddressOfItsOwnIsATarget) {
  const RunningServer server({});
  const std::string address = server.server.address();
  EXPECT_EQ(status_of(server.asked(server.get(address + "quick", "X:  a \r\nY:\r\n"))), 200U);
  EXPECT_EQ(status_of(server.asked("GET " + address + "quick HTTP/1.1\r\nHost: elsewhere\r\n\r\n")), 200U);
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
  const HttpPlace taken{.addresses = {"127.0.0.1"}, .port = server.server.port()};
  const std::string said = test::refusal<UsageError>([&] { http_server(taken, {}, service); });
  EXPECT_NE(said.find("of 127.0.0.1 is taken; 0 takes a free one"), std::string::npos) << said;
}

}  // namespace
}  // namespace warren::serve
