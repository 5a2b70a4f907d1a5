// SPDX-License-Identifier: BSD-3-Clause
// export_samples FOLDER: roadmaps in all formats, and beside them the lengths of shortest paths from vertex 0 by the
// plainest Dijkstra (NAME.lengths: one a line, "inf" where no path leads). read_exports.py reads them with strangers'
// programs.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <queue>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "parallel/chunks.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "solve/kept/roadmap_formats_io.hpp"
#include "tests/solve/kept/listed_roadmap.hpp"

namespace warren {
namespace {

/// Each vertex tries the next few numbers and some far ones; states of edges are drawn, most of them free.
ListedRoadmap drawn(unsigned dimension, bool directed, VertexId vertices, std::uint64_t seed) {
  std::vector<double> states;
  std::vector<ListedEdge> edges;
  for (std::uint64_t i = 0; i < std::uint64_t{vertices} * dimension; ++i)
    states.push_back(uniform(seed, i, 0) * 20 - 7);
  for (VertexId v = 0; v < vertices; ++v) {
    for (VertexId step = 1; step <= 60; step += step < 4 ? 1 : 23) {
      const VertexId w = v + step;
      const double chance = uniform(seed + 1, v, step);
      if (w >= vertices || chance > 0.8) continue;
      const EdgeState state = chance < 0.5    ? EdgeState::free
                              : chance < 0.65 ? EdgeState::unchecked
                                              : EdgeState::blocked;
      edges.push_back({v, w, state});
      if (directed && chance < 0.3) edges.push_back({w, v, EdgeState::free});
    }
  }
  return {dimension, directed, std::move(states), std::move(edges)};
}

std::vector<double> lengths_from_first(const ListedRoadmap& roadmap, bool with_unchecked) {
  const RoadmapParts parts = roadmap.parts();
  std::vector<double> lengths(parts.vertex_count(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, VertexId>> open;
  lengths[0] = 0;
  open.push({0, 0});
  while (!open.empty()) {
    const auto [minus_length, v] = open.top();
    open.pop();
    if (-minus_length > lengths[v]) continue;
    for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
      const EdgeState state = parts.state_of_end(end);
      if (state != EdgeState::free && !(with_unchecked && state == EdgeState::unchecked)) continue;
      const double length = lengths[v] + roadmap(v, parts.to[end]);
      if (length >= lengths[parts.to[end]]) continue;
      lengths[parts.to[end]] = length;
      open.push({-length, parts.to[end]});
    }
  }
  return lengths;
}

void export_all(const ListedRoadmap& roadmap, const std::string& stem, bool with_unchecked) {
  for (const char* ending : {".geojson", ".graphml", ".gr", ".csv", ".npz", ".dot"}) {
    if (roadmap.parts().dimension == 6 && ending == std::string(".geojson")) continue;
    export_roadmap(stem + ending, roadmap.parts(), roadmap.length(), {.with_unchecked = with_unchecked}, {});
  }
  std::ofstream file(stem + ".lengths");
  file.precision(17);
  for (const double length : lengths_from_first(roadmap, with_unchecked)) file << length << '\n';
}

/// Members and places from 100 bytes on as if they were too large for the plain format.
void write_long_zip(const std::string& path) {
  OutputFile file(path, {});
  StoredZip zip(file, 100);
  for (const std::size_t size : {0U, 99U, 100U, 70'000U}) {
    zip.begin("member" + std::to_string(size), size);
    zip.write(std::string(size, 'w'));
    zip.end();
  }
  zip.close();
  file.commit();
}

void write_samples(const std::string& folder) {
  export_all(drawn(2, false, 3000, 1), folder + "/point", false);
  export_all(drawn(2, false, 500, 2), folder + "/lazy", true);
  export_all(drawn(3, true, 2000, 3), folder + "/car", false);
  export_all(drawn(6, false, 400, 6), folder + "/arm", false);
  write_long_zip(folder + "/long.zip");
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    warren::write_samples(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
