// SPDX-License-Identifier: BSD-3-Clause
// Meshes: Wavefront OBJ, STL (binary or text), COLLADA. Only where their surface is counts: normals, colours and the
// like are passed over.
//
// COLLADA: a geometry stands wherever a node of the scene shows it, so points are taken once a showing, and nodes may
// show nodes: what is visited has a bound, since a few lines can name more showings than there are atoms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/arms/xml_file_io.hpp"
#include "scenes/scene/convex_hull.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

constexpr std::size_t most_mesh_points = std::size_t{1} << 30;

/// Collects points and polygons, which it cuts into triangles.
class MeshCollector {
 public:
  MeshCollector(const std::string& name, const Vec3& scale, const Execution& execution)
      : name_(name), scale_(scale), execution_(execution) {}

  std::size_t points() const { return mesh_.points.size(); }
  /// line: of text, else 0.
  void add_point(const Vec3& read, std::size_t line = 0) {
    const Vec3 point = read.cwiseProduct(scale_);
    if (!(point.array().abs() <= farthest_mesh_point).all()) {
      scene_text::Place{name_, line}.fail(
          fmt::format("point {} of the mesh is not finite, or beyond {} m", points() + 1, farthest_mesh_point),
          fmt::format("{} {} {}", point.x(), point.y(), point.z()));
    }
    if (points() == most_mesh_points) throw InputError(name_, "a mesh may have at most 2^30 points");
    push_asked(mesh_.points, point, execution_);
    execution_.poll(points());
  }
  /// Numbers of points.
  void add_polygon(std::span<const std::uint32_t> corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      push_asked(mesh_.triangles, {corners[0], corners[i - 1], corners[i]}, execution_);
      execution_.poll(mesh_.triangles.size());
    }
  }

  /// Each point once, those of no triangle left out.
  Mesh take() {
    if (points() == 0) throw InputError(name_, "the mesh has no points");
    execution_.reserve(points() / 8 + 1);
    std::vector<bool> used(points(), mesh_.triangles.empty());
    for_each_corner([&](std::uint32_t& corner) { used[corner] = true; });
    const std::size_t some = static_cast<std::size_t>(std::find(used.begin(), used.end(), true) - used.begin());
    for (std::size_t i = 0; i < points(); ++i) {
      execution_.poll(i);
      if (!used[i]) mesh_.points[i] = mesh_.points[some];
    }
    const std::vector<std::uint32_t> numbers = weld_points(mesh_.points, execution_);
    for_each_corner([&](std::uint32_t& corner) { corner = numbers[corner]; });
    return std::move(mesh_);
  }

 private:
  template <class Visit>
  void for_each_corner(const Visit& visit) {
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      execution_.poll(i);
      for (std::uint32_t& corner : mesh_.triangles[i]) visit(corner);
    }
  }

  const std::string& name_;
  const Vec3 scale_;
  const Execution& execution_;
  Mesh mesh_;
};

// Wavefront OBJ: `v X Y Z` and `f A B C …`, of which each may be A/TEXTURE/NORMAL; numbers from 1, negative: from
// behind.

std::uint32_t obj_corner(const scene_text::Place& place, std::string_view word, std::size_t points) {
  auto number = scene_text::number_in_full<std::int64_t>(word.substr(0, word.find('/'))).value_or(0);
  if (number < 0) number += static_cast<std::int64_t>(points) + 1;
  if (number < 1 || number > static_cast<std::int64_t>(points)) {
    place.fail(fmt::format("a face names one of the {} points so far", points), word);
  }
  return static_cast<std::uint32_t>(number - 1);
}

Mesh read_obj(const InputFile& file, const Vec3& scale, const Execution& execution) {
  MeshCollector mesh(file.name(), scale, execution);
  std::vector<std::uint32_t> corners;
  TextLines lines(file, execution);
  while (lines.next()) {
    scene_text::Fields fields = lines.fields();
    const std::string_view word = fields.word();
    if (word == "v") {
      Vec3 point;
      for (double& x : std::span(point.data(), 3)) x = fields.number();
      mesh.add_point(point, lines.number());
    } else if (word == "f") {
      corners.clear();
      while (!fields.done()) {
        push_asked(corners, obj_corner(fields.place(), fields.word(), mesh.points()), execution);
        execution.poll(corners.size());
      }
      if (corners.size() < 3) fields.place().fail("a face has at least three corners", lines.line());
      mesh.add_polygon(corners);
    }
  }
  return mesh.take();
}

