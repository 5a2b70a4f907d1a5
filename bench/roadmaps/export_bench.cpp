// SPDX-License-Identifier: BSD-3-Clause
// Exports of a roadmap, in bytes of files a second: 100,000 vertices in the plane, each joined with ten others. The
// files go to the folder of temporary files, where they mostly meet the page cache: formatting is what is timed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "solve/kept/export_roadmap.hpp"

namespace warren::bench {
namespace {

/// Vertex v is joined with v + 1, v + 5 and so on, modulo the number of vertices, in one direction: a row has no more
/// to it.
struct RingRoadmap {
  static constexpr VertexId vertices = 100'000;
  static constexpr VertexId degree = 10;

  RingRoadmap() : edge_states(edge_state_words(std::size_t{vertices} * degree)), component(vertices) {
    for (std::uint64_t i = 0; i < 2 * vertices; ++i) states.push_back(uniform(1, i, 0) * 100);
    for (VertexId v = 0; v < vertices; ++v) {
      std::vector<VertexId> row;
      for (VertexId k = 0; k < degree; ++k) row.push_back((v + 1 + 4 * k) % vertices);
      std::sort(row.begin(), row.end());
      first.push_back(static_cast<EdgeEnd>(to.size()));
      to.insert(to.end(), row.begin(), row.end());
    }
    first.push_back(static_cast<EdgeEnd>(to.size()));
    for (std::size_t end = 0; end < to.size(); ++end) set_edge_state(edge_states, end, EdgeState::free);
  }
  double operator()(VertexId v, VertexId w) const {
    const double x = states[2 * v] - states[2 * w];
    const double y = states[2 * v + 1] - states[2 * w + 1];
    return std::sqrt(x * x + y * y);
  }
  RoadmapParts parts() const { return {2, true, states, first, to, edge_states, component}; }

  std::vector<double> states;
  std::vector<EdgeEnd> first;
  std::vector<VertexId> to;
  std::vector<std::uint64_t> edge_states;
  std::vector<VertexId> component;
};

void export_to(benchmark::State& state, const char* ending) {
  const RingRoadmap roadmap;
  const std::string path = std::filesystem::temp_directory_path() / (std::string("warren_export_bench") + ending);
  const Execution execution{.threads = static_cast<unsigned>(state.range(0))};
  std::size_t bytes = 0;
  for (auto _ : state) {
    const ExportAccount account = export_roadmap(path, roadmap.parts(), VertexDistance(roadmap), {}, execution);
    check(account.edges == roadmap.to.size(), "export_roadmap");
  }
  for (const std::string& file : files_of_export(path)) {
    bytes += std::filesystem::file_size(file);
    std::filesystem::remove(file);
  }
  report(state, roadmap.to.size(), bytes);
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes));
}

BENCHMARK_CAPTURE(export_to, geojson, ".geojson")->Arg(1)->Arg(2)->Apply(over_threads);
BENCHMARK_CAPTURE(export_to, graphml, ".graphml")->Arg(1)->Arg(2)->Apply(over_threads);
BENCHMARK_CAPTURE(export_to, gr, ".gr")->Arg(1)->Arg(2)->Apply(over_threads);
BENCHMARK_CAPTURE(export_to, csv, ".csv")->Arg(1)->Arg(2)->Apply(over_threads);
BENCHMARK_CAPTURE(export_to, npz, ".npz")->Arg(1)->Arg(2)->Apply(over_threads);
BENCHMARK_CAPTURE(export_to, dot, ".dot")->Arg(1)->Arg(2)->Apply(over_threads);

}  // namespace
}  // namespace warren::bench
