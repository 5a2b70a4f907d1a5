// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/graphs/route_graph.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/error.hpp"
#include "solve/solve.hpp"
#include "tests/apps/serve/town.hpp"

namespace warren::serve {
namespace {

constexpr const char* gap = "bounds 0 0 20 10\nwall 10 0 10 4\nwall 10 6 10 10\n";  // a door of 2, from 4 to 6

/// The judge of the door for a body.
class AtTheDoor {
 public:
  explicit AtTheDoor(const std::string& robot, double clearance = 0.0)
      : scene_(scene_of(gap)), judge_(scene_, *scene_.bounds, robot_value("robot", robot), clearance) {}
  EdgeVerdict asked(const EdgePlace& from, const EdgePlace& to) const { return judge_.judge({{from, to}}, {}).front(); }
  bool is_free(const EdgePlace& from, const EdgePlace& to) const { return asked(from, to).free; }

 private:
  Scene scene_;
  EdgeJudge judge_;
};

TEST(EdgeJudge, ADiscGoesWhereItsRadiusAndClearanceFit) {
  EXPECT_TRUE(AtTheDoor("disc 0.9").is_free({{5, 5}}, {{15, 5}}));
  EXPECT_FALSE(AtTheDoor("disc 1.1").is_free({{5, 5}}, {{15, 5}}));
  EXPECT_FALSE(AtTheDoor("disc 0.9", 0.2).is_free({{5, 5}}, {{15, 5}}));
  EXPECT_NEAR(AtTheDoor("disc 0.75").asked({{5, 5}}, {{15, 5}}).clearance, 0.25, 1e-12);
  const EdgeVerdict near = AtTheDoor("disc 0.5").asked({{5, 5.75}}, {{15, 5.75}});
  EXPECT_EQ(near.by.substr(0, 6), "wall 1");
  EXPECT_EQ(near.distance, 0.25);
  EXPECT_EQ(near.needed, 0.5);
  EXPECT_EQ(words_of(near), near.by + " is 0.25 away, and 0.5 is needed");
}

TEST(EdgeJudge, ABodyWithoutHeadingsTurnsAtTheEndsAndFacesAlong) {
  const AtTheDoor rod("polygon -2 -0.1 2 -0.1 2 0.1 -2 0.1");
  EXPECT_TRUE(rod.is_free({{5, 5}}, {{15, 5}}));       // through the door, lengthways
  EXPECT_FALSE(rod.is_free({{5, 5}}, {{10, 5}}));      // it can't turn in it
  EXPECT_FALSE(rod.is_free({{10, 5}}, {{15, 5}}));     // nor there
  EXPECT_FALSE(rod.is_free({{1, 5}}, {{5, 5}}));       // nor beside the bounds
  EXPECT_TRUE(rod.is_free({{10, 5}, 0.0}, {{15, 5}}))  // but stands in it
      << words_of(rod.asked({{10, 5}, 0.0}, {{15, 5}}));
}

TEST(EdgeJudge, BetweenHeadingsABodyTurnsEvenly) {
  const AtTheDoor rod("polygon -2 -0.1 2 -0.1 2 0.1 -2 0.1");
  EXPECT_TRUE(rod.is_free({{5, 5}, 0.0}, {{15, 5}, 0.0}));
  EXPECT_FALSE(rod.is_free({{5, 5}, 0.5 * std::numbers::pi}, {{15, 5}, 0.5 * std::numbers::pi}));
  EXPECT_FALSE(rod.is_free({{5, 5}, 0.0}, {{15, 5}, std::numbers::pi - 0.01}));
}

TEST(EdgeJudge, NothingIsFreeOutsideOfTheWorldHoweverFar) {
  for (const double far : {20.5, 1e9, 1e60}) {
    SCOPED_TRACE(far);
    for (const char* robot : {"point", "polygon -1 0 1 0 0 1"}) {
      EXPECT_FALSE(AtTheDoor(robot).is_free({{5, 5}}, {{far, 5}}));
    }
  }
}

TEST(EdgeJudge, CarsAndArmsHaveNoEdges) {
  EXPECT_THROW(AtTheDoor("car radius 0.1 turning 1").is_free({{5, 5}}, {{15, 5}}), UsageError);
  EXPECT_THROW(AtTheDoor("puma560 radius 0.1").is_free({{5, 5}}, {{15, 5}}), UsageError);
}

TEST(EdgeJudge, SaysOfEdgesWhatVerifySaysOfPaths) {
  const AtTheDoor judge("disc 0.3", 0.1);
  const Scene scene = scene_of(gap);
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const Vec2 a{0.5 + i % 20, 0.5 + (i / 20) % 10};
    const Vec2 b{19.5 - (7 * i) % 20, 0.5 + (3 * i) % 10};
    RecordedAnswer path;
    path.file = "path";
    path.path = {a, b};
    const Question question{robot_value("robot", "disc 0.3"), {a.x, a.y}, {b.x, b.y}, 0.1};
    EXPECT_EQ(judge.is_free({a}, {b}), verify(scene, path, question).verified);
  }
}

}  // namespace
}  // namespace warren::serve
