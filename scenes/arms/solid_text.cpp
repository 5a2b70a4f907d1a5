// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/arms/arm_files_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parallel/asked_memory.hpp"
#include "scenes/scene/convex_hull.hpp"

namespace warren {
namespace {

Vec3 point_at(std::span<const double> numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// A turn that takes z to the direction of `axis`, which is not zero: plain sums and products, so that it is the same
/// everywhere.
Eigen::Matrix3d turn_to(const Vec3& axis) {
  const double length = std::sqrt(axis.dot(axis));
  const Vec3 z = axis / length;
  const Vec3 side = std::abs(z.x()) < 0.75 ? Vec3::UnitX() : Vec3::UnitY();
  Vec3 y = z.cross(side);
  y /= std::sqrt(y.x() * y.x() + y.y() * y.y() + y.z() * y.z());
  Eigen::Matrix3d turn;
  turn.col(0) = y.cross(z);
  turn.col(1) = y;
  turn.col(2) = z;
  return turn;
}

void append_numbers(std::string& text, std::span<const double> numbers) {
  for (const double x : numbers) fmt::format_to(std::back_inserter(text), " {}", x + 0.0);  // no negative zeros
}

/// The numbers of a solid that no line gave.
std::vector<double> numbers_of(const Solid& solid) {
  std::vector<double> numbers;
  const auto add = [&](const Vec3& p) { numbers.insert(numbers.end(), p.begin(), p.end()); };
  const Vec3 middle = solid.pose.translation();
  const Vec3 reach = solid.half.z() * solid.pose.linear().col(2);  // of an axis
  if (solid.kind == SolidKind::hull) {
    for (const Vec3& corner : solid.corners) add(solid.pose * corner);
    return numbers;
  }
  if (solid.kind == SolidKind::cylinder || solid.kind == SolidKind::capsule) {
    add(middle - reach);
    add(middle + reach);
  } else {
    add(middle);
  }
  if (solid.kind == SolidKind::box) {
    for (const double x : quaternion_of_turn(solid.pose.linear())) numbers.push_back(x);
    add(solid.half);
  } else {
    numbers.push_back(solid.half.x());
  }
  return numbers;
}

}  // namespace

const SolidWord* solid_word_named(std::string_view name) {
  const auto* const found = std::ranges::find(solid_words, name, &SolidWord::name);
  return found == solid_words.end() ? nullptr : found;
}

Eigen::Isometry3d pose_of_numbers(std::span<const double> numbers) {
  std::array<double, 4> quaternion{};
  std::copy_n(numbers.begin() + 3, 4, quaternion.begin());
  auto& [x, y, z, w] = quaternion;
  const double most = std::max({std::abs(x), std::abs(y), std::abs(z), std::abs(w)});
  for (double& c : quaternion) c /= most;
  const double s = 2.0 / (x * x + y * y + z * z + w * w);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = point_at(numbers, 0);
  pose.linear() << 1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w),  //
      s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w),               //
      s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y);
  return pose;
}

std::array<double, 4> quaternion_of_turn(const Eigen::Matrix3d& turn) {
  // From the largest of the four squares, so that no root is of a difference of rounding errors.
  const double squares[] = {1.0 + turn(0, 0) - turn(1, 1) - turn(2, 2), 1.0 - turn(0, 0) + turn(1, 1) - turn(2, 2),
                            1.0 - turn(0, 0) - turn(1, 1) + turn(2, 2), 1.0 + turn(0, 0) + turn(1, 1) + turn(2, 2)};
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(squares) - squares);
  const double xy = turn(1, 0) + turn(0, 1);
  const double xz = turn(2, 0) + turn(0, 2);
  const double yz = turn(2, 1) + turn(1, 2);
  const double xw = turn(2, 1) - turn(1, 2);
  const double yw = turn(0, 2) - turn(2, 0);
  const double zw = turn(1, 0) - turn(0, 1);
  const double a = squares[largest];
  const double all[4][4] = {{a, xy, xz, xw}, {xy, a, yz, yw}, {xz, yz, a, zw}, {xw, yw, zw, a}};
  const double scale = 0.5 / std::sqrt(a);
  std::array<double, 4> quaternion{};
  for (std::size_t i = 0; i < 4; ++i) quaternion[i] = scale * all[largest][i];
  return quaternion;
}

