// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON (RFC 7946), in and out: a FeatureCollection, Feature or geometry. Polygons and MultiPolygons are obstacles,
// LineStrings walls; a polygon with holes becomes several that touch (scenes/scene/plane_obstacles). A feature
// whose properties have a "role" says what else a world holds: "start" and "goal" (Points), "bounds" (a Polygon, taken
// as its box). Rings of either orientation, closed as the RFC demands; a third coordinate is dropped; features without
// geometry, properties and foreign members are passed over. Also a bare array of rings, open or closed, as earcut's
// test data have them: each ring is an obstacle. Read in one pass without a tree.
//
// The reader takes the parser's events: an object that has a "type" and "coordinates" is a geometry, whatever the order
// of its keys; coordinates are collected as chains of points with the depth of their nesting, and interpreted when the
// object ends.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/json_text.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

using Json = nlohmann::json;

constexpr std::size_t deepest = 64;       // objects in objects: more is no map
constexpr std::size_t longest_word = 32;  // of those that mean something: longer ones are cut off

/// Nested lists of points: chains, and the groups of chains.
struct Coordinates {
  std::vector<ScenePolygon> chains;  ///< of points, each with the line where it begins
  std::vector<std::size_t> groups;   ///< the first chain of each group
  int depth = 0;                     ///< of the positions; 1: a point; 2: a chain; 3: chains; 4: groups
  bool given = false;
};

/// What one JSON object has said so far.
struct Object {
  std::string type;
  std::string role;  ///< of its properties
  Coordinates coordinates;
  bool in_properties = false;   ///< it or an object around it is a feature's "properties"
  bool is_geometry = false;     ///< it stands where a geometry does
  bool lists_places = false;    ///< its open array is of features or geometries
  int lists = 0;                ///< open arrays that hold no coordinates
  std::size_t first_piece = 0;  ///< of those that wait
};

/// The nesting that each type of geometry has; 0: no geometry.
int depth_of(const std::string& type) {
  if (type == "Point") return 1;
  if (type == "LineString" || type == "MultiPoint") return 2;
  if (type == "Polygon" || type == "MultiLineString") return 3;
  return type == "MultiPolygon" ? 4 : 0;
}

/// Outlines are obstacles, lines walls, points nothing, unless the feature around them says that they are start, goal
/// or bounds. That is known when the feature ends, so geometries wait until then. Polygons with holes are cut
/// (scenes/scene/plane_obstacles.hpp). All that is wrong throws InputError with file and line.
class Reader {
 public:
  Reader(const std::string& file, const std::size_t& line, const Execution& execution)
      : file_(file), line_(line), execution_(execution), walls_(execution) {
    scene_.source = file_;
  }

  bool null() { return position_.size() >= 2 || scalar("null"); }  // a height that nobody knows is no height
  bool boolean(bool) { return scalar("true or false"); }
  bool number_integer(Json::number_integer_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(Json::number_unsigned_t value) { return number(static_cast<double>(value)); }
  bool number_float(Json::number_float_t value, const std::string&) { return number(value); }
  bool binary(Json::binary_t&) { return false; }
  bool string(std::string& text) {
    scalar(text);
    if (object().lists > 0) return true;
    if (key_ == "type" && !object().in_properties) object().type = text.substr(0, longest_word);
    if (key_ == "role" && object().in_properties && objects_.size() > 1)
      objects_[objects_.size() - 2].role = text.substr(0, longest_word);
    return true;
  }
  bool start_object(std::size_t) {
    if (in_coordinates()) fail("expected numbers in \"coordinates\"", "an object");
    if (objects_.size() >= deepest) fail("objects are nested too deeply for a map");
    began_ = true;
    Object opened;
    opened.in_properties = !objects_.empty() && (object().in_properties || key_ == "properties");
    const bool is_listed = !objects_.empty() && object().lists == 1 && object().lists_places;
    opened.is_geometry = !opened.in_properties && (objects_.empty() || is_listed || key_ == "geometry");
    opened.first_piece = waiting_.size();
    objects_.push_back(std::move(opened));
    key_.clear();
    return true;
  }
  bool end_object() {
    const Object ended = std::move(objects_.back());
    objects_.pop_back();
    end_geometry(ended);
    if (ended.type == "Feature" || !ended.role.empty() || objects_.empty()) settle(ended.first_piece, ended.role);
    key_.clear();
    return true;
  }
  bool key(std::string& name) {
    key_ = name.substr(0, longest_word);
    execution_.poll(++looks_);
    return true;
  }
  bool start_array(std::size_t) {
    constexpr int most_nested = 4;
    if (!began_) {
      bare_ = began_ = true;
      objects_.push_back({});
      key_ = "coordinates";
      object().type = "Polygon";
    }
    if (list_depth_ == 0 && (key_ != "coordinates" || object().in_properties || object().lists > 0)) {
      if (object().lists++ == 0) object().lists_places = key_ == "features" || key_ == "geometries";
      return true;
    }
    if (!position_.empty()) fail("expected a position of two or three numbers", "a list in it");
    Coordinates& c = object().coordinates;
    if (list_depth_ == 0 && c.given) fail("\"coordinates\" stands twice");
    c.given = true;
    if (++list_depth_ > most_nested) fail("\"coordinates\" are nested too deeply");
    if (list_depth_ == 2) push_asked(c.groups, c.chains.size(), execution_);
    return true;
  }
  bool end_array() {
    if (list_depth_ == 0) {
      --object().lists;
      return true;
    }
    const bool ends_position = !position_.empty();
    if (ends_position) end_position();
    if (--list_depth_ == 0 || !ends_position) chain_open_ = false;
    if (bare_ && list_depth_ == 0) {
      end_geometry(object());
      settle(0, {});
      objects_.pop_back();
    }
    return true;
  }
  [[noreturn]] bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception&) {
    fail("this is not JSON from here on", token);
  }

