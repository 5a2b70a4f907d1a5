// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/world_service.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/refusals.hpp"

namespace warren::serve {
namespace {

const TileGrid grid{.span = 512.0, .levels = 4};

unsigned status_of(const std::string& method, const std::string& path) {
  try {
    route_of({.method = method, .path = path}, grid, "cafe");
    return 200;
  } catch (const HttpError& error) {
    return error.status;
  }
}

TEST(Route, LeadsToEachPlaceByItsMethodAlone) {
  for (const char* path :
       {"/", "/service.css", "/api/health", "/api/metrics", "/api/world", "/tiles/0/0/0.png", "/v/cafe/tiles/3/7/7.png",
        "/api/path/0123", "/api/path/0123/clearance", "/api/path/0123/sweep", "/api/scene",
        "/v/cafe/layers/roadmap/3/7/7.png", "/v/cafe/layers/roadmap/legend"}) {
    SCOPED_TRACE(path);
    EXPECT_EQ(status_of("GET", path), 200U);
    EXPECT_EQ(status_of("HEAD", path), 200U);
    EXPECT_EQ(status_of("POST", path), 405U);
  }
  for (const char* path : {"/api/query", "/api/query/batch", "/api/update", "/api/check", "/api/graph",
                           "/api/graph/open", "/api/graph/save"}) {
    SCOPED_TRACE(path);
    EXPECT_EQ(status_of("POST", path), 200U);
    EXPECT_EQ(status_of("GET", path), 405U);
  }
}

TEST(Route, ThereIsNothingElsewhere) {
  for (const char* path : {"/api/",
                           "/api/nothing",
                           "/api/path/",
                           "/api/path",
                           "/api/path/a/b",
                           "/api/query/other",
                           "/tiles/0/0",
                           "/tiles/0/0/0",
                           "/tiles/0/0/0.gif",
                           "/tiles/4/0/0.png",
                           "/tiles/0/1/0.png",
                           "/tiles/0/0/1.png",
                           "/tiles/2/4/0.png",
                           "/tiles/-1/0/0.png",
                           "/tiles/0/-1/0.png",
                           "/tiles/00/0/0.png",
                           "/tiles/1/01/0.png",
                           "/tiles/1/1e0/0.png",
                           "/tiles/1/ 1/0.png",
                           "/tiles/99999999999/0/0.png",
                           "/tiles//0/0.png",
                           "/v/beef/tiles/0/0/0.png",
                           "/v/cafe/tiles/0/0/0",
                           "/v/cafe",
                           "//",
                           "/a/b"}) {
    SCOPED_TRACE(path);
    EXPECT_EQ(status_of("GET", path), 404U);
  }
}

TEST(Route, ParametersAreThereOnceAndNumbersAreNumbers) {
  const auto refused = [](const std::string& value) {
    return !test::refusal<HttpError>([&] { numbers_parameter({.query = {{"bbox", value}}}, "bbox", 2); }).empty();
  };
  for (const char* value : {"", "1", "1,", ",1,2", "1,2,3", "1,nan", "inf,2", "1,2x", "x,1,2", "1 ,2", "1e999,2"}) {
    SCOPED_TRACE(value);
    EXPECT_TRUE(refused(value));
  }
  EXPECT_FALSE(refused("1.5,-2e3"));
  EXPECT_FALSE(numbers_parameter({}, "bbox", 2).has_value());
  EXPECT_THROW(parameter({.query = {{"z", "1"}, {"z", "2"}}}, "z"), HttpError);
  EXPECT_TRUE(flag_parameter({.query = {{"optimise", "1"}}}, "optimise"));
  EXPECT_FALSE(flag_parameter({.query = {{"optimise", "0"}}}, "optimise"));
  EXPECT_THROW(flag_parameter({.query = {{"optimise", "yes"}}}, "optimise"), HttpError);
}

}  // namespace
}  // namespace warren::serve
