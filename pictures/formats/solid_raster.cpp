// SPDX-License-Identifier: BSD-3-Clause
// A ray a sample, two by two samples a pixel. Each solid asks the rays of the pixels around its own picture for the
// place where they enter it; of each ray the nearest place is kept, with whose it is, and shaded at the end: of the
// world and of all else apart, so that what an obstacle hides is seen through it. All lengths are in reaches of the
// view, so tiny and huge worlds look alike.

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/trigonometry.hpp"
#include "pictures/formats/raster.hpp"

namespace warren {
namespace {

constexpr std::size_t samples_a_side = 2;  // of a pixel
constexpr std::size_t solids_a_poll = 256;
constexpr std::uint32_t nobody = ~std::uint32_t{0};

/// Where on the raster a solid may be: in a box, half as large as `half`, whose middle is between a and b.
struct Reach {
  Vec2 a;
  Vec2 b;
  Vec2 half;

  /// Left and right in the row at that height.
  Vec2 in_row(double y) const {
    double from = 0.0;
    double to = 1.0;
    if (const double fall = b.y - a.y; fall != 0.0) {
      const double one = (y - half.y - a.y) / fall;
      const double two = (y + half.y - a.y) / fall;
      from = std::clamp(std::min(one, two), 0.0, 1.0);
      to = std::clamp(std::max(one, two), 0.0, 1.0);
    }
    const double p = a.x + from * (b.x - a.x);
    const double q = a.x + to * (b.x - a.x);
    return {std::min(p, q) - half.x, std::max(p, q) + half.x};
  }
};

struct Nearest {
  RawVector<float> depth;
  RawVector<std::uint32_t> whose;
};

class SolidRaster {
 public:
  SolidRaster(const SolidView& view, Parts parts, std::size_t width, std::size_t height, const Execution& execution)
      : execution_(execution), columns_(samples_a_side * width), rows_(samples_a_side * height) {
    const std::size_t count = columns_ * rows_;
    execution.reserve(2 * count * (sizeof(float) + sizeof(std::uint32_t)));
    take_camera(view);
    take_solids(view, parts);
    for (Nearest& nearest : nearest_) {
      nearest.depth.resize(count);
      nearest.whose.resize(count);
      for (std::size_t row = 0; row < rows_; ++row) {
        if (row % 64 == 0) execution.check();
        std::fill_n(nearest.depth.data() + row * columns_, columns_, std::numeric_limits<float>::infinity());
        std::fill_n(nearest.whose.data() + row * columns_, columns_, nobody);
      }
    }
  }

  Image draw() {
    for (std::uint32_t i = 0; i < solids_.size(); ++i) {
      if (i % solids_a_poll == 0) execution_.check();
      mark(i);
    }
    Image image(columns_ / samples_a_side, rows_ / samples_a_side, execution_);
    for (std::size_t y = 0; y < image.height(); ++y) {
      execution_.check();
      for (std::size_t x = 0; x < image.width(); ++x) resolve(x, y, image.row(y) + 3 * x);
    }
    return image;
  }

 private:
  static constexpr std::size_t shadow_side = 512;

  void take_camera(const SolidView& view) {
    const Vec3 from{portable::cos(view.rise_rad) * portable::cos(view.azimuth_rad),
                    portable::cos(view.rise_rad) * portable::sin(view.azimuth_rad), portable::sin(view.rise_rad)};
    eye_ = eye_distance * from;
    forward_ = -from;
    right_ = {-portable::sin(view.azimuth_rad), portable::cos(view.azimuth_rad), 0.0};
    up_ = right_.cross(forward_);
    const double seen_reach = 1.0 / std::sqrt(eye_distance * eye_distance - 1.0);
    zoom_ = 0.5 * static_cast<double>(std::min(columns_, rows_)) / seen_reach;
  }
  void take_solids(const SolidView& view, Parts parts) {
    const auto near = [&](const Vec3& p) -> Vec3 { return (p - view.target) / view.reach; };
    floor_ = near(view.floor);
    floor_side_ = view.floor_side / view.reach;
    square_ = view.square / view.reach;
    shadows_ = Mask(shadow_side, shadow_side, execution_);
    execution_.reserve(view.solids.size() * sizeof(SeenSolid));
    for (std::size_t i = 0; i < view.solids.size(); ++i) {
      if (i % solids_a_poll == 0) execution_.check();
      const SeenSolid& s = view.solids[i];
      if (!parts.has(s.part)) continue;
      solids_.push_back({near(s.a), near(s.b), s.radius / view.reach, s.color, s.part});
      if (s.c) solids_.back().c = near(*s.c);
      take_shadow(solids_.back());
    }
  }

