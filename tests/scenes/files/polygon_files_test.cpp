// SPDX-License-Identifier: BSD-3-Clause
// Polygons from other programs' files: what each format means, its variants, and what is refused with which line.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/plane/polygon.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/scene/polygon_generator.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

using Outline = std::vector<Vec2>;

Scene read(std::string_view text, const std::string& name = "a.txt") {
  const TemporaryDirectory directory;
  return read_scene(InputFile(directory.write(name, text), {}), {});
}

std::vector<Outline> outlines(const Scene& scene) {
  std::vector<Outline> all;
  for (const ScenePolygon& polygon : scene.polygons) all.push_back(polygon.corners);
  return all;
}

void expect_refused(std::string_view text, std::string_view said, const std::string& name = "a.txt") {
  SCOPED_TRACE(text);
  const std::string refused = test::refusal<InputError>([&] { read(text, name); });
  EXPECT_NE(refused.find(said), std::string::npos) << refused;
}

const Outline triangle{{0, 0}, {4, 0}, {0, 3}};
const Outline square{{10, 10}, {11, 10}, {11, 11}, {10, 11}};

TEST(GeoJson, EveryKindOfObjectIsRead) {
  const std::string ring = "[[0,0],[4,0],[0,3],[0,0]]";
  const std::string other = "[[10,10],[11,10],[11,11],[10,11],[10,10]]";
  for (const std::string& text :
       {R"({"type":"Polygon","coordinates":[)" + ring + "]}",
        "\xef\xbb\xbf {\"coordinates\":[" + ring + R"(], "type" : "Polygon"})",
        R"({"type":"Feature","geometry":{"type":"Polygon","coordinates":[)" + ring + R"(]},"properties":null})",
        R"({"type":"FeatureCollection","name":"map","crs":{"type":"name","properties":{"name":"urn"}},"features":[
             {"type":"Feature","properties":{"type":"Point","coordinates":[1,2],"tags":["a",{"type":"Polygon"}]},
              "geometry":{"type":"GeometryCollection","geometries":[{"type":"Polygon","coordinates":[)" +
            ring + R"(]}]}},
             {"type":"Feature","properties":{},"geometry":null}]})",
        std::string("[[[0,0],[4,0],[0,3]]]")}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(outlines(read(text)), (std::vector<Outline>{triangle}));
  }
  const Scene many = read(R"({"type":"MultiPolygon","coordinates":[[)" + ring +
                          ",[[0.5,0.5],[1,0.5],[0.5,1],[0.5,0.5]]],[" + other + "]]}");
  ASSERT_EQ(many.polygons.size(), 3U) << "around the hole stand two";
  EXPECT_EQ(outlines(many)[2], square);
  for (const Outline& part : {outlines(many)[0], outlines(many)[1]}) EXPECT_FALSE(contains(part, {0.6, 0.6}));
  expect_refused("{\"type\":\"Polygon\",\n\"coordinates\":[" + ring + ",[[7,7],[8,7],[7,8],[7,7]]]}",
                 ":2: a hole must");
}

TEST(GeoJson, RolesLinesAndHeightsAreUnderstood) {
  const Scene scene = read(R"({"type":"FeatureCollection","features":[
    {"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],[50,0],[50,20],[0,20],[0,0]]]},"properties":{"role":"bounds"}},
    {"type":"Feature","properties":{"role":"start"},"geometry":{"type":"Point","coordinates":[1,2,9]}},
    {"type":"Feature","properties":{"role":"goal"},"geometry":{"type":"Point","coordinates":[3.5,-4e0]}},
    {"type":"Feature","properties":{"role":"tree"},"geometry":{"type":"Point","coordinates":[7,7]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[1,1,5],[2,2,null],[3,1,null,null]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"MultiLineString","coordinates":[[[5,5],[6,6]],[[7,7],[8,8]]]}}]})");
  ASSERT_TRUE(scene.bounds);
  EXPECT_EQ(scene.bounds->max, (Vec2{50, 20}));
  EXPECT_EQ(scene.start, (std::vector<double>{1, 2}));
  EXPECT_EQ(scene.goal, (std::vector<double>{3.5, -4}));
  EXPECT_TRUE(scene.polygons.empty());
  ASSERT_EQ(scene.walls.size(), 4U);
  EXPECT_EQ(scene.walls.segment(1), (Segment{{2, 2}, {3, 1}}));
  EXPECT_EQ(scene.walls.segment(3), (Segment{{7, 7}, {8, 8}}));
}

