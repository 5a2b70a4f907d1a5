// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/arms/arm_files_io.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <string_view>

#include "core/base/error.hpp"
#include "scenes/scene/convex_hull.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/arms/test_meshes.hpp"

namespace warren {
namespace {

Mesh read_as_mesh(const std::string& name, std::string_view bytes) {
  return read_mesh(InputFile::of_bytes(name, bytes), {});
}

/// The wedge of test_meshes.hpp.
void expect_wedge(const Mesh& mesh) {
  ASSERT_EQ(mesh.points.size(), 6U);
  EXPECT_EQ(mesh.points.front(), Vec3(0, 0, 0));
  EXPECT_EQ(mesh.points.back(), Vec3(2, 1, 0));
  EXPECT_DOUBLE_EQ(std::abs(volume_inside(mesh.points, mesh.triangles)), 3.0);
  EXPECT_EQ(hull_excess(mesh, convex_hull(mesh.points, "wedge", {}), {}), "1.00 times its volume");
}

TEST(MeshIo, ReadsObj) {
  expect_wedge(read_as_mesh("a.obj", test_meshes::obj));
  expect_wedge(read_as_mesh("a.OBJ", test_meshes::obj_from_behind));
}

TEST(MeshIo, ReadsStl) {
  expect_wedge(read_as_mesh("a.stl", test_meshes::stl_text()));
  expect_wedge(read_as_mesh("dir.v1/a.STL", test_meshes::stl_bytes()));
  std::string named = test_meshes::stl_bytes();
  named.replace(0, 5, "solid");
  expect_wedge(read_as_mesh("a.stl", named));
}

TEST(MeshIo, ReadsColladaWithItsNodesAndItsUnit) {
  expect_wedge(read_as_mesh("a.dae", test_meshes::dae("<translate>0 0 0</translate>", "1")));
  expect_wedge(read_as_mesh("a.dae", test_meshes::dae("<scale>100 100 100</scale>", "0.01")));
  const Mesh turned =
      read_as_mesh("a.dae", test_meshes::dae("<translate>5 0 0</translate><rotate>0 0 1 90</rotate>", "1"));
  EXPECT_LT((turned.points.back() - Vec3(5, 2, 0)).norm(), 1e-15);
  const Mesh moved = read_as_mesh("a.dae", test_meshes::dae("<matrix>1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1</matrix>", "1"));
  EXPECT_EQ(moved.points.front(), Vec3(5, 6, 7));
  std::string holed = test_meshes::dae("", "1");
  const std::size_t at = holed.find("<triangles count=\"2\">");
  holed.replace(at, holed.find("</triangles>") + 12 - at,
                "<polygons count=\"2\"><input semantic=\"VERTEX\" source=\"#wedge-vertices\" offset=\"0\"/><p>0 1 2</p>"
                "<ph><p>3 5 4</p><h>3 4 5</h></ph></polygons>");
  expect_wedge(read_as_mesh("a.dae", holed));
}

TEST(MeshIo, TellsHowMuchAHullAdds) {
  const Mesh open = read_as_mesh("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
  EXPECT_NE(hull_excess(open, convex_hull(open.points, "p", {}), {}).find("not closed"), std::string::npos);
  const Mesh flat = read_as_mesh("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_NE(hull_excess(flat, convex_hull(flat.points, "p", {}), {}).find("flat"), std::string::npos);
}

TEST(MeshIo, LeavesOutPointsOfNoTriangle) {
  EXPECT_EQ(read_as_mesh("a.obj", "v 0 0 0\nv 1 0 0\nv 9 9 9\nv 0 1 0\nf 1 2 4\n").points.size(), 3U);
  EXPECT_EQ(read_as_mesh("a.obj", "v 0 0 0\nv 1 0 0\nv 9 9 9\nv 0 1 0\n").points.size(), 4U);
}

TEST(MeshIo, RefusesBadInputInOneLine) {
  struct Case {
    const char* name;
    std::string bytes;
    const char* says;
  };
  std::string half = test_meshes::stl_bytes();
  half.resize(200);
  std::string nan = test_meshes::stl_bytes();
  nan.replace(96, 4, "\xff\xff\xff\xff");
  const auto dae = [](const std::string& nodes) { return test_meshes::dae(nodes, "1"); };
  const auto changed = [&](std::string_view old, std::string_view now) {
    std::string text = dae("");
    return text.replace(text.find(old), old.size(), now);
  };
  std::string many = "<library_nodes>";
  for (int i = 0; i < 20; ++i) {
    std::string twice = "<instance_node url=\"#n" + std::to_string(i + 1) + "\"/>";
    many += "<node id=\"n" + std::to_string(i) + "\">" + twice + twice + "</node>";
  }
  many += "<node id=\"n20\"/></library_nodes>";
  std::string bomb = dae("<instance_node url=\"#n0\"/>");
  bomb.insert(bomb.find("<scene>"), many);
  const Case cases[] = {
      {"a.obj", "v 1 2\n", "a.obj:1: a number is missing"},
      {"a.obj", "v 1 2 3\nf 1 2 3\n", "a.obj:2: a face names one of the 1 points so far (found: 2)"},
      {"a.obj", "v 1 2 3\nf 1 1\n", "at least three corners"},
      {"a.obj", "v 1 2 3\nf 1 0 1\n", "a face names one of"},
      {"a.obj", "v 1 2 1e70\n", "1e60"},
      {"a.obj", "", "no points"},
      {"a.stl", "solid x\nvertex 1 2 3\n", "inside a triangle"},
      {"a.stl", "solid x\nvertex 1 2 3 4\n", "expected `vertex X Y Z`"},
      {"a.stl", "solid x\n", "no points"},
      {"a.stl", half, "expected an STL"},
      {"a.stl", test_meshes::stl_bytes() + "x", "or 484 bytes of 8 triangles (found: 485 bytes)"},
      {"a.stl", "solid\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", "a.stl:4: a triangle has three corners"},
      {"a.obj", "v 1 2 3\nv 0 0 1e8\n",
       "a.obj:2: point 2 of the mesh is not finite, or beyond 100000 m (found: 0 0 100000000)"},
      {"a.stl", "solid\nvertex 0 0 -1e8\n", "a.stl:2: point 1 of the mesh"},
      {"a.dae", dae("<scale>1e8 1 1</scale>"), "a.dae: point 2 of the mesh"},
      {"a.dae", changed("count=\"18\"", "count=\"21\""), "as many as `count` says (found: 18 numbers)"},
      {"a.dae", changed("0 1 2 3 5 4", "0 1 2 3 5 6"), "expected numbers of the 6 points"},
      {"a.dae", changed("0 1 2 3 5 4", "0 1 2 3 5"), "ends inside a polygon"},
      {"a.dae", changed("count=\"2\"", "count=\"3\""), "as many polygons as `count`"},
      {"a.dae", changed("4 4 4", "4 4 4 4"), "<vcount> say (found: 3 in <p>)"},
      {"a.dae", changed("4 4 4", "0 4 4"), "expected counts of corners"},
      {"a.stl", "", "expected an STL"},
      {"a.stl", nan, "not finite"},
      {"a.ply", "ply", "ending that is known"},
      {"ply", "ply", "ending that is known"},
      {"a.dae", "<robot/>", "whose first element is <COLLADA> (found: robot)"},
      {"a.dae", "<COLLADA>\n<a>\n</COLLADA>", "a.dae:3: expected XML"},
      {"a.dae", dae("<rotate>0 0 0 1</rotate>"), "no direction"},
      {"a.dae", dae("<rotate>0 0 1</rotate>"), "expected 4 numbers"},
      {"a.dae", dae("<lookat>0</lookat>"), "export the mesh as OBJ or STL"},
      {"a.dae", dae("<instance_geometry url=\"#none\"/>"), "nothing in this file has this id"},
      {"a.dae", bomb, "at most 100000 nodes"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.says);
    const std::string said = test::refusal<InputError>([&] { read_as_mesh(c.name, c.bytes); });
    EXPECT_NE(said.find(c.says), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace warren
