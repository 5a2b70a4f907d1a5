// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/formats/geojson_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

std::string position(Vec2 p) { return fmt::format("[{}, {}]", p.x + 0.0, p.y + 0.0); }

/// Writes features, one a line.
class Writer {
 public:
  Writer(const std::string& path, const Execution& execution) : file_(path, execution), execution_(execution) {
    file_.write("{\"type\": \"FeatureCollection\", \"features\": [");
  }
  void feature(std::string_view role, std::string_view type, std::string_view coordinates) {
    constexpr std::size_t batch = 1 << 10;
    if (++written_ % batch == 0) execution_.check();
    const std::string properties = role.empty() ? "{}" : fmt::format("{{\"role\": \"{}\"}}", role);
    file_.write(
        fmt::format("{}\n{{\"type\": \"Feature\", \"properties\": {}, \"geometry\": {{\"type\": \"{}\", "
                    "\"coordinates\": {}}}}}",
                    written_ == 1 ? "" : ",", properties, type, coordinates));
  }
  void ring(std::string_view role, const std::vector<Vec2>& corners) {
    std::string text = "[[";
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i % 4096 == 4095) execution_.check();
      text += position(corners[i]) + ", ";
    }
    feature(role, "Polygon", text + position(corners.front()) + "]]");
  }
  void commit() {
    file_.write("\n]}\n");
    file_.commit();
  }

 private:
  OutputFile file_;
  const Execution& execution_;
  std::size_t written_ = 0;
};

}  // namespace

void write_geojson(const Scene& scene, const std::string& path, const Execution& execution) {
  if (has_solids(scene)) throw InputError(path, "GeoJSON holds no spheres or boxes; write them to a .scene file");
  if (scene.start.size() > 2 || scene.goal.size() > 2) {
    throw InputError(path, "GeoJSON holds places X Y, no states with angles; write them to a .scene file");
  }
  Writer writer(path, execution);
  if (scene.bounds) {
    const auto [low, high] = *scene.bounds;
    writer.ring("bounds", {low, {high.x, low.y}, high, {low.x, high.y}});
  }
  if (!scene.start.empty()) writer.feature("start", "Point", position({scene.start[0], scene.start[1]}));
  if (!scene.goal.empty()) writer.feature("goal", "Point", position({scene.goal[0], scene.goal[1]}));
  for (const ScenePolygon& polygon : scene.polygons) writer.ring({}, anticlockwise(polygon.corners));
  scene.walls.visit([&](auto walls) {
    for (const auto& wall : walls) {
      const Segment s = wall.segment();
      writer.feature({}, "LineString", "[" + position(s.a) + ", " + position(s.b) + "]");
    }
  });
  writer.commit();
}

}  // namespace warren
