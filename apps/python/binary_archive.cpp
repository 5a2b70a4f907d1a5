// SPDX-License-Identifier: BSD-3-Clause
#include "apps/python/bind.hpp"

#include <cstring>
#include <tuple>
#include <variant>

#include "core/base/error.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

constexpr std::string_view head = "warren.pickle/" WARREN_VERSION "\n";

class BytesOut {
 public:
  static constexpr bool reads = false;
  void block(const void* from, std::size_t n) { text_.append(static_cast<const char*>(from), n); }
  std::size_t count(std::size_t n) {
    block(&n, sizeof n);
    return n;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_{head};
};

class BytesIn {
 public:
  static constexpr bool reads = true;
  explicit BytesIn(std::string_view text) : text_(text) {
    if (!text_.starts_with(head)) throw InputError("pickle", "is of another version of warren");
    text_.remove_prefix(head.size());
  }
  void block(void* to, std::size_t n) {
    if (n > text_.size()) throw InputError("pickle", "is cut off");
    if (n > 0) std::memcpy(to, text_.data(), n);
    text_.remove_prefix(n);
  }
  /// Of elements, each of which takes a byte at least.
  std::size_t count(std::size_t) {
    std::size_t n = 0;
    block(&n, sizeof n);
    if (n > text_.size()) throw InputError("pickle", "is cut off");
    return n;
  }
  void check_end() const {
    if (!text_.empty()) throw InputError("pickle", "is damaged");
  }