  /// The light falls straight down, as far as shadows go.
  void take_shadow(const SeenSolid& s) {
    const Vec2 a = shadow_place(s.a);
    const Vec2 b = shadow_place(s.b);
    if (s.radius < 0.0) {
      PolygonSet outline;
      s.c ? outline.add(std::array{a, b, shadow_place(*s.c)}) : outline.add(Box{a, b}.corners());
      return shadows_.fill(outline, 1.0, execution_);
    }
    shadows_.draw_line(a, b, 2.0 * s.radius / floor_side_ * static_cast<double>(shadow_side), 1.0);
  }
  /// Asks the rays of the samples that the solid may cover.
  void mark(std::uint32_t i) {
    const SeenSolid& s = solids_[i];
    Nearest& nearest = nearest_[s.part == Part::world ? 0 : 1];
    const Reach reach = reach_of(s);
    const std::size_t end = pixel_at(std::ceil(std::max(reach.a.y, reach.b.y) + reach.half.y), rows_);
    for (std::size_t row = pixel_at(std::floor(std::min(reach.a.y, reach.b.y) - reach.half.y), rows_); row < end;
         ++row) {
      if (row % 32 == 0) execution_.check();
      const Vec2 columns = reach.in_row(static_cast<double>(row) + 0.5);
      const std::size_t last = pixel_at(std::ceil(columns.y), columns_);
      for (std::size_t column = pixel_at(std::floor(columns.x), columns_); column < last; ++column) {
        const Vec3 way = ray(row, column);
        const double t = enter_solid(eye_, way, s);
        const std::size_t sample = row * columns_ + column;
        if (!(t > 0.0) || !(static_cast<float>(t) < nearest.depth[sample])) continue;
        nearest.depth[sample] = static_cast<float>(t);
        nearest.whose[sample] = i;
      }
    }
  }

  /// Around the picture of a ball, in samples.
  Box box_around(const Vec3& p, double radius) const {
    constexpr double nearest = 1e-3;
    const Vec3 at = seen(p);
    const Vec2 middle{0.5 * static_cast<double>(columns_), 0.5 * static_cast<double>(rows_)};
    Box box;
    for (const double depth : {std::max(at.z() - radius, nearest), std::max(at.z() + radius, nearest)}) {
      for (const double way : {-radius, radius}) {
        box.include(Vec2{middle.x + zoom_ * (at.x() + way) / depth, middle.y - zoom_ * (at.y() + way) / depth});
      }
    }
    return box;
  }
  Reach reach_of(const SeenSolid& s) const {
    const auto middle = [](const Box& box) { return 0.5 * (box.min + box.max); };
    if (s.radius < 0.0) {
      Box box;
      for_each_point(s, [&](const Vec3& p, double) { box.include(box_around(p, 0.0)); });
      return {middle(box), middle(box), 0.5 * (box.max - box.min)};
    }
    const Box a = box_around(s.a, s.radius);
    const Box b = box_around(s.b, s.radius);
    return {middle(a), middle(b), {0.5 * std::max(a.width(), b.width()), 0.5 * std::max(a.height(), b.height())}};
  }