  Scene finish() {
    scene_.walls = walls_.take();
    if (scene_.walls.size() == 0 && scene_.polygons.empty() && !scene_.bounds) {
      throw InputError(file_, "there is no polygon and no line in it; expected GeoJSON with some");
    }
    return std::move(scene_);
  }

 private:
  /// A geometry that waits for the end of its feature; its rings are not closed.
  struct Piece {
    enum class Kind : std::uint8_t { polygon, wall, point };
    Kind kind;
    std::vector<Vec2> points;
    std::size_t line;
    std::vector<std::vector<Vec2>> holes = {};
  };

  [[noreturn]] void fail(std::string_view what, std::string_view found = {}) const { fail_at(line_, what, found); }
  [[noreturn]] void fail_at(std::size_t line, std::string_view what, std::string_view found = {}) const {
    scene_text::Place{file_, line}.fail(what, found);
  }
  bool in_coordinates() const { return list_depth_ > 0; }
  Object& object() { return objects_.back(); }
  bool scalar(std::string_view found) const {
    if (in_coordinates()) fail("expected numbers in \"coordinates\"", found);
    if (!began_) fail("expected a GeoJSON object or an array of rings", found);
    return true;
  }
  bool number(double value) {
    if (!in_coordinates()) return scalar("a number");
    if (!(std::abs(value) <= largest_coordinate)) fail("numbers must be finite and not exceed 1e60 in magnitude");
    position_.push_back(std::abs(value) < smallest_coordinate ? 0.0 : value);
    return true;
  }
  void end_position() {
    if (position_.size() < 2) fail("expected a position of two or three numbers", "1 number");
    Coordinates& c = object().coordinates;
    if (c.depth != 0 && c.depth != list_depth_) fail("\"coordinates\" are nested unevenly");
    c.depth = list_depth_;
    if (!chain_open_) push_asked(c.chains, {{}, line_}, execution_);
    chain_open_ = true;
    push_asked(c.chains.back().corners, {position_[0], position_[1]}, execution_);
    position_.clear();
    execution_.poll(++looks_);
  }
  void end_geometry(const Object& ended) {
    const int depth = depth_of(ended.type);
    const Coordinates& c = ended.coordinates;
    if (!c.given) {
      if (depth > 0) fail(fmt::format("a {} needs \"coordinates\"", ended.type));
      return;
    }
    if (c.chains.empty()) return;  // "coordinates": [] is an empty geometry
    const bool is_group =
        ended.type == "Feature" || ended.type == "FeatureCollection" || ended.type == "GeometryCollection";
    if (depth == 0 && ended.is_geometry && !is_group) {
      fail("\"coordinates\" need a \"type\": Point, LineString, Polygon, MultiPoint, MultiLineString or MultiPolygon",
           ended.type);
    }
    if (depth == 0) return;  // some other object's key of that name
    if (c.depth != depth)
      fail(fmt::format("the \"coordinates\" of a {} are nested {} deep", ended.type, depth), std::to_string(c.depth));
    if (depth >= 3 && ended.type != "MultiLineString") return add_rings(c);
    const bool points = ended.type == "Point" || ended.type == "MultiPoint";
    for (const auto& [chain, line] : c.chains) {
      if (!points && chain.size() < 2) fail_at(line, "a LineString needs two positions or more");
      push_asked(waiting_, {points ? Piece::Kind::point : Piece::Kind::wall, chain, line}, execution_);
    }
  }
  /// The first ring of each polygon; the ones after it are its holes. In a bare array each ring is a polygon.
  void add_rings(const Coordinates& c) {
    for (std::size_t i = 0; i < c.chains.size(); ++i) {
      auto [ring, line] = c.chains[i];
      const bool closed = ring.front() == ring.back();
      if (!bare_ && (!closed || ring.size() < 4)) {
        fail_at(line, "a ring needs four positions or more, the last one equal to the first",
                closed ? counted(ring.size(), "position", "positions") : "an open ring");
      }
      const bool outer = bare_ || (c.depth == 3 ? i == 0 : std::binary_search(c.groups.begin(), c.groups.end(), i));
      if (!bare_) ring.pop_back();
      if (outer) {
        push_asked(waiting_, {Piece::Kind::polygon, std::move(ring), line}, execution_);
      } else {
        push_asked(waiting_.back().holes, std::move(ring), execution_);
      }
    }
  }
  /// Takes the pieces that wait, from the one of that number on, into the world. role: "start", "goal", "bounds", or
  /// else they are obstacles.
  void settle(std::size_t first, const std::string& role) {
    const bool has_role = role == "start" || role == "goal" || role == "bounds";
    for (std::size_t i = first; i < waiting_.size(); ++i) {
      has_role ? settle_role(waiting_[i], role) : settle_obstacle(waiting_[i]);
    }
    waiting_.resize(first);
  }
  void settle_role(const Piece& piece, const std::string& role) {
    const bool wants_point = role != "bounds";
    if ((piece.kind == Piece::Kind::point) != wants_point || piece.kind == Piece::Kind::wall) {
      fail_at(piece.line, fmt::format("the role \"{}\" is that of a {}", role, wants_point ? "Point" : "Polygon"));
    }
    if (wants_point) {
      std::vector<double>& state = role == "start" ? scene_.start : scene_.goal;
      if (!state.empty() || piece.points.size() != 1) fail_at(piece.line, fmt::format("a second \"{}\"", role));
      state = {piece.points[0].x, piece.points[0].y};
      return;
    }
    if (scene_.bounds) fail_at(piece.line, "a second \"bounds\"");
    const Box box = box_around(piece.points);
    if (!(box.width() > 0.0) || !(box.height() > 0.0)) fail_at(piece.line, "the bounds have no area");
    scene_.bounds = box;
  }
  void settle_obstacle(Piece& piece) {
    if (piece.kind == Piece::Kind::point) return;  // a mark on a map blocks nothing
    if (piece.kind == Piece::Kind::wall) return walls_.add_chain(piece.points);
    add_without_holes(scene_, piece.line, std::move(piece.points), piece.holes, execution_);
  }