// STL: triangles of three points each.

void add_stl_corner(MeshCollector& mesh, const Vec3& point, std::size_t line = 0) {
  mesh.add_point(point, line);
  const auto count = static_cast<std::uint32_t>(mesh.points());
  if (count % 3 == 0) mesh.add_polygon(std::array{count - 3, count - 2, count - 1});
}

constexpr std::size_t stl_head = 84;
constexpr std::size_t stl_triangle = 50;

Mesh read_stl_text(const InputFile& file, const Vec3& scale, const Execution& execution) {
  MeshCollector mesh(file.name(), scale, execution);
  TextLines lines(file, execution);
  while (lines.next()) {
    scene_text::Fields fields = lines.fields();
    const std::string_view word = fields.word();
    if (word == "endloop" && mesh.points() % 3 != 0) lines.place().fail("a triangle has three corners", lines.line());
    if (word != "vertex") continue;
    Vec3 point;
    for (double& x : std::span(point.data(), 3)) x = fields.number();
    if (!fields.done()) fields.place().fail("expected `vertex X Y Z`", lines.line());
    add_stl_corner(mesh, point, lines.number());
  }
  if (mesh.points() % 3 != 0) lines.place().fail("the file ends inside a triangle");
  return mesh.take();
}

Mesh read_stl(const InputFile& file, const Vec3& scale, const Execution& execution) {
  const std::string_view bytes = file.bytes();
  std::uint32_t count = 0;
  if (bytes.size() >= stl_head) std::memcpy(&count, bytes.data() + stl_head - sizeof(count), sizeof(count));
  const std::size_t size = stl_head + count * stl_triangle;
  const bool is_text = bytes.starts_with("solid") && bytes.substr(0, stl_head).find('\0') == std::string_view::npos;
  if (size != bytes.size() && is_text) return read_stl_text(file, scale, execution);
  if (bytes.size() < stl_head || size != bytes.size()) {
    throw InputError(
        file.name(),
        fmt::format("expected an STL: text that begins with `solid`, or {} bytes of {} triangles", size, count),
        fmt::format("{} bytes", bytes.size()));
  }
  MeshCollector mesh(file.name(), scale, execution);
  for (std::size_t corner = 0; corner < std::size_t{3} * count; ++corner) {
    Eigen::Vector3f point;
    const std::size_t at = stl_head + corner / 3 * stl_triangle + sizeof(point) * (1 + corner % 3);
    std::memcpy(point.data(), bytes.data() + at, sizeof(point));
    add_stl_corner(mesh, point.cast<double>());
  }
  return mesh.take();
}

// COLLADA.

constexpr std::size_t most_collada_bytes = std::size_t{256} << 20;
constexpr std::size_t most_collada_nodes = 100'000;

class ColladaReader {
 public:
  ColladaReader(const InputFile& file, const Vec3& scale, const Execution& execution)
      : xml_(file, "COLLADA", most_collada_bytes, execution),
        execution_(execution),
        mesh_(file.name(), scale, execution) {
    for (const auto& [library, kind] :
         {std::pair{"library_geometries", "geometry"}, std::pair{"library_visual_scenes", "visual_scene"},
          std::pair{"library_nodes", "node"}}) {
      for (const pugi::xml_node some : xml_.root().children(library))
        for (const pugi::xml_node item : some.children(kind)) named_.emplace(item.attribute("id").value(), item);
    }
  }

  Mesh read() {
    Eigen::Affine3d unit = Eigen::Affine3d::Identity();
    unit.scale(xml_.number(xml_.root().child("asset").child("unit"), "meter").value_or(1.0));
    const pugi::xml_node shown = xml_.root().child("scene").child("instance_visual_scene");
    if (!shown) xml_.fail(xml_.root(), "it has no <scene> with an <instance_visual_scene>");
    left_.emplace_back(named(shown, "url"), unit);
    while (!left_.empty()) visit();
    return mesh_.take();
  }

 private:
  /// What an attribute names, "#ID".
  pugi::xml_node named(pugi::xml_node node, const char* attribute) const {
    const std::string id = xml_.word(node, attribute);
    const auto found = named_.find(std::string_view(id).substr(id.starts_with('#') ? 1 : 0));
    if (found == named_.end()) xml_.fail(node, "nothing in this file has this id", id);
    return found->second;
  }

