// SPDX-License-Identifier: BSD-3-Clause
// The .roadmap file at 256 MiB: written into the page cache, opened and checked whole; and the rules of a roadmap's
// arrays.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/report.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "solve/kept/roadmap_file.hpp"

namespace warren::bench {
namespace {

constexpr std::size_t file_numbers = std::size_t{1} << 25;  // 256 MiB

/// In the folder for temporary files; gone when the program ends.
class FileToRead : NotCopied {
 public:
  FileToRead() : numbers_(file_numbers), path_(std::filesystem::temp_directory_path() / "warren_bench.roadmap") {
    for (std::size_t i = 0; i < numbers_.size(); ++i) numbers_[i] = i * 0x9e3779b97f4a7c15U;
    write({});
  }
  ~FileToRead() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  void write(const Execution& execution) const {
    const RoadmapSection section = roadmap_section("numbers", numbers_);
    OutputFile file(path_, execution);
    write_roadmap_file(file, {1, 2, "bench"}, {&section, 1}, execution);
    file.commit();
  }
  const std::string& path() const { return path_; }
  std::span<const std::uint64_t> numbers() const { return numbers_; }
  static const FileToRead& shared() {
    static const FileToRead file;
    return file;
  }

 private:
  std::vector<std::uint64_t> numbers_;
  std::string path_;
};

void report_bytes(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(bytes));
}

void bm_roadmap_file_write(benchmark::State& state) {
  const FileToRead& file = FileToRead::shared();
  for (auto _ : state) file.write({.threads = static_cast<unsigned>(state.range(0))});
  report_bytes(state, file_numbers * sizeof(std::uint64_t));
}
BENCHMARK(bm_roadmap_file_write)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void bm_roadmap_file_open(benchmark::State& state) {
  const FileToRead& file = FileToRead::shared();
  for (auto _ : state) benchmark::DoNotOptimize(RoadmapFile(file.path(), one_thread).sections().size());
}
BENCHMARK(bm_roadmap_file_open)->UseRealTime()->Unit(benchmark::kMicrosecond);

void bm_roadmap_file_check_all(benchmark::State& state) {
  const FileToRead& file = FileToRead::shared();
  for (auto _ : state) {
    const RoadmapFile open(file.path(), one_thread);
    open.check_all({.threads = static_cast<unsigned>(state.range(0))});
  }
  report_bytes(state, file_numbers * sizeof(std::uint64_t));
}
BENCHMARK(bm_roadmap_file_check_all)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Vertex v is joined with v + 1 ... v + reach, as neighbours in tile order are.
struct Band {
  static constexpr std::size_t vertices = 1'000'000;
  static constexpr std::size_t reach = 10;
  std::vector<double> states;
  std::vector<EdgeEnd> first{0};
  std::vector<VertexId> to;
  std::vector<std::uint64_t> edge_states;
  std::vector<VertexId> component = std::vector<VertexId>(vertices, 0);

  Band() {
    for (std::size_t v = 0; v < vertices; ++v) {
      states.insert(states.end(), {static_cast<double>(v), 0.5});
      for (std::size_t w = v - std::min(v, reach); w <= std::min(v + reach, vertices - 1); ++w) {
        if (w != v) to.push_back(static_cast<VertexId>(w));
      }
      first.push_back(static_cast<EdgeEnd>(to.size()));
    }
    edge_states.assign(edge_state_words(to.size()), 0);
    for (std::size_t end = 0; end < to.size(); ++end) set_edge_state(edge_states, end, EdgeState::free);
  }
  RoadmapParts parts(bool directed) const { return {2, directed, states, first, to, edge_states, component}; }
};

/// Of a million vertices and 20 million ends; directed ones have no twins to look for.
void bm_roadmap_check_parts(benchmark::State& state) {
  static const Band band;
  const RoadmapParts parts = band.parts(state.range(0) == 1);
  for (auto _ : state) check_parts(parts, "bench", {.threads = static_cast<unsigned>(state.range(1))});
  report(state, band.to.size(), band.to.size() * sizeof(VertexId));
}
BENCHMARK(bm_roadmap_check_parts)
    ->ArgNames({"directed", "threads"})
    ->ArgsProduct({{0, 1}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren::bench