  const std::string& file_;
  const std::size_t& line_;
  const Execution& execution_;
  Scene scene_;
  WallCollector walls_;
  std::vector<Piece> waiting_;
  std::vector<Object> objects_;
  std::string key_;
  int list_depth_ = 0;  // inside "coordinates", or the array of rings
  std::vector<double> position_;
  bool chain_open_ = false;
  bool bare_ = false;  // an array of rings
  bool began_ = false;
  std::size_t looks_ = 0;
};

std::string position(Vec2 p) { return fmt::format("[{}, {}]", p.x + 0.0, p.y + 0.0); }

}  // namespace

bool is_geojson(std::string_view bytes) {
  bytes = without_byte_order_mark(bytes.substr(0, bytes_that_tell));
  const std::size_t at = bytes.find_first_not_of(" \t\r\n");
  return at != std::string_view::npos && (bytes[at] == '{' || bytes[at] == '[');
}

Scene read_geojson(const InputFile& file, const Execution& execution) {
  JsonBytes bytes(file, execution);
  Reader reader(file.name(), bytes.line(), execution);
  Json::sax_parse(bytes.begin(), bytes.end(), &reader);
  return reader.finish();
}

void write_geojson(const Scene& scene, const std::string& path, const Execution& execution) {
  if (has_solids(scene)) throw InputError(path, "GeoJSON holds no solids; write them to a .scene file");
  if (scene.start.size() > 2 || scene.goal.size() > 2) {
    throw InputError(path, "GeoJSON holds places X Y, no states with angles; write them to a .scene file");
  }
  OutputFile file(path, execution);
  std::size_t written = 0;
  const auto feature = [&](std::string_view role, std::string_view type, std::string_view coordinates) {
    execution.poll(++written);
    const std::string properties = role.empty() ? "{}" : fmt::format("{{\"role\": \"{}\"}}", role);
    file.write(
        fmt::format("{}\n{{\"type\": \"Feature\", \"properties\": {}, \"geometry\": {{\"type\": \"{}\", "
                    "\"coordinates\": {}}}}}",
                    written == 1 ? "" : ",", properties, type, coordinates));
  };
  const auto ring = [&](std::string_view role, std::span<const Vec2> corners) {
    std::string text = "[[";
    for (std::size_t i = 0; i < corners.size(); ++i) {
      execution.poll(i + 1);
      text += position(corners[i]) + ", ";
    }
    feature(role, "Polygon", text + position(corners.front()) + "]]");
  };
  file.write("{\"type\": \"FeatureCollection\", \"features\": [");
  if (scene.bounds) ring("bounds", scene.bounds->corners());
  if (!scene.start.empty()) feature("start", "Point", position({scene.start[0], scene.start[1]}));
  if (!scene.goal.empty()) feature("goal", "Point", position({scene.goal[0], scene.goal[1]}));
  for (const ScenePolygon& polygon : scene.polygons) ring({}, anticlockwise(polygon.corners));
  scene.walls.visit([&](auto walls) {
    for (const auto& wall : walls) {
      const Segment s = wall.segment();
      feature({}, "LineString", "[" + position(s.a) + ", " + position(s.b) + "]");
    }
  });
  file.write("\n]}\n");
  file.commit();
}

}  // namespace warren