  /// A node or a visual scene: its children in their order, since each transform counts for what follows it.
  void visit() {
    const auto node = left_.back().first;
    Eigen::Affine3d pose = left_.back().second;
    left_.pop_back();
    execution_.check();
    if (++visited_ > most_collada_nodes)
      xml_.fail(node, fmt::format("a scene may show at most {} nodes", most_collada_nodes));
    for (const pugi::xml_node child : node.children()) {
      const std::string_view kind = child.name();
      if (kind == "node") {
        push_asked(left_, {child, pose}, execution_);
      } else if (kind == "instance_node") {
        push_asked(left_, {named(child, "url"), pose}, execution_);
      } else if (kind == "instance_geometry") {
        add_geometry(named(child, "url"), pose);
      } else if (kind == "instance_controller" || kind == "lookat" || kind == "skew") {
        xml_.fail(child, "not read in collision meshes; export the mesh as OBJ or STL");
      } else {
        transform(child, pose);
      }
    }
  }
  void transform(pugi::xml_node node, Eigen::Affine3d& pose) const {
    const std::string_view kind = node.name();
    std::array<double, 16> n{};
    const auto take = [&](std::size_t count) {
      xml_.numbers(node, node.child_value(), std::span(n).first(count));
      return Vec3(n[0], n[1], n[2]);
    };
    if (kind == "matrix") {
      take(16);
      Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
      matrix.linear() << n[0], n[1], n[2], n[4], n[5], n[6], n[8], n[9], n[10];
      matrix.translation() = Vec3(n[3], n[7], n[11]);
      pose = pose * matrix;
    } else if (kind == "translate") {
      pose.translate(take(3));
    } else if (kind == "scale") {
      pose.scale(take(3));
    } else if (kind == "rotate") {
      const Vec3 axis = take(4);
      const double length = axis.stableNorm();
      if (!(length > 0.0)) xml_.fail(node, "the axis has no direction");
      pose.rotate(turn_about(axis / length, n[3] * (std::numbers::pi / 180.0)));
    }
  }

  void add_geometry(pugi::xml_node geometry, const Eigen::Affine3d& pose) {
    const pugi::xml_node mesh = geometry.child("mesh");
    if (!mesh) xml_.fail(geometry, "only a <mesh> is read; export the mesh as OBJ or STL");
    const std::size_t first = mesh_.points();
    add_points(mesh, pose);
    for (const pugi::xml_node part : mesh.children()) {
      const std::string_view kind = part.name();
      if (kind == "polylist") add_polygons(part, part.child("vcount").child_value(), first);
      if (kind == "triangles") add_polygons(part, "3", first);
      if (kind == "polygons" || kind == "tristrips" || kind == "trifans") add_polygons(part, "", first);
    }
  }
  /// All points of the mesh's <vertices>.
  void add_points(pugi::xml_node mesh, const Eigen::Affine3d& pose) {
    const pugi::xml_node input = mesh.child("vertices").find_child_by_attribute("input", "semantic", "POSITION");
    const std::string_view id = input.attribute("source").value();
    const pugi::xml_node source = mesh.find_child_by_attribute("source", "id", id.empty() ? "" : id.data() + 1);
    const pugi::xml_node accessor = source.child("technique_common").child("accessor");
    const double stride = xml_.number(accessor, "stride").value_or(3.0);
    if (!source || stride != 3.0 || xml_.number(accessor, "offset").value_or(0.0) != 0.0)
      xml_.fail(mesh, "expected <vertices> with a POSITION whose <source> is x, y, z after x, y, z", id);
    const pugi::xml_node array = source.child("float_array");
    std::string_view text = array.child_value();
    Vec3 point;
    Eigen::Index count = 0;
    for (; !text.empty(); ++count) {
      if (!take_number(text, point[count % 3])) xml_.fail(array, "expected numbers", text);
      if (count % 3 == 2) mesh_.add_point(pose * point);
    }
    const auto said = xml_.number(array, "count");
    if (count % 3 != 0 || (said && *said != static_cast<double>(count)))
      xml_.fail(array, "expected three numbers a point, and as many as `count` says",
                scene_text::numbers_text(static_cast<std::size_t>(count)));
  }
  /// Polygons of as many corners as `sizes` says, its last for all that follow; without any: all of a <p> in one.
  void add_polygons(pugi::xml_node part, std::string_view sizes, std::size_t first) {
    std::size_t stride = 1;
    std::size_t offset = 0;
    for (const pugi::xml_node input : part.children("input")) {
      const std::size_t at = input.attribute("offset").as_uint();
      stride = std::max(stride, at + 1);
      if (std::string_view(input.attribute("semantic").value()) == "VERTEX") offset = at;
    }
    std::size_t size = 0;
    std::size_t said_sizes = 0;
    const auto next_size = [&] {
      if (sizes.empty()) return;
      ++said_sizes;
      if (!take_number(sizes, size) || size == 0) xml_.fail(part, "expected counts of corners", sizes);
    };
    next_size();
    std::size_t made = 0;
    std::vector<std::uint32_t> corners;
    for (const pugi::xml_node child : part.children()) {
      const bool has_holes = std::string_view(child.name()) == "ph";  // which lie inside of its <p>
      const pugi::xml_node list = has_holes ? child.child("p") : child;
      if (std::string_view(list.name()) != "p") continue;
      std::string_view text = list.child_value();
      for (std::size_t i = 0; !text.empty(); ++i) {
        execution_.poll(i);
        std::size_t number = 0;
        const bool is_corner = i % stride == offset;
        if (!take_number(text, number) || (is_corner && number >= mesh_.points() - first))
          xml_.fail(list, fmt::format("expected numbers of the {} points", mesh_.points() - first), text);
        if (is_corner) push_asked(corners, static_cast<std::uint32_t>(first + number), execution_);
        if (i % stride != stride - 1 || corners.size() != size) continue;
        mesh_.add_polygon(corners);
        corners.clear();
        ++made;
        next_size();
      }
      if (size > 0 && !corners.empty()) xml_.fail(list, "it ends inside a polygon");
      mesh_.add_polygon(corners);
      corners.clear();
    }
    const auto said = xml_.number(part, "count");
    if (size > 0 && (said_sizes > std::max<std::size_t>(1, made) || (said && *said != static_cast<double>(made))))
      xml_.fail(part, "expected as many polygons as `count` and <vcount> say", fmt::format("{} in <p>", made));
  }

