// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/kept_values.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "parallel/once.hpp"

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

/// Cannot be kept: its memory ends where it is put there.
struct Unkept {
  explicit Unkept(int value_of) : value(value_of) {}
  Unkept(const Unkept& other) : value(other.value) {
    if (value < 0) throw std::bad_alloc();
  }
  int value;
};

TEST(KeptValues, StayWhereMemoryEndsForWhatReplacesThem) {
  KeptValues<Unkept> kept(100);
  kept.put("a", Unkept(1), 50);
  EXPECT_THROW(kept.put("a", Unkept(-1), 40), std::bad_alloc);
  EXPECT_THROW(kept.put("b", Unkept(-1), 50), std::bad_alloc);
  ASSERT_TRUE(kept.find("a"));
  EXPECT_EQ(kept.find("a")->value, 1);
  EXPECT_EQ(kept.bytes(), 50U);
}

using MadeByName = KeptValues<std::unique_ptr<MadeOnce<int>>>;

/// What somebody holds and make() has given, or gives now.
int value_in(const MadeByName::Lease& lease, const auto& make) {
  return (*lease)->get({}, [&] { return std::make_unique<int>(make()); });
}

MadeByName::Lease asked(MadeByName& kept, const std::string& name) {
  return kept.find_or_put(name, 50, [] { return std::make_unique<MadeOnce<int>>(); });
}

TEST(KeptValues, ManyWhoAskForOneAtOnceGetTheOneThatIsMade) {
  MadeByName kept(100);
  std::atomic<int> makes{0};
  std::atomic<int> asking{0};
  std::vector<std::jthread> askers;
  constexpr int count = 6;
  for (int i = 0; i < count; ++i) {
    askers.emplace_back([&] {
      ++asking;
      EXPECT_EQ(value_in(asked(kept, "a"),
                         [&] {
                           while (asking < count) std::this_thread::yield();  // the others ask while it is made
                           return ++makes;
                         }),
                1);
    });
  }
  askers.clear();
  EXPECT_EQ(makes, 1);
  EXPECT_EQ(value_in(asked(kept, "b"), [&] { return ++makes; }), 2) << "another name";
  EXPECT_EQ(value_in(asked(kept, "a"), [&] { return ++makes; }), 1) << "kept";
}

TEST(KeptValues, WhatWasForgottenIsMadeAnewBesideTheOneThatIsHeld) {
  MadeByName kept(100);
  const auto held = asked(kept, "a");
  EXPECT_EQ(value_in(held, [] { return 1; }), 1);
  for (const char* name : {"b", "c", "d"}) asked(kept, name);
  EXPECT_EQ(value_in(asked(kept, "a"), [] { return 3; }), 3);
  EXPECT_EQ(value_in(held, [] { return 4; }), 1);
}

/// A number that counts how many of its kind there are.
struct Counted : NotCopied {
  Counted(int its_number, std::atomic<int>& alive) : number(its_number), count(alive) { ++count; }
  ~Counted() { --count; }
  int number;
  std::atomic<int>& count;
};
using Versions = KeptValues<std::unique_ptr<Counted>>;

TEST(KeptValues, WhoHoldsWhatIsReplacedKeepsItAndTheLastOneEndsIt) {
  std::atomic<int> alive{0};
  Versions versions(1);
  versions.put("", std::make_unique<Counted>(1, alive), 0);
  {
    const auto old = versions.find("");
    const auto old_too = versions.find("");
    versions.put("", std::make_unique<Counted>(2, alive), 0);
    EXPECT_EQ((*old)->number, 1);
    EXPECT_EQ((*versions.find(""))->number, 2);
    EXPECT_EQ(alive, 2);
  }
  EXPECT_EQ(alive, 1);
  versions.put("", std::make_unique<Counted>(3, alive), 0);
  EXPECT_EQ(alive, 1);  // nobody had it
  EXPECT_EQ((*versions.find(""))->number, 3);
}

TEST(KeptValues, ManyTakeOneWhileItIsReplaced) {
  std::atomic<int> alive{0};
  std::atomic<bool> done{false};
  std::atomic<int> backwards{0};
  {
    Versions versions(1);
    versions.put("", std::make_unique<Counted>(0, alive), 0);
    std::vector<std::jthread> readers;
    for (int i = 0; i < 3; ++i) {
      readers.emplace_back([&] {
        for (int last = 0; !done;) {
          const auto now = versions.find("");
          backwards += (*now)->number < last ? 1 : 0;
          last = (*now)->number;
        }
      });
    }
    for (int i = 1; i <= 2000; ++i) versions.put("", std::make_unique<Counted>(i, alive), 0);
    done = true;
    readers.clear();
    EXPECT_EQ(alive, 1);
  }
  EXPECT_EQ(alive, 0);
  EXPECT_EQ(backwards, 0);
}

}  // namespace
}  // namespace warren::serve