  void resolve(std::size_t x, std::size_t y, std::uint8_t* pixel) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < samples_a_side * samples_a_side; ++k) {
      sum += color_of(samples_a_side * y + k / samples_a_side, samples_a_side * x + k % samples_a_side);
    }
    constexpr double share = 1.0 / (samples_a_side * samples_a_side);
    for (int c = 0; c < 3; ++c)
      pixel[c] = static_cast<std::uint8_t>(std::lround(std::clamp(share * sum[c], 0.0, 255.0)));
  }
  Vec3 color_of(std::size_t row, std::size_t column) const {
    const Vec3 way = ray(row, column);
    const std::size_t sample = row * columns_ + column;
    const auto& [world, rest] = nearest_;
    if (world.whose[sample] == nobody && rest.whose[sample] == nobody) return floor_color(way);
    if (!(world.depth[sample] < rest.depth[sample])) return lit(rest, sample, way);
    const Vec3 color = lit(world, sample, way);
    constexpr double through = 0.4;
    return rest.whose[sample] == nobody ? color : Vec3(color + through * (lit(rest, sample, way) - color));
  }
  Vec3 lit(const Nearest& nearest, std::size_t sample, const Vec3& way) const {
    const SeenSolid& s = solids_[nearest.whose[sample]];
    const double depth = nearest.depth[sample];
    const Vec3 normal = normal_at(eye_ + depth * way, s);
    // From the left, above, and from where the eye is.
    const Vec3 light = (-0.45 * right_ + 0.75 * Vec3::UnitZ() - 0.6 * forward_).normalized();
    constexpr double darkest = 0.5;
    const double bright = darkest + (1.0 - darkest) * std::max(0.0, normal.dot(light));
    constexpr double shine = 0.25;
    const double glance = std::max(0.0, normal.dot((light - way).normalized()));
    const double square = glance * glance;
    const double gloss = shine * square * square * square * square;
    const Vec3 color = ink(s.color) * bright;
    return in_air(color + gloss * (ink(colors::paper) - color), depth);
  }

  Vec3 floor_color(const Vec3& ray) const {
    const Vec3 paper = ink(colors::paper);
    const double t = (floor_.z() - eye_.z()) / ray.z();
    if (!(t > 0.0)) return paper;
    const Vec3 at = eye_ + t * ray;
    const Vec2 place = shadow_place(at);
    const double side = static_cast<double>(shadow_side);
    if (!(place.x >= 0.0 && place.y >= 0.0 && place.x < side && place.y < side)) return paper;
    const auto x = static_cast<std::int64_t>(std::floor((at.x() - floor_.x()) / square_));
    const auto y = static_cast<std::int64_t>(std::floor((at.y() - floor_.y()) / square_));
    constexpr Rgb even{244, 245, 247};
    constexpr Rgb odd{232, 235, 239};
    const std::uint8_t dark =
        shadows_.pixels()[static_cast<std::size_t>(place.y) * shadow_side + static_cast<std::size_t>(place.x)];
    constexpr double shadow = 0.22 / 255.0;
    return in_air(ink((x + y) % 2 == 0 ? even : odd) * (1.0 - shadow * dark), t);
  }

  /// From the eye, of length 1.
  Vec3 ray(std::size_t row, std::size_t column) const {
    const double u = (static_cast<double>(column) + 0.5 - 0.5 * static_cast<double>(columns_)) / zoom_;
    const double v = (0.5 * static_cast<double>(rows_) - static_cast<double>(row) - 0.5) / zoom_;
    return (forward_ + u * right_ + v * up_).normalized();
  }
  /// Right, up and deep, as the eye sees it.
  Vec3 seen(const Vec3& p) const { return {right_.dot(p - eye_), up_.dot(p - eye_), forward_.dot(p - eye_)}; }
  Vec2 shadow_place(const Vec3& p) const {
    const double scale = static_cast<double>(shadow_side) / floor_side_;
    return {scale * (p.x() - floor_.x()), scale * (p.y() - floor_.y())};
  }
  static Vec3 ink(Rgb c) { return {double(c.red), double(c.green), double(c.blue)}; }
  /// What is far is paler.
  static Vec3 in_air(const Vec3& color, double depth) {
    constexpr double most = 0.5;
    const double share = most * std::clamp(0.5 * (depth - eye_distance + 1.0), 0.0, 1.0);
    return color + share * (ink(colors::paper) - color);
  }

  const Execution& execution_;
  std::size_t columns_;
  std::size_t rows_;
  Vec3 eye_;
  Vec3 forward_;
  Vec3 right_;
  Vec3 up_;
  double zoom_ = 1.0;  // samples a unit at depth 1
  Vec3 floor_;
  double floor_side_ = 1.0;
  double square_ = 1.0;
  std::vector<SeenSolid> solids_;
  Mask shadows_{1, 1, {}};
  std::array<Nearest, 2> nearest_;  // of the world, of all else
};

constexpr double no_hit = std::numeric_limits<double>::infinity();

