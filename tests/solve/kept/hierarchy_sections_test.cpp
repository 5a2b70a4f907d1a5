// SPDX-License-Identifier: BSD-3-Clause
// An index in a file whose checksums are right and whose arrays nobody wrote is refused, array by array.
#include "solve/kept/roadmap_sections.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "tests/solve/kept/small_roadmap_file.hpp"

namespace warren {
namespace {

/// Two edges 0 - 1 - 2 and the shortcut between their ends: 1 was taken out first, then 0, then 2.
struct Arrays {
  std::vector<EdgeEnd> first{0, 1, 3, 3};
  std::vector<VertexId> to{2, 0, 2};
  std::vector<VertexId> middle{1, no_vertex, no_vertex};
  std::vector<double> length{3.0, 1.0, 2.0};
};

class HierarchyFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  Hierarchy read_back(std::span<const RoadmapSection> sections) const {
    test::write_sections(path_, {.writer = "test"}, sections);
    return read_hierarchy(RoadmapFile(path_, {}), 3, {});
  }
  Hierarchy read_back(const Arrays& arrays) const {
    return read_back(std::vector<RoadmapSection>{roadmap_section("up.first", std::span(arrays.first)),
                                                 roadmap_section("up.to", std::span(arrays.to)),
                                                 roadmap_section("up.middle", std::span(arrays.middle)),
                                                 roadmap_section("up.length", std::span(arrays.length))});
  }
  std::string refusal(const std::function<void(Arrays&)>& forge) const {
    Arrays arrays;
    forge(arrays);
    return test::refusal<InputError>([&] { read_back(arrays); });
  }

 private:
  std::string path_ =
      (std::filesystem::temp_directory_path() / ("warren_hierarchy_" + std::to_string(::getpid()))).string();
};

TEST_F(HierarchyFile, IsReadAsItWasWritten) {
  const Hierarchy read = read_back(Arrays{});
  EXPECT_EQ(read.arcs, (RawVector<HierarchyArc>{{2, 1, 3.0}, {0, no_vertex, 1.0}, {2, no_vertex, 2.0}}));
  HeldNumbers held;
  std::vector<RoadmapSection> again;
  append_hierarchy_sections(read, held, again, {});
  const Hierarchy twice = read_back(again);
  EXPECT_EQ(twice.first, read.first);
  EXPECT_EQ(twice.arcs, read.arcs);
}

TEST_F(HierarchyFile, WhatContradictsItselfIsRefusedAndNamed) {
  const auto expect_named = [&](const std::string& array, const std::function<void(Arrays&)>& forge) {
    const std::string said = refusal(forge);
    EXPECT_NE(said.find("its index contradicts itself"), std::string::npos) << said;
    EXPECT_NE(said.find(array), std::string::npos) << said;
  };
  expect_named("up.first", [](Arrays& a) { a.first.pop_back(); });
  expect_named("up.first", [](Arrays& a) { a.first.clear(); });
  expect_named("up.first", [](Arrays& a) { a.first[0] = 1; });
  expect_named("up.first", [](Arrays& a) { a.first[1] = 4; });
  expect_named("up.middle", [](Arrays& a) { a.middle.pop_back(); });
  expect_named("up.middle", [](Arrays& a) { a.to.pop_back(); });
  expect_named("up.length", [](Arrays& a) { a.length.push_back(1.0); });
  expect_named("up.to", [](Arrays& a) { a.to[0] = 0; });
  expect_named("up.to", [](Arrays& a) { a.to[1] = 2; });
  expect_named("up.to", [](Arrays& a) { a.to[0] = 3; });
  expect_named("up.middle", [](Arrays& a) { a.middle[0] = 2; });
  expect_named("up.middle", [](Arrays& a) { a.middle[0] = 3; });
  expect_named("up.length", [](Arrays& a) { a.length[1] = -1.0; });
}

}  // namespace
}  // namespace warren
