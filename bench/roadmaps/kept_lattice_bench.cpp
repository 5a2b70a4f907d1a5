// SPDX-License-Identifier: BSD-3-Clause
// A lattice in a file, opened and asked for its first length: the maze of 4000 x 4000 cells without loops, and with 10
// % of the walls left taken out; files of 15 and 46 MB, which are checked whole, and that of 9000 x 9000 cells, whose
// blocks are checked when they are looked at. What is open is closed again.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "bench/report.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/kept/roadmap_query.hpp"

namespace warren::bench {
namespace {

/// The file of a maze of so many rows and columns, which goes when the program ends. loops: in thousandths.
class LatticeFile : NotCopied {
 public:
  LatticeFile(std::int64_t side, std::int64_t loops)
      : path_((std::filesystem::temp_directory_path() /
               ("warren_bench_" + std::to_string(side) + "_" + std::to_string(loops) + ".roadmap"))
                  .string()) {
    const std::string size = std::to_string(side);
    write_roadmap(build(read_world("maze:" + size + "x" + size + ",loops=" + std::to_string(loops / 1000.0))), path_);
  }
  ~LatticeFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

  static const LatticeFile& shared(std::int64_t side, std::int64_t loops) {
    static std::map<std::pair<std::int64_t, std::int64_t>, LatticeFile> files;
    return files.try_emplace({side, loops}, side, loops).first->second;
  }

 private:
  std::string path_;
};

void bm_lattice_open_and_first_length(benchmark::State& state) {
  const LatticeFile& file = LatticeFile::shared(state.range(0), state.range(1));
  const double far = static_cast<double>(state.range(0)) - 3.0;
  for (auto _ : state) {
    const Roadmap roadmap = read_roadmap(file.path());
    const RoadmapQuery query(roadmap, {}, Questions::many);
    QuestionScratch scratch;
    const LengthAnswer answer = query.length_within({17.0, 4.0}, {far, 3.0}, {}, {}, scratch);
    check(answer.outcome == Outcome::solved, "a length");
  }
}
BENCHMARK(bm_lattice_open_and_first_length)
    ->ArgNames({"side", "loops"})
    ->Args({4000, 0})
    ->Args({4000, 100})
    ->Args({9000, 0})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren::bench
