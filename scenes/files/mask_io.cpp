// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/mask_io.hpp"

#include <pwd.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/files/geojson_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/files/ring_lists_io.hpp"
#include "scenes/files/ros_map_io.hpp"
#include "scenes/files/scene_io.hpp"
#include "scenes/files/wkt_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {
namespace {

/// Without what such a file names itself.
Scene read_polygons(const InputFile& file, const Execution& execution) {
  const WorldFormat format = format_of(file);
  if (format == WorldFormat::scene) return read_scene_text(file, execution);
  if (format == WorldFormat::geojson) return read_geojson(file, execution);
  if (format == WorldFormat::wkt) return read_wkt(file, execution);
  if (format == WorldFormat::ring_list) return read_ring_list(file, execution);
  throw InputError(file.name(), "expected the YAML of a map server, a GeoJSON or a scene with polygons");
}

/// A world's polygons; all else that it has says nothing of areas.
void take_polygons(const PriceMask& mask, const InputFile& file, Prices& prices, const Execution& execution) {
  Scene scene = read_polygons(file, execution);
  check_polygons(scene, execution);
  if (scene.polygons.empty()) {
    throw InputError(file.name(),
                     "has no polygons to keep out of; a GeoJSON, a scene with `polygon` lines or a map "
                     "server's YAML has");
  }
  for (ScenePolygon& polygon : scene.polygons) {
    if (mask.factor) {
      push_asked(prices.areas, {*mask.factor, std::move(polygon.corners), polygon.line}, execution);
    } else {
      push_asked(prices.keep_out, {std::move(polygon.corners), polygon.line}, execution);
    }
  }
}

}  // namespace

void read_masks(Prices& prices, const Execution& execution) {
  std::vector<PriceMask> masks = std::exchange(prices.masks, {});
  for (PriceMask& mask : masks) {
    if (!mask.read) {
      const InputFile file(mask.file, execution);
      if (format_of(file) == WorldFormat::ros_map) {
        mask.read = read_mask(file, execution);
      } else if (mask.kind == MaskKind::keep_out) {
        take_polygons(mask, file, prices, execution);
        continue;
      } else {
        throw InputError(file.name(), "a mask is the YAML of a map server, which names its image");
      }
    }
    prices.masks.push_back(std::move(mask));
  }
}

std::string path_beside(const std::string& file, const std::string& name) {
  if (name.starts_with("/")) return name;
  if (name.starts_with("~/")) {
    const passwd* user = ::getpwuid(::getuid());
    return (user == nullptr ? std::string{} : std::string{user->pw_dir}) + name.substr(1);
  }
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? name : file.substr(0, slash + 1) + name;
}

std::string name_beside(const std::string& file, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  if (error) return path;
  const bool is_stream = file == "-" || file.starts_with("/dev/");
  const fs::path folder = is_stream ? fs::path() : fs::absolute(file, error).lexically_normal().parent_path();
  const fs::path near = is_stream || error ? fs::path() : whole.lexically_relative(folder);
  const bool is_near = !near.empty() && *near.begin() != "..";
  return is_near ? near.string() : whole.string();
}

}  // namespace warren
