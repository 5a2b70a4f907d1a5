// SPDX-License-Identifier: BSD-3-Clause
// The roles' colours as eyes see them that lack a kind of cone: Machado, Oliveira and Fernandes, "A
// physiologically-based model for simulation of color vision deficiency" (2009), severity 1, in linear light; distances
// in CIELAB.
#include "pictures/model/colors.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace warren {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

struct Eyes {
  std::string name;
  Matrix seen;
};

const std::array<Eyes, 4> all_eyes{
    {{"all cones", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
     {"protanopia",
      {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
     {"deuteranopia",
      {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
     {"tritanopia",
      {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}}};

Triple times(const Matrix& m, const Triple& v) {
  Triple out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

double linear(std::uint8_t value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Triple lab(Rgb color, const Matrix& seen) {
  Triple light = times(seen, {linear(color.red), linear(color.green), linear(color.blue)});
  for (double& c : light) c = std::clamp(c, 0.0, 1.0);
  const Matrix to_xyz{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
  Triple xyz = times(to_xyz, light);
  const Triple white{0.95047, 1.0, 1.08883};
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = xyz[i] / white[i];
    xyz[i] = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
  }
  return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

double difference(Rgb a, Rgb b, const Matrix& seen) {
  const Triple one = lab(a, seen);
  const Triple other = lab(b, seen);
  return std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
}

struct Role {
  std::string name;
  Rgb color;
};
const std::vector<Role> roles{{"wall", colors::wall},  {"polygon", colors::polygon},  {"outline", colors::outline},
                              {"edge", colors::layer}, {"tree", colors::search_tree}, {"path", colors::path},
                              {"body", colors::body},  {"start", colors::start},      {"goal", colors::goal}};

TEST(Colors, RolesKeepApartForAllEyes) {
  constexpr double clearly = 20.0;  // 2.3 is just noticeable
  for (const Eyes& eyes : all_eyes) {
    for (std::size_t i = 0; i < roles.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GT(difference(roles[i].color, roles[j].color, eyes.seen), clearly)
            << eyes.name << ": " << roles[i].name << ", " << roles[j].name;
      }
    }
  }
}

TEST(Colors, EveryRoleShowsOnPaper) {
  for (const Eyes& eyes : all_eyes) {
    for (const Role& role : roles) {
      EXPECT_GT(difference(role.color, colors::paper, eyes.seen), 12.0) << eyes.name << ": " << role.name;
    }
  }
}

TEST(Colors, CellsOfAMapKeepApartForAllEyes) {
  constexpr std::array<Rgb, 4> cells{colors::occupied_cell, colors::blocked_cell, colors::paper, colors::wall};
  for (const Eyes& eyes : all_eyes) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT(difference(cells[i], cells[j], eyes.seen), 20.0) << eyes.name;
    }
  }
}

TEST(Colors, SeriesKeepApartForAllCones) {
  for (std::size_t i = 0; i < colors::series.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(difference(colors::series[i], colors::series[j], all_eyes[0].seen), 20.0) << i << ", " << j;
    }
  }
}

/// The simulation notices: red and green of one lightness are one colour without cones for green.
TEST(Colors, TheSimulationSeesAConfusion) {
  const Rgb red{190, 100, 60};
  const Rgb green{120, 135, 60};
  EXPECT_GT(difference(red, green, all_eyes[0].seen), 40.0);
  EXPECT_LT(difference(red, green, all_eyes[2].seen), 12.0);
}

}  // namespace
}  // namespace warren
