// SPDX-License-Identifier: BSD-3-Clause
// .roadmap files, whose checksums are made right first: a fuzzer would never get past them. What is read and written
// again is the same file to the last byte, for its layout is the only one; and a roadmap whose arrays pass their check
// can be walked from any vertex to any end.
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

#include "planners/graph/roadmap_arrays.hpp"
#include "solve/kept/roadmap_file.hpp"
#include "tests/fuzz/fuzz_reader.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/scratch_folder.hpp"
#include "tests/solve/kept/mend_checksums.hpp"

namespace warren::fuzz {
namespace {

void demand_same_again(const RoadmapFile& file, const std::string& bytes) {
  std::vector<RoadmapSection> sections;
  for (const SectionPlace& place : file.sections()) {
    const auto part = std::as_bytes(std::span(bytes)).subspan(place.offset, place.bytes());
    sections.push_back({place.name, place.type, part, place.optional});
  }
  const std::string path = scratch_file("again.roadmap");
  OutputFile out(path, fuzz_execution());
  write_roadmap_file(out, file.header(), sections, fuzz_execution());
  out.commit();
  std::ifstream in(path, std::ios::binary);
  std::string again{std::istreambuf_iterator<char>(in), {}};
  demand(again.size() == bytes.size(), "as many bytes as before");
  again[10] = bytes[10];  // a later minor version is read as well
  again[11] = bytes[11];
  test::mend_checksums(again);
  demand(again == bytes, "a file has one layout");
}

void walk(const RoadmapParts& parts) {
  for (VertexId v = 0; v < parts.vertex_count(); ++v) {
    demand(parts.component[v] <= v && parts.component[parts.component[v]] == parts.component[v], "a smallest vertex");
    for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
      const VertexId w = parts.to[end];
      demand(w < parts.vertex_count() && w != v, "an end leads to another vertex");
      demand(parts.state_of_end(end) <= EdgeState::blocked, "an edge has a state");
      demand(parts.state_of_end(end) != EdgeState::free || parts.component[v] == parts.component[w], "free edges join");
    }
  }
}

void read_roadmap_files(std::string_view given) {
  std::string bytes{given};
  test::mend_checksums(bytes);
  read_or_refuse([&] {
    const auto file = RoadmapFile::of_bytes("fuzzed", bytes, fuzz_execution());
    file.check_all(fuzz_execution());
    demand_same_again(file, bytes);
    const Execution& execution = fuzz_execution();
    for (const bool directed : {false, true}) {
      const RoadmapParts parts{.dimension = 2,
                               .directed = directed,
                               .states = file.section<double>("states", execution),
                               .first = file.section<EdgeEnd>("edge.first", execution),
                               .to = file.section<VertexId>("edge.to", execution),
                               .edge_states = file.section<std::uint64_t>("edge.state", execution),
                               .component = file.section<VertexId>("component", execution)};
      read_or_refuse([&] {
        check_parts(parts, "fuzzed", execution);
        walk(parts);
        return true;
      });
    }
    return true;
  });
}

constexpr std::array roadmap_table{FuzzReader{"roadmap_file", read_roadmap_files}};

}  // namespace

std::span<const FuzzReader> roadmap_readers() { return roadmap_table; }

}  // namespace warren::fuzz