  XmlFile xml_;
  const Execution& execution_;
  MeshCollector mesh_;
  std::map<std::string, pugi::xml_node, std::less<>> named_;
  std::vector<std::pair<pugi::xml_node, Eigen::Affine3d>> left_;
  std::size_t visited_ = 0;
};

/// Has each side of a triangle one that goes the other way?
bool is_closed(const Mesh& mesh, const Execution& execution) {
  std::array<std::vector<std::uint64_t>, 2> sides;
  execution.reserve(mesh.triangles.size() * 6 * sizeof(std::uint64_t));
  for (auto& some : sides) some.reserve(3 * mesh.triangles.size());
  for (std::size_t number = 0; number < mesh.triangles.size(); ++number) {
    execution.poll(number);
    const auto& t = mesh.triangles[number];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t a = t[i];
      const std::uint64_t b = t[(i + 1) % 3];
      if (a == b) continue;
      sides[0].push_back(a << 32U | b);
      sides[1].push_back(b << 32U | a);
    }
  }
  for (auto& some : sides) polled_sort(some.begin(), some.end(), execution);
  return sides[0] == sides[1];
}

}  // namespace

Mesh read_mesh(const InputFile& file, const Execution& execution, const Vec3& scale) {
  std::string ending = file.name().substr(std::min(file.name().size(), file.name().find_last_of("./") + 1));
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (ending == "obj") return read_obj(file, scale, execution);
  if (ending == "stl") return read_stl(file, scale, execution);
  if (ending == "dae") return ColladaReader(file, scale, execution).read();
  throw InputError(file.name(), "expected a mesh of an ending that is known: .obj, .stl, .dae", ending);
}

std::string hull_excess(const Mesh& mesh, const Solid& hull, const Execution& execution) {
  if (hull.faces.empty()) return "flat, its points as they are";
  const double volume = volume_inside(hull.corners, hull.faces);
  const double inside = std::abs(volume_inside(mesh.points, mesh.triangles));
  if (!is_closed(mesh, execution) || !(inside > 1e-6 * volume))
    return "the mesh is not closed, so nobody knows by how much the hull is larger";
  return fmt::format("{:.2f} times its volume", volume / inside);
}

}  // namespace warren