TEST(GeoJson, OtherObjectsMayHaveCoordinates) {
  const Scene scene = read(R"({"type": "FeatureCollection", "label": {"coordinates": [1, 2]}, "features": [
    {"type": "feature", "points": [{"coordinates": [1, 2]}], "properties": {"role": "bounds"},
     "geometry": {"type": "Polygon", "coordinates": [[[0,0],[4,0],[4,4],[0,4],[0,0]]]}},
    {"type": "Polygon", "coordinates": [[[1,1],[2,1],[1,2],[1,1]]]}]})");
  EXPECT_TRUE(scene.bounds);
  EXPECT_EQ(scene.polygons.size(), 1U);
}

TEST(GeoJson, WhatIsNoneIsRefusedWithItsLine) {
  const auto polygon = [](const std::string& coordinates) {
    return "{\"type\": \"Polygon\",\n\"coordinates\": " + coordinates + "}";
  };
  expect_refused("{\"type\": \"Polygon\",\n \"coordinates\": [[[0,0],", ":2: this is not JSON");
  expect_refused("{\"type\": \"FeatureCollection\", \"features\": []}", "no polygon and no line");
  expect_refused("{}", "no polygon and no line");
  expect_refused("{\"path\": [[1, 2]]}", "no polygon and no line");
  expect_refused("[1, 2]", "nested 3 deep");
  expect_refused(polygon("[[[0,0],[4,0],[0,3]]]"), ":2: a ring needs four positions");
  expect_refused(polygon("[[[0,0],[4,0],[0,0]]]"), "four positions");
  expect_refused(polygon("[[[0,0]]]"), "equal to the first (found: 1 position)");
  expect_refused(polygon("[[0,0],[4,0],[0,3],[0,0]]"), "nested 3 deep");
  expect_refused(polygon("[[[[0,0],[4,0],[0,3],[0,0]]]]"), "nested 3 deep");
  expect_refused(polygon("[[[[[0,0]]]]]"), "too deeply");
  expect_refused(polygon("[[[0,0],[4],[0,3],[0,0]]]"), "two or three numbers");
  expect_refused(polygon("[[[0,0],[4,\"0\"],[0,3],[0,0]]]"), "expected numbers");
  expect_refused(polygon("[[[0,0],[4,null],[0,3],[0,0]]]"), "expected numbers");
  expect_refused(polygon("[[[0,0],[4,0],null,[0,0]]]"), "expected numbers");
  expect_refused(polygon("[[[0,0],[4,{}],[0,3],[0,0]]]"), "expected numbers");
  expect_refused(polygon("[[[0,0],[4,1e300],[0,3],[0,0]]]"), "1e60");
  expect_refused(polygon("[[[0,0],[4,NaN],[0,3],[0,0]]]"), "not JSON");
  expect_refused(polygon("[[[0,0],4,[0,3],[0,0]]]"), ":2:");
  expect_refused("{\"type\": \"Polygon\"}", "needs \"coordinates\"");
  expect_refused("{\"type\": \"LineString\", \"coordinates\": [[1,2]]}", "two positions");
  const std::string triangle = "\"coordinates\": [[[0,0],[4,0],[0,3],[0,0]]]}";
  expect_refused("{\"type\": \"Feature\",\n\"geometry\": {\"type\": \"polygon\", " + triangle + "}",
                 ":2: \"coordinates\" need a \"type\": Point");
  expect_refused("{\"type\": \"Feature\", \"geometry\": {" + triangle + "}", "need a \"type\"");
  expect_refused("{\"type\": \"GeometryCollection\", \"geometries\": [" + polygon("[[[0,0],[4,0],[0,3],[0,0]]]") +
                     ", {\"type\": \"Polygon Z\", " + triangle + "]}",
                 "(found: Polygon Z)");
  expect_refused("\n\n" + polygon("[[[0,0],[4,4],[4,0],[0,4],[0,0]]]"), ":4: a polygon's outline must not cross");
  expect_refused(polygon("[[[0,0],[4,4],[2,2],[0,0]]]"), ":2: this polygon has no area");
  const std::string place = R"({"type":"Feature","properties":{"role":"start"},"geometry":)";
  expect_refused(place + polygon("[[[0,0],[4,0],[0,3],[0,0]]]") + "}", "that of a Point");
  expect_refused(std::string(100, '[') + "1", "nested too deeply");
  std::string objects;
  for (int i = 0; i < 100; ++i) objects += "{\"a\":";
  expect_refused(objects, "nested too deeply");
}

