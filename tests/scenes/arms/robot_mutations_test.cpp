// SPDX-License-Identifier: BSD-3-Clause
// Files of robots with bytes, words and pieces changed: each is read, or refused in one line. WARREN_SEEDS=all: a
// thousand of each kind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/scene/convex_hull.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/arms/test_meshes.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

constexpr std::string_view urdf = R"(<?xml version="1.0"?>
<robot name="r">
<link name="a"><collision><origin xyz="0 0 0.1" rpy="0 1 0"/><geometry><box size="1 2 3"/></geometry></collision></link>
<link name="b"><collision><geometry><mesh filename="w.obj" scale="1 2 1"/></geometry></collision></link>
<link name="c"><collision><geometry><cylinder radius="0.1" length="2"/></geometry></collision></link>
<link name="d"><collision><geometry><sphere radius="1"/></geometry></collision></link>
<joint name="1" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="2"/></joint>
<joint name="2" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/></joint>
<joint name="3" type="prismatic"><parent link="c"/><child link="d"/><limit lower="0" upper="1"/><mimic joint="1" multiplier="0.5"/></joint>
</robot>)";
constexpr std::string_view srdf = R"(<robot name="r">
<group name="g"><chain base_link="a" tip_link="c"/><joint name="3"/><link name="d"/><group name="h"/></group>
<group name="h"><joint name="1"/></group><passive_joint name="3"/><virtual_joint name="v" type="fixed"/>
<disable_collisions link1="a" link2="c"/><disable_default_collisions link="d"/><enable_collisions link1="d" link2="a"/>
</robot>)";

/// The text with some changes.
std::string mutated(std::string text, std::uint64_t seed) {
  SequentialRng rng(seed);
  constexpr std::array<std::string_view, 12> words{"-1", "1e999", "nan", "0", "1e60",       "",
                                                   "\"", "<",     ">",   "a", "4294967296", "\xff"};
  for (std::uint64_t changes = 1 + seed % 4; changes > 0 && !text.empty(); --changes) {
    const std::size_t at = rng.next() % text.size();
    const std::size_t length = 1 + rng.next() % std::min<std::size_t>(text.size() - at, 40);
    std::size_t end = at;
    switch (rng.next() % 16) {
      case 0:
        text[at] = static_cast<char>(rng.next());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(rng.next() % text.size(), text.substr(at, length));
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        text.insert(at, words[rng.next() % words.size()]);
        break;
      default:  // a word for another one
        while (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end])) != 0) ++end;
        text.replace(at, end - at, words[rng.next() % words.size()]);
    }
  }
  return text;
}

/// Reads it, or is refused in one line.
template <class Read>
bool taken(const Read& read) {
  const std::string said = test::refusal<PlacedError>(read);
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  return said.empty();
}

std::vector<std::uint64_t> mutation_seeds() { return test::seeds(1200, 80); }

TEST(RobotMutations, ModelsThatAreTakenAreWhole) {
  const TemporaryDirectory directory;
  directory.write("w.obj", test_meshes::obj);
  std::size_t whole = 0;
  for (const std::uint64_t seed : mutation_seeds()) {
    for (const bool of_srdf : {false, true}) {
      SCOPED_TRACE(seed);
      ArmFiles files{directory.write("r.urdf", of_srdf ? std::string(urdf) : mutated(std::string(urdf), seed))};
      if (of_srdf || seed % 2 == 0) {
        files.srdf = directory.write("r.srdf", of_srdf ? mutated(std::string(srdf), seed) : std::string(srdf));
        files.group = "g";
      }
      if (!taken([&] {
            const ArmModel model = read_urdf(files, {});
            for (const ArmVariable& v : model.variables) ASSERT_TRUE(std::isfinite(v.low) && v.low <= v.high);
            for (std::size_t j = 0; j < model.joints.size(); ++j) {
              ASSERT_LT(model.joints[j].parent, static_cast<int>(j));
              ASSERT_LT(model.joints[j].variable, model.variables.size());
              ASSERT_NEAR(model.joints[j].axis.norm(), 1.0, 1e-12);
            }
            for (const auto& [a, b] : model.pairs) ASSERT_TRUE(a < b && b < model.links.size());
          }))
        continue;
      ++whole;
    }
  }
  EXPECT_GT(whole, test::share(200, 5));  // of any eighty that follow each other six are
}

TEST(RobotMutations, MeshesThatAreTakenHaveHulls) {
  const std::pair<const char*, std::string> meshes[] = {
      {"m.obj", std::string(test_meshes::obj)},
      {"m.stl", test_meshes::stl_text()},
      {"m.STL", test_meshes::stl_bytes()},
      {"m.dae", test_meshes::dae("<rotate>0 0 1 90</rotate><scale>1 2 3</scale>", "0.1")}};
  for (const auto& [name, bytes] : meshes) {
    std::size_t whole = 0;
    for (const std::uint64_t seed : mutation_seeds()) {
      SCOPED_TRACE(fmt::format("{} {}", name, seed));
      whole += taken([&, file = name, &text = bytes] {
        std::string some = mutated(text, seed);
        if (seed % 2 == 0 && std::string_view(file) == "m.STL") some.resize(text.size());  // as long as its count says
        const Mesh mesh = read_mesh(InputFile::of_bytes(file, some), {});
        for (const auto& triangle : mesh.triangles)
          for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.points.size());
        const Solid hull = convex_hull(mesh.points, file, {});
        ASSERT_FALSE(hull.corners.empty());
        hull_excess(mesh, hull, {});
      });
    }
    EXPECT_GT(whole, 0U) << name;
  }
}

}  // namespace
}  // namespace warren
