// SPDX-License-Identifier: BSD-3-Clause
#include "python/binary_archive.hpp"

#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/error.hpp"
#include "python/bind.hpp"
#include "scenes/scene/scene.hpp"

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
  if constexpr (std::is_trivially_copyable_v<T>) {
    std::size_t n = ar.count(list.size());
    if constexpr (Ar::reads) list.resize(n);
    ar.block(list.data(), n * sizeof(T));
  } else {
    const std::size_t n = ar.count(list.size());
    if constexpr (Ar::reads) list.resize(n);
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

template <std::size_t I = 0, class... Ts>
void emplace_alternative(std::variant<Ts...>& value, std::size_t index) {
  if constexpr (I < sizeof...(Ts)) {
    if (index == I) {
      value.template emplace<I>();
    } else {
      emplace_alternative<I + 1>(value, index);
    }
  } else {
    throw InputError("pickle", "is damaged");
  }
}

template <class Ar, class... Ts>
requires(!std::is_trivially_copyable_v<std::variant<Ts...>>) void put(Ar& ar, std::variant<Ts...>& value) {
  std::size_t index = value.index();
  put(ar, index);
  if constexpr (Ar::reads) emplace_alternative(value, index);
  std::visit([&](auto& held) { put(ar, held); }, value);
}

template <class Ar>
void put(Ar& ar, WallSet& walls) {
  bool floats = walls.holds_floats();
  put(ar, floats);
  const auto block = [&]<class Wall>(Wall) {
    RawVector<Wall> list;
    if constexpr (!Ar::reads) {
      walls.visit([&](auto span) {
        if constexpr (std::is_same_v<std::remove_cv_t<typename decltype(span)::value_type>, Wall>) {
          list.assign(span.begin(), span.end());
        }
      });
    }
    put(ar, list);
    if constexpr (Ar::reads) walls = WallSet(std::move(list));
  };
  floats ? block(FloatWall{}) : block(DoubleWall{});
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
void put(Ar& ar, RobotSpec& r) {
  all(ar, r.kind, r.radius, r.turning_radius, r.tool, r.outline, r.steering, r.limits, r.table, r.self_collision);
}
template <class Ar>
void put(Ar& ar, ScenePolygon& p) {
  all(ar, p.corners, p.line);
}
template <class Ar>
void put(Ar& ar, OccupancyMap& m) {
  all(ar, m.format, m.blocked, m.unknown, m.water, m.free, m.occupied, m.unknown_count, m.between, m.cell, m.origin,
      m.yaw_rad, m.start, m.goal, m.source, m.image);
}
template <class Ar>
void put(Ar& ar, Scene& s) {
  all(ar, s.walls, s.polygons, s.seams, s.spheres, s.boxes, s.bounds, s.clearance, s.maze, s.robot, s.start, s.goal,
      s.grid, s.map, s.source);
}

template <class Ar>
void put(Ar& ar, StateList& s) {
  all(ar, s.width, s.numbers);
}
template <class Ar>
void put(Ar& ar, Violation& v) {
  all(ar, v.leg, v.distance, v.obstacle);
}
template <class Ar>
void put(Ar& ar, RefutedPath& p) {
  all(ar, p.violation, p.length, p.cost, p.path, p.states);
}
template <class Ar>
void put(Ar& ar, BlockedEnd& b) {
  all(ar, b.is_start, b.by, b.free_place, b.distance, b.hint);
}
template <class Ar>
void put(Ar& ar, Problem& p) {
  all(ar, p.robot, p.start, p.goal, p.clearance, p.contact);
}
template <class Ar>
void put(Ar& ar, WorldAccount& w) {
  all(ar, w.source, w.kind, w.walls, w.polygons, w.hash, w.spheres, w.boxes);
}
template <class Ar>
void put(Ar& ar, NamedFigure& f) {
  all(ar, f.name, f.value);
}
template <class Ar>
void put(Ar& ar, Answer& a) {
  all(ar, a.outcome, a.stop_reason, a.verified, a.blocked, a.refuted, a.length, a.min_clearance, a.raw_length,
      a.optimal, a.cost, a.turn_rad, a.problem, a.world, a.planner, a.pipeline, a.sampler, a.search, a.seed, a.threads,
      a.options, a.roadmap, a.cells, a.figures, a.path_figures, a.separation, a.counters, a.seconds, a.solve_s,
      a.peak_memory_bytes, a.path, a.states);
}

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
  return value;
}

template py::bytes bytes_of(const Scene&);
template Scene from_bytes(const py::bytes&);
template py::bytes bytes_of(const Answer&);
template Answer from_bytes(const py::bytes&);

}  // namespace warren::python