TEST(Wkt, EveryKindOfGeometryIsRead) {
  for (const char* text : {"POLYGON ((0 0, 4 0, 0 3, 0 0))", "polygon((0 0,4 0,0 3,0 0))",
                           "\n SRID=4326; Polygon Z ((0 0 7, 4 0 7, 0 3 7, 0 0 7))",
                           "POLYGON EMPTY\nPOLYGONZM((0 0 1 2,4 0 1 2,0 3 1 2,0 0 1 2));POINT(1 2)",
                           "GEOMETRYCOLLECTION (POINT EMPTY, POLYGON M ((0 0 1, 4 0 1, 0 3 1, 0 0 1)))",
                           "MULTIPOLYGON (((0 0, 4 0, 0 3, 0 0)), EMPTY)"}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(outlines(read(text)), (std::vector<Outline>{triangle}));
  }
  const Scene scene = read(
      "MULTIPOLYGON(((0 0,4 0,0 3,0 0)),((10 10,11 10,11 11,10 11,10 10)))\r\n"
      "LINESTRING (1 2, 3 +4, -5.5e0 .5)\nMULTILINESTRING ((1 1, 2 2), (3 3, 4 4))\n"
      "MULTIPOINT (1 1, 2 2)\nMULTIPOINT ((1 1), (2 2))\n");
  EXPECT_EQ(outlines(scene), (std::vector<Outline>{triangle, square}));
  ASSERT_EQ(scene.walls.size(), 4U);
  EXPECT_EQ(scene.walls.segment(1), (Segment{{3, 4}, {-5.5, 0.5}}));
  const std::string near = "0." + std::string(350, '0') + "1e+9";
  EXPECT_EQ(read("LINESTRING (1e-400 +1e-101, 2 2)").walls.segment(0), (Segment{{0, 0}, {2, 2}}));
  EXPECT_EQ(read("LINESTRING (" + near + " 0, 2 2)").walls.segment(0), (Segment{{0, 0}, {2, 2}}));
}