/// Where a ray enters a ball that goes from a to b; no_hit where it passes by.
double enter_ball(const Vec3& eye, const Vec3& ray, const Vec3& centre, double radius) {
  const Vec3 off = eye - centre;
  const double b = off.dot(ray);
  const double root = b * b - off.squaredNorm() + radius * radius;
  return root < 0.0 ? no_hit : -b - std::sqrt(root);
}
double enter_swept_ball(const Vec3& eye, const Vec3& ray, const SeenSolid& s) {
  const Vec3 along = s.b - s.a;
  const Vec3 off = eye - s.a;
  const double along_sq = along.squaredNorm();
  if (along_sq <= 0.0) return enter_ball(eye, ray, s.a, s.radius);
  const double along_ray = along.dot(ray);
  const double along_off = along.dot(off);
  const double a = along_sq - along_ray * along_ray;
  const double b = along_sq * ray.dot(off) - along_off * along_ray;
  const double c = along_sq * (off.squaredNorm() - s.radius * s.radius) - along_off * along_off;
  const double root = b * b - a * c;
  if (a > 0.0 && root >= 0.0) {
    const double t = (-b - std::sqrt(root)) / a;
    const double place = along_off + t * along_ray;
    if (place > 0.0 && place < along_sq) return t;
  }
  return std::min(enter_ball(eye, ray, s.a, s.radius), enter_ball(eye, ray, s.b, s.radius));
}
double enter_box(const Vec3& eye, const Vec3& ray, const SeenSolid& s) {
  double from = -no_hit;
  double to = no_hit;
  for (int k = 0; k < 3; ++k) {
    if (ray[k] == 0.0) {
      if (eye[k] < s.a[k] || eye[k] > s.b[k]) return no_hit;
      continue;
    }
    const double one = (s.a[k] - eye[k]) / ray[k];
    const double two = (s.b[k] - eye[k]) / ray[k];
    from = std::max(from, std::min(one, two));
    to = std::min(to, std::max(one, two));
  }
  return from <= to ? from : no_hit;
}
/// Anticlockwise seen from the eye; sides that two faces share are asked alike, so that no ray passes between them.
double enter_face(const Vec3& eye, const Vec3& ray, const SeenSolid& s) {
  const Vec3 a = s.a - eye;
  const Vec3 b = s.b - eye;
  const Vec3 c = *s.c - eye;
  const double volume = a.dot(b.cross(c));
  if (!(volume < 0.0)) return no_hit;
  const double at_a = ray.dot(b.cross(c));
  const double at_b = ray.dot(c.cross(a));
  const double at_c = ray.dot(a.cross(b));
  return at_a <= 0.0 && at_b <= 0.0 && at_c <= 0.0 ? volume / (at_a + at_b + at_c) : no_hit;
}
}  // namespace

Image draw_solids(const SolidView& view, Parts parts, std::size_t width, std::size_t height,
                  const Execution& execution) {
  return SolidRaster(view, parts, width, height, execution).draw();
}

double enter_solid(const Vec3& eye, const Vec3& ray, const SeenSolid& s) {
  if (s.c) return enter_face(eye, ray, s);
  return s.radius < 0.0 ? enter_box(eye, ray, s) : enter_swept_ball(eye, ray, s);
}

Vec3 normal_at(const Vec3& p, const SeenSolid& s) {
  if (s.c) return (s.b - s.a).cross(*s.c - s.a).normalized();
  if (s.radius < 0.0) {
    const Vec3 half = 0.5 * (s.b - s.a);
    const Vec3 off = p - 0.5 * (s.a + s.b);
    Vec3 shares;
    for (int k = 0; k < 3; ++k) shares[k] = half[k] > 0.0 ? std::abs(off[k]) / half[k] : 1.0;
    int face = 0;
    shares.maxCoeff(&face);  // the first of equal ones
    Vec3 normal = Vec3::Zero();
    normal[face] = off[face] < 0.0 ? -1.0 : 1.0;
    return normal;
  }
  const Vec3 along = s.b - s.a;
  const double along_sq = along.squaredNorm();
  const double place = along_sq > 0.0 ? std::clamp(along.dot(p - s.a) / along_sq, 0.0, 1.0) : 0.0;
  return (p - s.a - place * along) / s.radius;
}

}  // namespace warren
