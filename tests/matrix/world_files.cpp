// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/world_files.hpp"

#include <cmath>
#include <sstream>

namespace warren::test {

std::string polygon_text(const Ring& ring) {
  std::ostringstream text;
  text << "polygon";
  for (const PlanePoint p : ring) text << ' ' << p.x << ' ' << p.y;
  return text.str();
}

namespace {

std::string json_of(const Ring& ring) {
  std::ostringstream text;
  text << '[';
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const PlanePoint p = ring[i % ring.size()];
    text << (i == 0 ? "" : ", ") << '[' << p.x << ", " << p.y << ']';
  }
  text << ']';
  return text.str();
}

}  // namespace

PlanePoint MapPlace::at(double column, double row) const {
  const double x = column * cell;
  const double y = row * cell;
  return {origin.x + std::cos(yaw) * x - std::sin(yaw) * y, origin.y + std::sin(yaw) * x + std::cos(yaw) * y};
}

std::string scene_of(const MatrixWorld& world) {
  std::ostringstream text;
  if (!world.plane.rim.empty()) {
    const PlanePoint low = world.plane.rim[0];
    const PlanePoint high = world.plane.rim[2];
    text << "bounds " << low.x << ' ' << low.y << ' ' << high.x << ' ' << high.y << '\n';
  }
  for (const auto& [a, b] : world.plane.walls) text << a.x << ' ' << a.y << ' ' << b.x << ' ' << b.y << '\n';
  for (const Region& region : world.plane.regions) text << polygon_text(region.front()) << '\n';
  for (const auto& [x, y, z, r] : world.space.spheres) {
    text << "sphere " << x << ' ' << y << ' ' << z << ' ' << r << '\n';
  }
  for (const auto& box : world.space.boxes) {
    text << "box";
    for (const double x : box) text << ' ' << x;
    text << '\n';
  }
  return text.str();
}

std::string moveit_of(const MatrixWorld& world) {
  std::ostringstream text;
  text << "name: matrix\nworld:\n  collision_objects:\n";
  const auto add = [&](const std::string& primitive, double x, double y, double z) {
    text << "    - id: solid " << x << ' ' << y << "\n      primitives: [{" << primitive
         << "}]\n      primitive_poses: [{position: [" << x << ", " << y << ", " << z
         << "], orientation: [0, 0, 0, 1]}]\n";
  };
  for (const auto& [x, y, z, r] : world.space.spheres) {
    std::ostringstream sphere;
    sphere << "type: sphere, dimensions: [" << r << ']';
    add(sphere.str(), x, y, z);
  }
  for (const auto& [x, y, z, to_x, to_y, to_z] : world.space.boxes) {
    std::ostringstream box;
    box << "type: box, dimensions: [" << to_x - x << ", " << to_y - y << ", " << to_z - z << ']';
    add(box.str(), 0.5 * (x + to_x), 0.5 * (y + to_y), 0.5 * (z + to_z));
  }
  return text.str();
}

std::string geojson_of(const MatrixWorld& world) {
  std::string text = R"({"type": "FeatureCollection", "features": [)";
  for (std::size_t i = 0; i < world.plane.regions.size(); ++i) {
    text += i == 0 ? "" : ",\n ";
    text += R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [)";
    const Region& region = world.plane.regions[i];
    for (std::size_t k = 0; k < region.size(); ++k) text += (k == 0 ? "" : ", ") + json_of(region[k]);
    text += "]}}";
  }
  if (!world.plane.rim.empty()) {
    text +=
        R"(, {"type": "Feature", "properties": {"role": "bounds"}, "geometry": {"type": "Polygon", "coordinates": [)" +
        json_of(world.plane.rim) + "]}}";
  }
  return text + "]}\n";
}

PlaneObstacles cells_of(const MapRows& rows, const MapPlace& place) {
  PlaneObstacles plane{.rounded = true};
  const auto square = [&](double x, double y, double w, double h) {
    return Ring{place.at(x, y), place.at(x + w, y), place.at(x + w, y + h), place.at(x, y + h)};
  };
  const std::size_t count = rows.size();
  plane.rim = square(0, 0, static_cast<double>(rows.front().size()), static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      if (rows[i][k] == '.') continue;
      plane.regions.push_back({square(static_cast<double>(k), static_cast<double>(count - 1 - i), 1, 1)});
    }
  }
  return plane;
}

std::string moving_ai_of(const MapRows& rows) {
  std::ostringstream text;
  text << "type octile\nheight " << rows.size() << "\nwidth " << rows.front().size() << "\nmap\n";
  for (const std::string& row : rows) text << row << '\n';
  return text.str();
}

std::string pgm_of(const MapRows& rows) {
  std::ostringstream text;
  text << "P2\n" << rows.front().size() << ' ' << rows.size() << "\n255\n";
  for (const std::string& row : rows) {
    for (const char c : row) text << (c == '.' ? "254 " : c == '?' ? "205 " : "0 ");
    text << '\n';
  }
  return text.str();
}

std::string yaml_of(const std::string& image, const MapPlace& place) {
  std::ostringstream text;
  text << "image: " << image << "\nresolution: " << place.cell << "\norigin: [" << place.origin.x << ", "
       << place.origin.y << ", " << place.yaw << "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  return text.str();
}

}  // namespace warren::test