TEST(Wkt, WhatIsNoneIsRefusedWithItsLine) {
  expect_refused("POLYGON ((0 0, 4 0, 0 3, 0 0)", "expected `)`");
  expect_refused("POLYGON (0 0, 4 0, 0 3, 0 0)", "expected `(`");
  expect_refused("POINT (1 1)\nPOLYGON ((0 0, 4 0, 0 3))", ":2: a ring needs four positions");
  expect_refused("POLYGON ((0 0, 4 0, 0 0))", "four positions");
  expect_refused("POLYGON ((0 0))", "equal to the first (found: 1 position)");
  expect_refused("POLYGON ((0 0, 4, 0 3, 0 0))", "a number");
  expect_refused("POLYGON ((0 0, 4 nan, 0 3, 0 0))", "a number");
  expect_refused("POLYGON ((0 0, 4 0.5.7, 0 3, 0 0))", "a number");
  expect_refused("LINESTRING (0 0-1, 2 2)", "a number");
  expect_refused("LINESTRING (0 +-1, 2 2)", "a finite number");
  expect_refused("LINESTRING (0 1" + std::string(350, '0') + "e-40, 2 2)", "at most 1e60");
  expect_refused("POLYGON ((0 0, 4 1e70, 0 3, 0 0))", "at most 1e60");
  expect_refused("POLYGON ((0 0, 4 1e999, 0 3, 0 0))", "at most 1e60");
  expect_refused("LINESTRING (1 1)", "two positions");
  expect_refused("POINT (1 1)", "no polygon and no line");
  expect_refused("LINESTRING (0 0, 1 1)\nCIRCLE (0 0, 3)", ":2: expected one of POINT");
  expect_refused("\nPOLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))", ":2: a polygon's outline");
  expect_refused("0 0 4 0\nPOLYGON ((0 0, 4 0, 0 3, 0 0))", ":1: expected one of POINT", "a.wkt");
}

TEST(RingLists, EnvironmentsAreABoundaryAndHoles) {
  const Scene scene = read("//Environment\n0 0\n20 0\n20 20\n0 20\n// a hole\n 10,10\n10 11\n11 11\n11 10\n");
  EXPECT_EQ(outlines(scene), (std::vector<Outline>{{{10, 10}, {10, 11}, {11, 11}, {11, 10}}}));
  ASSERT_EQ(scene.walls.size(), 4U);
  EXPECT_EQ(scene.walls.segment(3), (Segment{{0, 20}, {0, 0}}));
}

TEST(RingLists, PolymapsAreFreeInsideAnOddNumberOfRings) {
  const Scene scene = read(
      "poly\n1\n4\n4 0 0 30 0 30 30 0 30\n4 2 2 9 2 9 9 2 9\n3 3 3 4 3 3 4\n"
      "4 12 12 12 15\n15 15 15 12\n");
  EXPECT_EQ(outlines(scene).size(), 3U) << "the first obstacle is cut, for the triangle in it is free";
  EXPECT_EQ(outlines(scene).back(), (Outline{{12, 12}, {12, 15}, {15, 15}, {15, 12}}));
  for (const Outline& outline : outlines(scene)) EXPECT_FALSE(strictly_inside(outline, {3.2, 3.2}));
  EXPECT_EQ(scene.walls.size(), 4U);
}

/// A room with a notch from above.
constexpr const char* notch = "0 0 10 0 10 8 7 8 7 3 3 3 3 8 0 8\n";

TEST(RingLists, OutsideOfTheOuterRingIsBlocked) {
  const std::vector<Outline> in_notch{{{7, 8}, {3, 8}, {3, 3}, {7, 3}}};
  const Scene polymap = read(std::string("poly\n1\n1\n8\n") + notch);
  EXPECT_EQ(outlines(polymap), in_notch);
  EXPECT_EQ(polymap.walls.size(), 5U) << "those of the notch are the obstacle's sides";
  const Scene environment = read("// ring\n0 0\n10 0\n10 8\n7 8\n7 3\n3 3\n3 8\n0 8\n");
  EXPECT_EQ(outlines(environment), in_notch);
  const Scene diamond = read("// clockwise\n0 1\n1 2\n2 1\n1 0\n");
  EXPECT_EQ(outlines(diamond).size(), 4U) << "a triangle in each corner of its box";
  EXPECT_EQ(diamond.walls.size(), 0U);
}

