// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/json_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/rng.hpp"

namespace warren {
namespace {

TEST(JsonText, AnyTextIsReadBackByOthers) {
  std::string all;
  for (int c = 0; c < 128; ++c) all += static_cast<char>(c);
  for (const std::string& text : {all, std::string{}, std::string{"žába \xF0\x9F\x90\xB8"}, std::string{"</script>"}}) {
    EXPECT_EQ(nlohmann::json::parse(json_string(text)).get<std::string>(), text);
  }
}

TEST(JsonText, BytesThatAreNoTextAreReplaced) {
  const std::string replaced = "\xEF\xBF\xBD";
  for (const char* bytes : {"\xFF", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\x80"}) {
    const std::string read = nlohmann::json::parse(json_string("a" + std::string{bytes} + "b")).get<std::string>();
    EXPECT_EQ(read.substr(0, 1 + replaced.size()), "a" + replaced);
    EXPECT_EQ(read.back(), 'b');
  }
}

TEST(JsonText, NumbersReadBackAsTheSameDouble) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random_bits(7, i));
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(nlohmann::json::parse(json_number(value)).get<double>(), value);
  }
  EXPECT_EQ(json_number(1.0), "1.0");
  EXPECT_EQ(json_number(-0.0), "-0.0");
  EXPECT_EQ(json_number(0.0), "0.0");
  EXPECT_EQ(json_number(-10'000.0), "-10000.0");
  EXPECT_EQ(json_number(999'999'999'999'999.0), "999999999999999.0");
  EXPECT_EQ(json_number(1e15), "1000000000000000.0");
  EXPECT_EQ(json_number(1e16), "1e+16");
  EXPECT_EQ(json_number(0.1), "0.1");
  EXPECT_EQ(json_number(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(json_number(std::numeric_limits<double>::quiet_NaN()), "null");
}

TEST(JsonText, KeysKeepTheirOrder) {
  JsonObject object;
  EXPECT_EQ(object.closed(), "{}");
  object.add("b", std::uint64_t{1});
  object.add("a", true);
  object.add_or_null("none", false, 2.5);
  object.add_json("list", json_list<double>(std::array{1.0, 2.5}));
  EXPECT_EQ(object.closed(), R"({"b":1,"a":true,"none":null,"list":[1.0,2.5]})");
}

}  // namespace
}  // namespace warren
