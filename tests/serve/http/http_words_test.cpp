// SPDX-License-Identifier: BSD-3-Clause
// What a request's words may be: targets and names.
#include <gtest/gtest.h>

#include <string>

#include "serve/http/http_names.hpp"
#include "serve/http/http_target.hpp"

namespace warren::serve {
namespace {

/// The status of the refusal, or 0.
template <class Call>
unsigned refused(const Call& call) {
  try {
    call();
    return 0;
  } catch (const HttpError& error) {
    return error.status;
  }
}

TEST(HttpTarget, IsTakenApartAndDecodedOnce) {
  HttpRequest request;
  read_target("/api/path/a%20b?z=3&bbox=1,2&note=a+b%2Bc&flag&=x", request);
  EXPECT_EQ(request.path, "/api/path/a b");
  const std::vector<std::pair<std::string, std::string>> query{
      {"z", "3"}, {"bbox", "1,2"}, {"note", "a b+c"}, {"flag", ""}, {"", "x"}};
  EXPECT_EQ(request.query, query);
  read_target("/%2525", request);
  EXPECT_EQ(request.path, "/%25");
  EXPECT_TRUE(request.query.empty());
}

TEST(HttpTarget, RefusesWhatIsNoPath) {
  struct Case {
    std::string target;
    unsigned status;
  };
  for (const Case& c :
       {Case{"", 400}, Case{"*", 400}, Case{"http://a/", 400}, Case{"api", 400}, Case{"/%", 400}, Case{"/%2", 400},
        Case{"/%zz", 400}, Case{"/%00", 400}, Case{"/%0a", 400}, Case{"/%c3%a4", 400}, Case{"/\xc3\xa4", 400},
        Case{"/?a=%0d%0a", 400}, Case{"/" + std::string(2048, 'a'), 414}, Case{"/" + std::string(2047, 'a'), 0}}) {
    SCOPED_TRACE(c.target.substr(0, 40));
    HttpRequest request;
    EXPECT_EQ(refused([&] { read_target(c.target, request); }), c.status);
  }
}

TEST(HttpNames, OnlyTheServicesOwnMayStandInHost) {
  struct Case {
    std::string host;
    unsigned of_loopback;
    unsigned of_all;
  };
  for (const Case& c :
       {Case{"127.0.0.1:8765", 0, 0}, Case{"localhost:8765", 0, 0}, Case{"LOCALHOST:8765", 0, 0},
        Case{"[::1]:8765", 0, 0}, Case{"here:8765", 0, 0}, Case{"127.0.0.1", 403, 403}, Case{"127.0.0.1:80", 403, 403},
        Case{"evil.example:8765", 403, 403}, Case{"127.0.0.1.evil.example:8765", 403, 403},
        Case{"192.168.0.7:8765", 403, 0}, Case{"[fe80::1]:8765", 403, 0}, Case{"", 400, 400}, Case{":8765", 400, 400},
        Case{"localhost:", 400, 400}, Case{"localhost:8765x", 400, 400}, Case{"localhost:99999", 400, 400},
        Case{"[::1", 400, 400}, Case{"[::1]8765", 400, 400}, Case{"a@localhost:8765", 403, 403}}) {
    SCOPED_TRACE(c.host);
    HttpNames names{.port = 8765, .is_loopback = true, .names = {"here"}};
    EXPECT_EQ(refused([&] { check_names({.host = c.host}, names); }), c.of_loopback);
    names.is_loopback = false;
    EXPECT_EQ(refused([&] { check_names({.host = c.host}, names); }), c.of_all);
  }
}

TEST(HttpNames, APostOfAnotherPageIsRefused) {
  struct Case {
    std::string origin;
    unsigned status;
  };
  const HttpNames names{.port = 8765};
  for (const Case& c :
       {Case{"", 0}, Case{"http://localhost:8765", 0}, Case{"http://LocalHost:8765", 0}, Case{"null", 403},
        Case{"http://evil.example", 403}, Case{"http://localhost", 403}, Case{"http://localhost:8766", 403},
        Case{"https://localhost:8765", 403}, Case{"http://127.0.0.1:8765", 403}, Case{"http://", 403}}) {
    SCOPED_TRACE(c.origin);
    EXPECT_EQ(refused([&] { check_names({.method = "POST", .host = "localhost:8765", .origin = c.origin}, names); }),
              c.status);
    EXPECT_EQ(refused([&] { check_names({.method = "GET", .host = "localhost:8765", .origin = c.origin}, names); }),
              0U);
  }
}

}  // namespace
}  // namespace warren::serve
