// SPDX-License-Identifier: BSD-3-Clause
// The server by plain sockets of the loopback, with a service of the test's own and limits that a test can wait for.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include "apps/serve/http/http_server.hpp"

namespace warren::test {

/// /quick is there at once; /slow takes until somebody leaves or opens the gate; /echo gives its body back; /large,
/// too; /huge gives much.
class TestService : public serve::HttpService {
 public:
  static constexpr std::size_t huge = std::size_t{32} << 20U;

  std::size_t most_body(const serve::HttpRequest& head) const override {
    if (head.path == "/echo") return 1000;
    if (head.path == "/large") return std::size_t{1} << 20U;
    if (head.path == "/quick" || head.path == "/slow" || head.path == "/throw" || head.path == "/huge") return 0;
    throw serve::HttpError(404, "not_found", "path", "nothing here");
  }
  std::optional<serve::HttpResponse> at_once(const serve::HttpRequest& request,
                                             const serve::HttpFigures& figures) override {
    if (request.path != "/quick") return std::nullopt;
    return serve::HttpResponse{.body = "working=" + std::to_string(figures.working) +
                                       " gave_way=" + std::to_string(figures.gave_way)};
  }
  serve::HttpResponse work(const serve::HttpRequest& request, const SignalFlag& gone) override {
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

class Socket : NotCopied {
 public:
  explicit Socket(std::uint16_t port) : file_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(file_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;  // NOLINT
  }
  ~Socket() { close(); }

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

class RunningServer : NotCopied {
 public:
  explicit RunningServer(const serve::HttpLimits& limits)
      : listening_(serve::http_server({.addresses = {"127.0.0.1"}}, limits, service)), server(*listening_) {
    thread_ = std::thread([this] { server.run(stop_); });
    while (!service.prepared) std::this_thread::yield();  // else it waits for a thread beside the first request
  }
  ~RunningServer() { end(); }
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

 private:
  const std::unique_ptr<serve::HttpServer> listening_;

 public:
  serve::HttpServer& server;

 private:
  SignalFlag stop_{0};
  std::thread thread_;
};

inline unsigned status_of(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? static_cast<unsigned>(std::stoul(answer.substr(9, 3))) : 0;
}

}  // namespace warren::test