Solid solid_of_numbers(const SolidWord& word, std::span<const double> numbers, const scene_text::Place& place,
                       const Execution& execution) {
  const auto check = [&](bool holds, std::string_view rule) {
    if (holds) return;
    std::string found;
    append_numbers(found, numbers);
    place.fail(fmt::format("`{}`: {}", word.name, rule), std::string_view(found).substr(1));
  };
  constexpr std::string_view radius_rule = "the radius must be at least 0";
  Solid solid;
  if (word.name == "sphere") {
    check(numbers[3] >= 0.0, radius_rule);
    solid.pose.translation() = point_at(numbers, 0);
    solid.half.x() = numbers[3];
  } else if (word.name == "box") {
    solid.kind = SolidKind::box;
    const Vec3 a = point_at(numbers, 0);
    const Vec3 b = point_at(numbers, 3);
    solid.pose.translation() = 0.5 * (a + b);
    solid.half = 0.5 * (b - a).cwiseAbs();
  } else if (word.name == "obox") {
    solid.kind = SolidKind::box;
    const bool is_turn = std::ranges::any_of(numbers.subspan(3, 4), [](double x) { return x != 0.0; });
    check(is_turn, "the quaternion QX QY QZ QW must not be 0 0 0 0");
    solid.pose = pose_of_numbers(numbers);
    solid.half = point_at(numbers, 7);
    check((solid.half.array() >= 0.0).all(), "half the sides HX HY HZ must be at least 0");
  } else if (word.name == "hull") {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < numbers.size(); i += 3) points.push_back(point_at(numbers, i));
    solid = convex_hull(points, place.text(), execution);
  } else {
    solid.kind = word.name == "capsule" ? SolidKind::capsule : SolidKind::cylinder;
    const Vec3 a = point_at(numbers, 0);
    const Vec3 b = point_at(numbers, 3);
    check(numbers[6] >= 0.0, radius_rule);
    check(word.name == "capsule" || a != b, "the two ends must differ");
    const Vec3 axis = b - a;
    const double length = std::sqrt(axis.dot(axis));
    if (length > 0.0) solid.pose.linear() = turn_to(axis);
    solid.pose.translation() = 0.5 * (a + b);
    solid.half = {numbers[6], 0.0, 0.5 * length};
  }
  solid.given.assign(numbers.begin(), numbers.end());
  return solid;
}

Solid read_solid(const SolidWord& word, scene_text::Fields& fields, const Execution& execution, bool may_have_name) {
  std::vector<double> numbers;
  const auto ends = [&] {
    return fields.done() || (may_have_name && !fields.number_follows() && scene_text::Fields(fields).word() == "as");
  };
  while (!ends()) {
    push_asked(numbers, fields.number(), execution);
    execution.poll(numbers.size());
  }
  const bool right = word.numbers > 0 ? numbers.size() == word.numbers : !numbers.empty() && numbers.size() % 3 == 0;
  if (!right) {
    fields.place().fail(fmt::format("expected `{}`", word.usage), scene_text::numbers_text(numbers.size()));
  }
  execution.reserve(3 * numbers.size() * sizeof(double));
  return solid_of_numbers(word, numbers, fields.place(), execution);
}

std::string solid_text(const Solid& solid) {
  const bool turned = solid.kind == SolidKind::box && solid.given.size() != 6;
  std::string text(turned ? "obox" : name_of(solid.kind));
  append_numbers(text, solid.given.empty() ? numbers_of(solid) : solid.given);
  return text;
}

}  // namespace warren
