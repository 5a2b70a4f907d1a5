// SPDX-License-Identifier: BSD-3-Clause
// What a request's words may be: targets and names.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "apps/serve/http/http_message.hpp"

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

TEST(HttpTarget, AWholeAddressNamesTheHost) {
  HttpRequest request;
  read_target("http://Here:8765/api/path/a?z=3", request);
  EXPECT_EQ(request.host, "Here:8765");
  EXPECT_EQ(request.path, "/api/path/a");
  EXPECT_EQ(request.query.size(), 1U);
  read_target("https://here", request);
  EXPECT_EQ(request.host, "here");
  EXPECT_EQ(request.path, "/");
}

TEST(HttpTarget, RefusesWhatIsNoPath) {
  struct Case {
    std::string target;
    unsigned status;
  };
  for (const Case& c :
       {Case{"", 400}, Case{"*", 400}, Case{"http:///", 400}, Case{"ftp://a/", 400}, Case{"https://?a", 400},
        Case{"api", 400}, Case{"/%", 400}, Case{"/%2", 400}, Case{"/%zz", 400}, Case{"/%00", 400}, Case{"/%0a", 400},
        Case{"/%c3%a4", 400}, Case{"/\xc3\xa4", 400}, Case{"/?a=%0d%0a", 400}, Case{"/" + std::string(2048, 'a'), 414},
        Case{"/" + std::string(2047, 'a'), 0}}) {
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
    HttpNames names{.port = 8765, .is_loopback = true, .public_urls = {public_url_of("http://here:8765").value()}};
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

TEST(HttpNames, APublicUrlIsASchemeANameAndAPath) {
  const auto url = public_url_of("https://Planner.example.org/robots");
  ASSERT_TRUE(url);
  EXPECT_TRUE(url->is_https);
  EXPECT_EQ(url->host.name, "planner.example.org");
  EXPECT_EQ(url->port(), 443);
  EXPECT_EQ(url->path, "/robots/");
  EXPECT_EQ(public_url_of("http://[fe80::1]:81")->port(), 81);
  for (const char* text : {"", "planner.example.org", "ftp://a/", "https://", "https://a:x/", "https://a/?b",
                           "https://a/#b", "https://me@a/", "https://a/%20/", "https://a/api/", "https://a/v"}) {
    EXPECT_FALSE(public_url_of(text)) << text;
  }
}

TEST(HttpNames, BehindAProxyPublicHostsAndOriginsAreTakenAndNoOther) {
  struct Case {
    std::string host;
    std::string origin;
    unsigned status;
  };
  const HttpNames names{.port = 8765,
                        .public_urls = {public_url_of("https://planner.example.org/robots/").value(),
                                        public_url_of("http://robot.local:8765").value()}};
  for (const Case& c :
       {Case{"planner.example.org", "https://planner.example.org", 0},
        Case{"PLANNER.example.org:443", "https://planner.example.org:443", 0},
        Case{"127.0.0.1:8765", "https://planner.example.org", 0},  // the proxy names where it asks
        Case{"robot.local:8765", "http://robot.local:8765", 0}, Case{"planner.example.org", "", 0},
        Case{"planner.example.org", "http://planner.example.org", 403},
        Case{"planner.example.org", "https://planner.example.org:8443", 403},
        Case{"planner.example.org", "https://planner.example.org/", 403},
        Case{"planner.example.org", "https://other.example.org", 403}, Case{"planner.example.org", "null", 403},
        Case{"planner.example.org:80", "", 403}, Case{"planner.example.org:8765", "", 403},
        Case{"robot.local", "", 403}, Case{"a.planner.example.org", "", 403}}) {
    SCOPED_TRACE(c.host + " " + c.origin);
    EXPECT_EQ(refused([&] { check_names({.method = "POST", .host = c.host, .origin = c.origin}, names); }), c.status);
  }
}

TEST(HttpNames, AHostNeedsNoPortWhereItIsThatOfTheScheme) {
  EXPECT_EQ(refused([&] { check_names({.host = "localhost"}, {.port = 80}); }), 0U);
  EXPECT_EQ(refused([&] { check_names({.host = "localhost"}, {.port = 443}); }), 403U);  // it speaks plain HTTP
}

TEST(HttpNames, AProxyMayLeaveThePublicPathOrTakeItAway) {
  const HttpNames names{.port = 8765, .public_urls = {public_url_of("https://planner.example.org/robots/").value()}};
  for (const auto& [asked, path] : {std::pair{"/robots/api/world", "/api/world"},
                                    {"/robots/", "/"},
                                    {"/api/world", "/api/world"},
                                    {"/robotsapi", "/robotsapi"}}) {
    std::string taken = asked;
    take_public_path(taken, names);
    EXPECT_EQ(taken, path);
  }
}

}  // namespace
}  // namespace warren::serve
