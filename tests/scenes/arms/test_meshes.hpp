// SPDX-License-Identifier: BSD-3-Clause
// One small body, a wedge of 2 x 1 x 3 whose volume is 3, in every format that meshes are read from.
#pragma once

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace warren::test_meshes {

inline constexpr std::array<std::array<double, 3>, 6> points{
    {{0, 0, 0}, {2, 0, 0}, {0, 0, 3}, {0, 1, 0}, {2, 1, 0}, {0, 1, 3}}};
inline constexpr std::array<std::array<unsigned, 3>, 8> triangles{
    {{0, 1, 2}, {3, 5, 4}, {0, 3, 1}, {1, 3, 4}, {0, 2, 3}, {2, 5, 3}, {1, 4, 2}, {2, 4, 5}}};

inline constexpr std::string_view obj =
    "# a wedge\no wedge\nv 0 0 0\nv 2 0 0 1.0\nv 0 0 3\nv 0 1 0\nv 2 1 0\nv 0. +1 3e0\nvn 0 0 1\ns off\n"
    "f 1 2 3\nf 4//1 6//1 5//1\nf 1 4 5 2\nf 1/1/1 3/1/1 6/1/1 4/1/1\nf 2 5 6 3\n";
inline constexpr std::string_view obj_from_behind =
    "v 0 0 0\nv 2 0 0\nv 0 0 3\nv 0 1 0\nv 2 1 0\nv 0 1 3\nf -6 -5 -4\r\nf -3 -1 -2\nf -6 -3 -2 -5\nf -6 -4 -1 -3\n"
    "f -5 -2 -1 -4\n";

inline std::string stl_text() {
  std::string text = "solid wedge\n";
  for (const auto& triangle : triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const unsigned i : triangle)
      text += fmt::format("  vertex {} {} {}\n", points[i][0], points[i][1], points[i][2]);
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid wedge\n";
}

inline std::string stl_bytes() {
  std::string bytes(80, ' ');
  const auto add = [&](std::uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(word >> (8 * i) & 0xffU));
  };
  add(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    bytes.append(12, '\0');
    for (const unsigned i : triangle)
      for (const double x : points[i]) add(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    bytes.append(2, '\0');
  }
  return bytes;
}

/// The wedge below a node whose transforms are given, in a file of that unit, half of it a polylist.
inline std::string dae(const std::string& transforms, const std::string& meters) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="unit" meter=")" +
         meters + R"("/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="wedge"><mesh>
<source id="wedge-points"><float_array id="array" count="18">0 0 0 2 0 0 0 0 3
0 1 0 2 1 0 0 1 3</float_array><technique_common><accessor source="#array" count="6" stride="3"/></technique_common></source>
<vertices id="wedge-vertices"><input semantic="POSITION" source="#wedge-points"/></vertices>
<triangles count="2"><input semantic="VERTEX" source="#wedge-vertices" offset="0"/><p>0 1 2 3 5 4</p></triangles>
<polylist count="3"><input semantic="NORMAL" source="#none" offset="0"/><input semantic="VERTEX" source="#wedge-vertices" offset="1"/>
<vcount>4 4 4</vcount><p>9 0 9 3 9 4 9 1 9 0 9 2 9 5 9 3 9 1 9 4 9 5 9 2</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node><node>)" +
         transforms +
         R"(<node><instance_geometry url="#wedge"/></node></node></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
)";
}

}  // namespace warren::test_meshes
