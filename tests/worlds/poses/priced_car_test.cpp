// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/car_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "planners/shorten/redrive.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "tests/worlds/poses/steering_words.hpp"

namespace warren {
namespace {

using body_scenes::random_pose;

constexpr double radius = 0.7;

CarBody small_car(const Scene& scene) { return {scene, {.turning_radius = radius, .radius = 0.1}}; }

struct Driven {
  double price = 0.0;
  int first = 0;
  int last = 0;
};
/// Adds up anew what a way costs.
Driven added_up(const SteeringCurve& curve, const DrivingPrice& price) {
  Driven driven;
  for (std::size_t i = 0; i < curve.piece_count(); ++i) {
    const int gear = curve.piece(i).length < 0.0 ? -1 : 1;
    if (driven.first == 0) driven.first = gear;
    driven.price +=
        (driven.last == -gear ? price.cusp : 0.0) + (gear < 0 ? price.reverse : 1.0) * curve.piece_length(i);
    driven.last = gear;
  }
  return driven;
}

/// Its joints are rounded there, and what makes up for that is no change of gear.
TEST(PricedCar, PathsCostWhatTheirWaysDoFarFromTheOriginToo) {
  const Scene scene = body_scenes::scattered(1);
  const CarBody body = small_car(scene);
  const PricedCar car(body, {.cusp = 0.8, .reverse = 1.5});
  for (const double offset : {0.0, 1e3, 1e5, 3e5, 1e6, 1e7}) {
    for (std::uint64_t i = 0; i < 300; ++i) {
      Se2 a = random_pose(1, 2 * i);
      Se2 b = random_pose(1, 2 * i + 1);
      for (Se2* pose : {&a, &b}) *pose = {pose->x + offset, pose->y + offset, pose->theta};
      for (const PricedCurve& way : car.ways(a, b, 1e3)) {
        Path<Se2> path{a};
        PricedCar::append(path, way);
        ASSERT_NEAR(car.price(path), way.price, 1e-6) << offset << ' ' << i;
      }
    }
  }
}

TEST(PricedCar, WaysLeadToTheirEndInTheirGearsAtTheirPrice) {
  const Scene scene = body_scenes::scattered(1);
  const CarBody body = small_car(scene);
  const DrivingPrice price{.cusp = 0.8, .reverse = 1.5};
  const PricedCar car(body, price);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Se2 a = random_pose(1, 2 * i);
    const Se2 b = random_pose(1, 2 * i + 1);
    const auto ways = car.ways(a, b, 1e3);
    ASSERT_GE(ways.size(), 2U);  // either gear first
    double least = 1e3;
    for (const PricedCurve& way : ways) {
      SteeringWord word;
      for (std::size_t k = 0; k < way.curve.piece_count(); ++k) {
        word.add(way.curve.piece(k).steer, way.curve.piece(k).length);
      }
      const Se2 end = steering_words::integrated(a, word, radius);
      EXPECT_LT(distance(end.position(), b.position()), 1e-8);
      EXPECT_LT(std::abs(turn_between(end.theta, b.theta)), 1e-8);
      const Driven driven = added_up(way.curve, price);
      EXPECT_NEAR(way.price, driven.price, 1e-12);
      EXPECT_EQ(way.first_gear, driven.first);
      EXPECT_EQ(way.last_gear, driven.last);
      EXPECT_GE(way.price, car.distance(a, b) - 1e-12);
      least = std::min(least, way.price);
    }
    for (const PricedCurve& way : car.ways(a, b, least + 1e-9)) EXPECT_LE(way.price, least + 1e-9);
    EXPECT_TRUE(car.ways(a, b, least - 1e-9).empty());
  }
}

TEST(PricedCar, WithoutSurchargeTheCheapestWayIsTheShortest) {
  const Scene scene = body_scenes::scattered(1);
  const CarBody body = small_car(scene);
  const PricedCar car(body, {});
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Se2 a = random_pose(2, 2 * i);
    const Se2 b = random_pose(2, 2 * i + 1);
    double least = 1e3;
    for (const PricedCurve& way : car.ways(a, b, 1e3)) least = std::min(least, way.price);
    EXPECT_NEAR(least, car.distance(a, b), 1e-9);
  }
}

/// A path through random free poses whose shortest curves are free.
Path<Se2> wandering(const PricedCar& car, std::uint64_t seed, std::size_t legs) {
  Path<Se2> path;
  auto query = car.make_query();
  for (std::uint64_t i = 0; path.size() < legs && i < 100'000; ++i) {
    const Se2 pose = random_pose(seed, i);
    if (!car.is_free(pose, query)) continue;
    bool joined = path.empty();
    if (!joined) {
      for (const PricedCurve& way : car.ways(path.back(), pose, car.distance(path.back(), pose) * (1.0 + 1e-9))) {
        joined = joined || car.is_free_way(way, query);
      }
    }
    if (joined) path.push_back(pose);
  }
  return path;
}

TEST(RedrivenPath, IsNeverDearerAndFreeAndTheSameEachTime) {
  const Scene scene = body_scenes::scattered(3);
  const CarBody body = small_car(scene);
  const PricedCar free_of_charge(body, {});
  for (const std::size_t legs : {std::size_t{2}, std::size_t{9}, std::size_t{50}}) {
    const Path<Se2> path = wandering(free_of_charge, legs, legs);
    ASSERT_EQ(path.size(), legs);
    const PricedCar car(body, {.cusp = 1.0, .reverse = 1.2});
    Counters counters;
    const Path<Se2> cheaper = redriven_path(car, path, {.seed = 5, .rounds = 3}, {}, counters);
    EXPECT_EQ(cheaper.front(), path.front());
    EXPECT_EQ(cheaper.back(), path.back());
    EXPECT_LE(car.price(cheaper), car.price(path));
    EXPECT_LT(car.price(cheaper), (legs == 2 ? 1.0 + 1e-9 : 0.9) * car.price(path)) << "it wanders";
    auto query = car.make_query();
    for (std::size_t i = 1; i < cheaper.size(); ++i) {
      const SteeringWord word = ReedsSheppCurve::shortest(cheaper[i - 1], cheaper[i], radius);
      EXPECT_TRUE(body.is_free_curve({cheaper[i - 1], cheaper[i], word, radius}, query)) << i;
    }
    EXPECT_EQ(redriven_path(car, path, {.seed = 5, .rounds = 3}, {}, counters), cheaper);
  }
}

TEST(RedrivenPath, WhatCostsItsLengthAloneStaysAsItIs) {
  const Scene scene = body_scenes::scattered(3);
  const CarBody body = small_car(scene);
  const PricedCar car(body, {.cusp = 0.0, .reverse = 1.0});
  const Path<Se2> path = wandering(car, 4, 9);
  Counters counters;
  EXPECT_EQ(redriven_path(car, path, {}, {}, counters), path);
  EXPECT_EQ(counters.edges_checked, 0U);
}

}  // namespace
}  // namespace warren
