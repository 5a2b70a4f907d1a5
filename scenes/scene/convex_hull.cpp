// SPDX-License-Identifier: BSD-3-Clause
// Qhull sees the points moved to the origin and scaled to 1, by powers of two; what it says is taken as numbers of
// points alone, so corners are exact. Where there are many, every k-th point makes a chunk, and the hull of those so
// far takes one chunk after the other: each call is short, and a sample of the whole. Where qhull finds no hull, or one
// that points stand out of, as of a plane or a line, all points are corners: the same set.
#include "scenes/scene/convex_hull.hpp"

#include <fmt/format.h>
#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <optional>

#include "core/base/error.hpp"
#include "parallel/sort.hpp"

namespace warren {
namespace {

using HullNumbers = std::vector<std::uint32_t>;
using HullFace = std::array<std::uint32_t, 3>;

constexpr std::size_t hull_chunk = 30'000;
constexpr double hull_tolerance = 1e-9;

struct FoundHull {
  HullNumbers corners;  // in order
  std::vector<HullFace> faces;
};

/// One run of qhull, whose memory goes with it.
class QhullRun : NotCopied {
 public:
  /// Points, three numbers each, within [-1, 1], and their numbers, ascending, which it refers to.
  QhullRun(std::vector<double>& points, const HullNumbers& numbers)
      : numbers_(numbers), messages_(::fmemopen(nullptr, 4096, "w"), &std::fclose) {
    if (!messages_) throw std::bad_alloc();
    qh_zero(&qhull_, messages_.get());
    std::array<char, 12> command{"qhull Qt Pp"};
    const auto count = static_cast<int>(points.size() / 3);
    code_ = qh_new_qhull(&qhull_, 3, count, points.data(), False, command.data(), nullptr, messages_.get());
    if (code_ == qh_ERRmem) throw std::bad_alloc();
  }
  ~QhullRun() {
    int blocks = 0;
    int bytes = 0;
    qh_freeqhull(&qhull_, !qh_ALL);
    qh_memfreeshort(&qhull_, &blocks, &bytes);
  }

  /// Nothing: there is none, as of flat points.
  std::optional<FoundHull> hull() {
    if (code_ != 0 || qhull_.max_outside > hull_tolerance) return std::nullopt;
    FoundHull found;
    for (const vertexT* vertex = qhull_.vertex_list; vertex != nullptr && vertex->next != nullptr;
         vertex = vertex->next)
      found.corners.push_back(number_of(vertex));
    std::sort(found.corners.begin(), found.corners.end());
    for (const facetT* facet = qhull_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next)
      add_face(*facet, found.faces);
    std::sort(found.faces.begin(), found.faces.end());
    return found;
  }

 private:
  std::uint32_t number_of(const vertexT* vertex) {
    return numbers_[static_cast<std::size_t>(qh_pointid(&qhull_, vertex->point))];
  }
  /// Slivers say nothing of where outside is, and their neighbours cover them.
  void add_face(const facetT& facet, std::vector<HullFace>& faces) {
    std::array<const vertexT*, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = static_cast<vertexT*>(facet.vertices->e[i].p);
    const auto at = [&](std::size_t i) {
      return Vec3(corners[i]->point[0], corners[i]->point[1], corners[i]->point[2]);
    };
    const Vec3 first = at(1) - at(0);
    const Vec3 second = at(2) - at(0);
    const Vec3 normal = first.cross(second);
    constexpr double thinnest = 1e-10;
    if (!(normal.norm() > thinnest * std::max(first.squaredNorm(), second.squaredNorm()))) return;
    const bool outward = normal.dot(Vec3(facet.normal[0], facet.normal[1], facet.normal[2])) > 0.0;
    HullFace face{number_of(corners[0]), number_of(corners[outward ? 1 : 2]), number_of(corners[outward ? 2 : 1])};
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(face);
  }

