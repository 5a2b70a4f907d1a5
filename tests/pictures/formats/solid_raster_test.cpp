// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/raster.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace warren {
namespace {

constexpr Rgb red{200, 0, 0};
constexpr Rgb blue{0, 0, 200};

SolidView view_along_x() {
  SolidView view;
  view.target = Vec3::Zero();
  view.floor = {-2.0, -2.0, -1.0};
  view.floor_side = 4.0;
  view.square = 0.5;
  return view;
}

/// Is the pixel more red than blue, more blue than red, or neither?
int tint(const Image& image, std::size_t x, std::size_t y) {
  const std::uint8_t* p = image.row(y) + 3 * x;
  return std::abs(p[0] - p[2]) < 20 ? 0 : p[0] > p[2] ? 1 : -1;
}

TEST(SolidRaster, WhatIsNearerHidesWhatIsFarInAnyOrder) {
  SolidView view = view_along_x();
  const SeenSolid near{{0.5, 0, 0}, {0.5, 0, 0}, 0.2, red, Part::body};
  const SeenSolid far{{-0.5, -0.5, -0.4}, {-0.4, 0.5, 0.4}, -1.0, blue, Part::world};
  for (const bool near_first : {true, false}) {
    view.solids = near_first ? std::vector{near, far} : std::vector{far, near};
    const Image image = draw_solids(view, Parts::all(), 100, 100, {});
    EXPECT_EQ(tint(image, 50, 50), 1) << "the eye is on the x axis";
    EXPECT_EQ(tint(image, 35, 50), -1);
    EXPECT_EQ(tint(image, 50, 2), 0) << "paper";
  }
}

TEST(SolidRaster, WhatAnObstacleHidesIsSeenThroughIt) {
  const SeenSolid front{{0.4, -0.5, -0.4}, {0.5, 0.5, 0.4}, -1.0, blue, Part::world};
  const SeenSolid behind{{-0.5, 0, 0}, {-0.5, 0, 0}, 0.2, red, Part::body};
  SolidView view = view_along_x();
  view.solids = {front};
  const Image alone = draw_solids(view, Parts::all(), 100, 100, {});
  view.solids.push_back(behind);
  const Image both = draw_solids(view, Parts::all(), 100, 100, {});
  EXPECT_GT(both.row(50)[150], alone.row(50)[150] + 20) << "redder in the middle";
  EXPECT_EQ(both.row(50)[90], alone.row(50)[90]) << "and as it was beside it";
}

TEST(SolidRaster, AFaceIsMetFromOutsideWhereItIs) {
  const SeenSolid face{{0, 0, 0}, {0, 1, 0}, -1.0, red, Part::body, Vec3{0, 0, 1}};
  const SeenSolid back{{0, 0, 0}, {0, 0, 1}, -1.0, red, Part::body, Vec3{0, 1, 0}};
  EXPECT_EQ(normal_at({0, 0.1, 0.1}, face), Vec3(1, 0, 0));
  const Vec3 eye{3, 0.5, -0.5};
  for (double y = -0.95; y < 2.0; y += 0.1) {
    for (double z = -0.95; z < 2.0; z += 0.1) {
      const Vec3 way = Vec3(0, y, z) - eye;
      const double t = enter_solid(eye, way.normalized(), face);
      if (y > 0.0 && z > 0.0 && y + z < 1.0) {
        EXPECT_NEAR(t, way.norm(), 1e-12);
      } else if (y < 0.0 || z < 0.0 || y + z > 1.0) {
        EXPECT_FALSE(std::isfinite(t)) << y << " " << z;
      }
      EXPECT_FALSE(std::isfinite(enter_solid(eye, way.normalized(), back))) << "from inside";
    }
  }
}

TEST(SolidRaster, PartsThatAreNotShownAreNotThere) {
  SolidView view = view_along_x();
  view.solids = {{{0, 0, 0}, {0, 0, 0}, 0.3, red, Part::body}};
  EXPECT_EQ(tint(draw_solids(view, {Part::world}, 60, 60, {}), 30, 30), 0);
}

TEST(SolidRaster, TinyAndHugeWorldsLookAlike) {
  const auto drawn = [](double scale) {
    SolidView view = view_along_x();
    view.rise_rad = 0.4;
    view.reach = scale;
    view.target = {7.0 * scale, 0, 0};
    view.floor = {5.0 * scale, -2.0 * scale, -scale};
    view.floor_side = 4.0 * scale;
    view.square = 0.5 * scale;
    view.solids = {{{6.5 * scale, 0, 0}, {7.25 * scale, 0.5 * scale, 0}, 0.25 * scale, red, Part::body}};
    return draw_solids(view, Parts::all(), 64, 48, {});
  };
  const Image usual = drawn(1.0);
  for (const double scale : {0x1p-40, 0x1p40}) {
    const Image other = drawn(scale);
    for (std::size_t y = 0; y < 48; ++y) {
      ASSERT_TRUE(std::equal(usual.row(y), usual.row(y) + 3 * 64, other.row(y))) << scale << ", row " << y;
    }
  }
}

/// The place that a ray enters is on the surface, and nothing of the solid is before it.
TEST(SolidRays, EnterAtTheFirstPlaceOfTheSurface) {
  const SeenSolid swept{{-0.5, 0.1, 0.2}, {0.4, -0.3, 0.1}, 0.25, red, Part::body};
  const auto distance_to_spine = [&](const Vec3& p) {
    const Vec3 along = swept.b - swept.a;
    const double t = std::clamp(along.dot(p - swept.a) / along.squaredNorm(), 0.0, 1.0);
    return (p - swept.a - t * along).norm();
  };
  const Vec3 eye{3.0, 1.0, 2.0};
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 aim{-0.8 + 0.08 * (i % 20), -0.6 + 0.06 * (i / 20), 0.1};  // NOLINT(bugprone-integer-division)
    const Vec3 ray = (aim - eye).normalized();
    const double t = enter_solid(eye, ray, swept);
    double nearest = 1e9;
    for (double s = 0.0; s < 6.0; s += 0.01) nearest = std::min(nearest, distance_to_spine(eye + s * ray));
    if (!std::isfinite(t)) {
      EXPECT_GT(nearest, 0.25 - 1e-9) << i;
      continue;
    }
    ++hits;
    EXPECT_NEAR(distance_to_spine(eye + t * ray), 0.25, 1e-9) << i;
    EXPECT_GT(distance_to_spine(eye + (t - 0.01) * ray), 0.25) << i;
    EXPECT_NEAR(normal_at(eye + t * ray, swept).norm(), 1.0, 1e-9);
  }
  EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace warren
