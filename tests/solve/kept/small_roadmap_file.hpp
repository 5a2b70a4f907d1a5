// SPDX-License-Identifier: BSD-3-Clause
// .roadmap files of given sections, and one of a few sections of all kinds, for whoever wants to read or break one.
#pragma once

#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "solve/kept/roadmap_file.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren::test {

/// The whole file, in its place.
inline void write_sections(const std::string& path, const RoadmapFileHeader& header,
                           std::span<const RoadmapSection> sections, const Execution& execution = {}) {
  OutputFile file(path, execution);
  write_roadmap_file(file, header, sections, execution);
  file.commit();
}

struct SmallRoadmapFile {
  std::string meta = R"({"planner":"prm"})";
  std::vector<double> states{0.5, -1.25, 1e60, 3.0};
  std::vector<std::uint32_t> first = counted(101);
  std::vector<std::uint64_t> empty;
  RoadmapFileHeader header{0x0123456789abcdefU, 42, "warren 0.1.0"};

  static std::vector<std::uint32_t> counted(std::size_t n) {
    std::vector<std::uint32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 7U);
    return numbers;
  }
  std::vector<RoadmapSection> sections() const {
    return {roadmap_section("meta", meta), roadmap_section("states", states), roadmap_section("empty", empty),
            roadmap_section("edge.first", first, true)};
  }
  /// The file's bytes.
  std::string written(const Execution& execution = {}) const {
    const TemporaryDirectory directory;
    write_sections(directory.file("a.roadmap"), header, sections(), execution);
    return directory.read("a.roadmap");
  }
};

}  // namespace warren::test
