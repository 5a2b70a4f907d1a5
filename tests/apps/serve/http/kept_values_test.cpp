// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/kept_values.hpp"

#include <gtest/gtest.h>

#include <string>

namespace warren::serve {
namespace {

std::string seen(KeptValues<std::string>& kept, const std::string& name) {
  const auto value = kept.find(name);
  return value ? *value : "none";
}

TEST(KeptValues, ForgetTheOnesThatWereNotLookedAtForLongest) {
  KeptValues<std::string> kept(100);
  kept.put("a", "A", 40);
  kept.put("b", "B", 40);
  EXPECT_EQ(seen(kept, "a"), "A");
  kept.put("c", "C", 40);  // b is the oldest now
  EXPECT_EQ(seen(kept, "a"), "A");
  EXPECT_EQ(seen(kept, "b"), "none");
  EXPECT_EQ(seen(kept, "c"), "C");
  EXPECT_EQ(kept.bytes(), 80U);
}

TEST(KeptValues, ReplaceWhatHadTheName) {
  KeptValues<std::string> kept(100);
  kept.put("a", "A", 40);
  kept.put("a", "new", 10);
  EXPECT_EQ(seen(kept, "a"), "new");
  EXPECT_EQ(kept.bytes(), 10U);
}

TEST(KeptValues, DoNotKeepWhatWouldThrowOutMostOthers) {
  KeptValues<std::string> kept(100);
  kept.put("a", "A", 50);
  kept.put("large", "L", 51);
  EXPECT_EQ(seen(kept, "large"), "none");
  EXPECT_EQ(seen(kept, "a"), "A");
}

TEST(KeptValues, StayWhileSomebodyHoldsThem) {
  KeptValues<std::string> kept(100);
  const auto held = kept.put("a", "A", 50);
  kept.put("b", "B", 50);
  kept.put("c", "C", 50);
  EXPECT_EQ(seen(kept, "a"), "none");
  EXPECT_EQ(*held, "A");
  EXPECT_EQ(*kept.put("large", "L", 51), "L");
}

}  // namespace
}  // namespace warren::serve