TEST(RingLists, InsideAnOddNumberOfRingsIsFreeHoweverDeep) {
  const Scene scene = read(
      "poly\n1\n4\n4 0 0 20 0 20 20 0 20\n4 30 0 50 0 50 20 30 20\n"
      "4 2 2 12 2 12 12 2 12\n4 4 4 8 4 8 8 4 8\n");
  const auto is_blocked = [&](Vec2 p) {
    return std::ranges::any_of(outlines(scene), [&](const Outline& outline) { return strictly_inside(outline, p); });
  };
  for (const Vec2 p : {Vec2{1, 1}, Vec2{31, 1}, Vec2{5, 5}, Vec2{6, 7.5}}) EXPECT_FALSE(is_blocked(p)) << p.x;
  for (const Vec2 p : {Vec2{25, 3}, Vec2{3, 3}, Vec2{11, 11}, Vec2{25, 19}}) EXPECT_TRUE(is_blocked(p)) << p.x;
}

TEST(RingLists, PolyFilesAreObstacles) {
  const Scene scene = read("triangle\n0 0\n4 0\n0 3\nEND\n10 10\n11 10\n11 11\n10 11\n10 10\nEND\n", "a.poly");
  ASSERT_EQ(scene.polygons.size(), 2U);
  EXPECT_EQ(scene.polygons[0].corners, triangle);
  EXPECT_EQ(scene.polygons[1].line, 6U);
}

TEST(RingLists, WhatIsNoneIsRefusedWithItsLine) {
  expect_refused("// nothing\n", "no ring");
  expect_refused("// a\n1 2 3\n", ":2: expected two numbers");
  expect_refused("// a\n1\n", ":2:");
  expect_refused("// a\n0 0\n4 0\n", ":2: a polygon needs at least three");
  expect_refused("poly\n2\n", "version 1");
  expect_refused("poly\n1\n1\n2 0 0 1 1\n", "at least 3");
  expect_refused("poly\n1\n2\n3 0 0 1 0 0 1\n", "the end of the file");
  expect_refused("poly\n1\n1\n3 0 0 1 0 0 1 7\n", "expected the end");
  expect_refused("poly\n1\n2\n4 0 0 4 0 4 4 0 4\n4 2 2 6 2 6 6 2 6\n", "crosses another");
}

TEST(PolygonFiles, ContentDecidesBeforeTheEnding) {
  EXPECT_EQ(read("POLYGON ((0 0, 4 0, 0 3, 0 0))", "a.geojson").polygons.size(), 1U);
  EXPECT_EQ(read("{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[4,0],[0,3],[0,0]]]}", "a.wkt").polygons.size(), 1U);
  EXPECT_EQ(read("polygon 0 0 4 0 0 3\n", "a.scene").polygons.size(), 1U) << "scene text, not WKT";
}

TEST(PolygonFiles, ScenesSurviveEveryFormatThatCanHoldThem) {
  const TemporaryDirectory directory;
  Scene scene = polygon_scene({.count = 300, .corners = {}, .seed = 4}, {});
  for (ScenePolygon& polygon : scene.polygons) polygon.corners = anticlockwise(polygon.corners);
  const Segment walls[] = {{{1.0 / 3.0, 1e-7}, {2, -3}}, {{-0.5, -0.25}, {7e20, 1}}};
  scene.walls = WallSet::narrowest(walls);
  for (const char* name : {"a.scene", "a.geojson", "a.wkt"}) {
    SCOPED_TRACE(name);
    Scene written = scene;
    if (std::string_view(name) == "a.wkt") written.bounds.reset();
    write_scene(written, directory.file(name), {});
    const Scene back = read_scene(InputFile(directory.file(name), {}), {});
    EXPECT_EQ(scene_hash(back), scene_hash(written));
    EXPECT_EQ(back.start, written.bounds ? scene.start : std::vector<double>{}) << "WKT holds no places";
  }
  EXPECT_THROW(write_scene(scene, directory.file("b.wkt"), {}), InputError) << "bounds";
  scene.spheres.push_back({0, 0, 0, 1});
  EXPECT_THROW(write_scene(scene, directory.file("b.geojson"), {}), InputError);
  scene.spheres.clear();
  scene.start = {0, 0, 0};
  EXPECT_THROW(write_scene(scene, directory.file("b.geojson"), {}), InputError);
}

}  // namespace
}  // namespace warren