 private:
  std::string_view text_;
};

template <class Ar, class... Members>
void all(Ar& ar, Members&... members) {
  (put(ar, members), ...);
}

template <class Ar, class T>
requires std::is_trivially_copyable_v<T>
void put(Ar& ar, T& value) { ar.block(&value, sizeof value); }

template <class Ar, class T, class Allocator>
void put(Ar& ar, std::vector<T, Allocator>& list) {
  const std::size_t n = ar.count(list.size());
  if constexpr (Ar::reads) list.resize(n);
  if constexpr (std::is_trivially_copyable_v<T>) {
    ar.block(list.data(), n * sizeof(T));
  } else {
    for (T& item : list) put(ar, item);
  }
}

template <class Ar>
void put(Ar& ar, std::string& text) {
  const std::size_t n = ar.count(text.size());
  if constexpr (Ar::reads) text.resize(n);
  ar.block(text.data(), n);
}

template <class Ar, class T>
requires(!std::is_trivially_copyable_v<T>) void put(Ar& ar, std::optional<T>& value) {
  bool has = value.has_value();
  put(ar, has);
  if constexpr (Ar::reads) {
    if (has) value.emplace();
  }
  if (has) put(ar, *value);
}

template <class Ar, class... Ts>
requires(!std::is_trivially_copyable_v<std::variant<Ts...>>) void put(Ar& ar, std::variant<Ts...>& value) {
  std::size_t index = value.index();
  put(ar, index);
  if constexpr (Ar::reads) {
    std::size_t i = 0;
    const bool is_known = ((index == i++ && (value.template emplace<Ts>(), true)) || ...);
    if (!is_known) throw InputError("pickle", "is damaged");
  }
  std::visit([&](auto& held) { put(ar, held); }, value);
}

template <class Ar>
void put(Ar& ar, WallSet& walls) {
  auto bytes = walls.visit([](auto list) { return static_cast<std::uint8_t>(sizeof list[0]); });
  put(ar, bytes);
  const auto block = [&]<class Wall>(std::span<const Wall> own) {
    RawVector<Wall> list(own.begin(), own.end());
    put(ar, list);
    if constexpr (Ar::reads) walls = WallSet(std::move(list));
  };
  if constexpr (!Ar::reads) return walls.visit(block);
  if (bytes == sizeof(PackedWall)) return block(std::span<const PackedWall>());
  bytes == sizeof(FloatWall) ? block(std::span<const FloatWall>()) : block(std::span<const DoubleWall>());
}

template <class Ar>
void put(Ar& ar, Bitmap& bits) {
  std::uint32_t width = bits.width();
  std::uint32_t height = bits.height();
  all(ar, width, height);
  if constexpr (Ar::reads) {
    if (ar.count(0) != Bitmap::bytes_for(width, height)) throw InputError("pickle", "is damaged");
    bits = Bitmap(width, height);
  } else {
    ar.count(bits.bytes());
  }
  for (std::uint32_t y = 0; y < height; ++y) ar.block(bits.row(y).data(), bits.row(y).size_bytes());
}

template <class Ar>
void put(Ar& ar, Vec3& point) {
  ar.block(point.data(), 3 * sizeof(double));
}

template <class Ar>
void put(Ar& ar, Eigen::Isometry3d& pose) {
  ar.block(pose.matrix().data(), 16 * sizeof(double));
}

/// A pair or an array.
template <class Ar, class T>
requires(!std::is_trivially_copyable_v<T> && requires { std::tuple_size<T>::value; }) void put(Ar& ar, T& parts) {
  std::apply([&](auto&... part) { all(ar, part...); }, parts);
}

/// Says each member once: for the binding, which doesn't compile where one is missing, and for the archive. The macro
/// that the house otherwise does without: no template of C++20 can take a struct apart by names.
#define WARREN_ARCHIVED(Type, ...) \
  template <class Ar>              \
  void put(Ar& ar, Type& whole) {  \
    auto& [__VA_ARGS__] = whole;   \
    all(ar, __VA_ARGS__);          \
  }
WARREN_ARCHIVED(Solid, kind, pose, half, corners, faces, name, given)
WARREN_ARCHIVED(AttachedSolid, link, solid, may_touch)
template <class Ar>
void put(Ar& ar, ArmFiles& whole) {
  auto& [urdf, srdf, group, base, tip, packages, held, allowed, attached, tool, base_pose, said, read] = whole;
  all(ar, urdf, srdf, group, base, tip, packages, held, allowed, attached, tool, base_pose, said);
  if constexpr (Ar::reads) read.reset();  // whoever asks again reads the files
}
WARREN_ARCHIVED(NamedState, names, values)
WARREN_ARCHIVED(RobotSpec, kind, radius, turning_radius, tool, outline, steering, limits, table, self_collision, files)
WARREN_ARCHIVED(ScenePolygon, corners, line)
WARREN_ARCHIVED(OccupancyMap, format, blocked, unknown, water, free, occupied, unknown_count, between, grey_free, cell,
                origin, yaw_rad, start, goal, source, image)
WARREN_ARCHIVED(PackedMaze, file, hash)
WARREN_ARCHIVED(PricedArea, factor, corners, line)
WARREN_ARCHIVED(MaskCells, width, height, values, cell, origin, yaw_rad, image)
WARREN_ARCHIVED(PriceMask, kind, file, factor, base, multiplier, read)
WARREN_ARCHIVED(Prices, clearance, areas, masks, keep_out, unknown)
WARREN_ARCHIVED(Scene, walls, polygons, seams, spheres, boxes, solids, bounds, clearance, maze, formula, packed, robot,
                arm, start, goal, other_goals, named_start, named_goals, goal_pose, grid, prices, map, source)
WARREN_ARCHIVED(StateList, width, numbers)
WARREN_ARCHIVED(Violation, leg, distance, obstacle, kind)
WARREN_ARCHIVED(RefutedPath, violation, length, cost, path, states)
WARREN_ARCHIVED(BlockedEnd, is_start, by, free_place, distance, hint, room, needed, depth)
WARREN_ARCHIVED(Hint, verb, words, why)
WARREN_ARCHIVED(Explanation, components, narrowest, hints, stopped)
WARREN_ARCHIVED(GoalRule, others, tolerance, region, heading_rad, visit, back)
WARREN_ARCHIVED(Problem, robot, start, goal, clearance, contact, goal_pose, prices, rule, told, via)
WARREN_ARCHIVED(GoalReached, asked, distance, distance_bound)
WARREN_ARCHIVED(AlternativePath, cost, length, price, min_clearance, passed, path)
WARREN_ARCHIVED(WorldAccount, source, kind, walls, polygons, hash, spheres, boxes, unit, solids)
WARREN_ARCHIVED(NamedFigure, name, value)
WARREN_ARCHIVED(StageCost, name, wall_s, cpu_s)
WARREN_ARCHIVED(HandedPath, points, hash)
WARREN_ARCHIVED(Improvement, iterations, seconds, cost, length, by, lower_bound)
WARREN_ARCHIVED(MapHole, id, box)
WARREN_ARCHIVED(KeptRoute, kept, kept_cost, new_cost)
WARREN_ARCHIVED(ClaimedPath, optimal, lower_bound, cost, price, bound_of, goal_index, goal_reached, order, alternatives,
                passed, holes, hole_size, keeping, path, states)

struct Anything {
  template <class T>
  operator T&() const;  // NOLINT(google-explicit-constructor): what a member is initialised with
};
template <class T, std::size_t... I>
constexpr bool is_made_of(std::index_sequence<I...>) {
  return requires { T{((void)I, Anything{})...}; };
}
template <class Ar>
void put(Ar& ar, Answer& a) {  // no binding takes a struct apart whose base has members, too
  constexpr std::size_t parts = 36;
  static_assert(is_made_of<Answer>(std::make_index_sequence<parts>{}) &&
                    !is_made_of<Answer>(std::make_index_sequence<parts + 1>{}),
                "all members of Answer are listed here, and its base");
  put(ar, static_cast<ClaimedPath&>(a));
  all(ar, a.outcome, a.stop_reason, a.verified, a.blocked, a.explained, a.refuted, a.length, a.min_clearance,
      a.raw_length, a.improvements, a.iterations, a.ended_by, a.turn_rad, a.problem, a.world, a.planner, a.pipeline,
      a.sampler, a.search, a.seed, a.threads, a.options, a.roadmap, a.cells, a.figures, a.path_figures, a.separation,
      a.counters, a.seconds, a.costs, a.solve_s, a.wanted_memory_bytes, a.peak_memory_bytes, a.handed, a.tells_path);
}
#undef WARREN_ARCHIVED

}  // namespace

template <class T>
py::bytes bytes_of(const T& value) {
  BytesOut out;
  put(out, const_cast<T&>(value));  // NOLINT: BytesOut changes nothing
  return out.text();
}

template <class T>
T from_bytes(const py::bytes& bytes) {
  BytesIn in{std::string_view(bytes)};
  T value;
  put(in, value);
  in.check_end();
  return value;
}

template py::bytes bytes_of(const Scene&);
template Scene from_bytes(const py::bytes&);
template py::bytes bytes_of(const Answer&);
template Answer from_bytes(const py::bytes&);

}  // namespace warren::python