  const HullNumbers& numbers_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
  qhT qhull_{};
  int code_ = 0;
};

/// Where points lie, to make them small.
struct HullFrame {
  Vec3 middle = Vec3::Zero();
  double scale = 1.0;

  explicit HullFrame(const std::vector<Vec3>& points) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    middle = 0.5 * box.min() + 0.5 * box.max();
    const double half = (box.max() - middle).cwiseAbs().maxCoeff();
    scale = half > 0.0 ? std::ldexp(1.0, -std::ilogb(half) - 1) : 1.0;
  }
};

/// The hull of some of the points, by their numbers.
std::optional<FoundHull> hull_of_some(const std::vector<Vec3>& points, const HullNumbers& some, const HullFrame& frame,
                                      const Execution& execution) {
  constexpr std::size_t qhull_bytes_a_point = 2048;
  execution.reserve(some.size() * qhull_bytes_a_point);
  execution.check();
  if (some.size() < 4) return std::nullopt;
  std::vector<double> small;
  small.reserve(3 * some.size());
  for (const std::uint32_t i : some) {
    const Vec3 p = (points[i] - frame.middle) * frame.scale;
    small.insert(small.end(), {p.x(), p.y(), p.z()});
  }
  return QhullRun(small, some).hull();
}

}  // namespace

std::vector<std::uint32_t> weld_points(std::vector<Vec3>& points, const Execution& execution) {
  execution.reserve(points.size() * (sizeof(Vec3) + 2 * sizeof(std::uint32_t)));
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) order[i] = i;
  polled_sort(order.begin(), order.end(), execution, [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(points[a].data(), points[a].data() + 3, points[b].data(), points[b].data() + 3);
  });
  std::vector<Vec3> distinct;
  std::vector<std::uint32_t> numbers(points.size());
  for (const std::uint32_t i : order) {
    if (distinct.empty() || distinct.back() != points[i]) distinct.emplace_back(points[i].array() + 0.0);  // no -0
    numbers[i] = static_cast<std::uint32_t>(distinct.size() - 1);
  }
  points = std::move(distinct);
  return numbers;
}

Solid convex_hull(std::span<const Vec3> points, const std::string& where, const Execution& execution) {
  execution.reserve(points.size() * sizeof(Vec3));
  std::vector<Vec3> distinct(points.begin(), points.end());
  weld_points(distinct, execution);
  const HullFrame frame(distinct);
  const std::size_t chunks = (distinct.size() + hull_chunk - 1) / hull_chunk;
  FoundHull hull;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    HullNumbers some = hull.corners;
    for (std::size_t i = chunk; i < distinct.size(); i += chunks) some.push_back(static_cast<std::uint32_t>(i));
    std::sort(some.begin(), some.end());
    std::optional<FoundHull> larger = hull_of_some(distinct, some, frame, execution);
    hull = larger ? std::move(*larger) : FoundHull{std::move(some), {}};
    if (hull.corners.size() > most_hull_corners) {
      throw InputError(
          where, fmt::format("its convex hull may have at most {} corners; make the mesh coarser", most_hull_corners));
    }
  }
  Solid solid;
  solid.kind = SolidKind::hull;
  std::vector<std::uint32_t> numbers(hull.faces.empty() ? 0 : distinct.size());
  for (const std::uint32_t corner : hull.corners) {
    if (!numbers.empty()) numbers[corner] = static_cast<std::uint32_t>(solid.corners.size());
    solid.corners.push_back(distinct[corner]);
  }
  for (HullFace face : hull.faces) {
    for (std::uint32_t& corner : face) corner = numbers[corner];
    solid.faces.push_back(face);
  }
  return solid;
}

double volume_inside(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles) {
  double six = 0.0;
  if (points.empty()) return six;
  const Vec3& origin = points[0];
  for (const auto& [a, b, c] : triangles) six += (points[a] - origin).cross(points[b] - origin).dot(points[c] - origin);
  return six / 6.0;
}

}  // namespace warren
