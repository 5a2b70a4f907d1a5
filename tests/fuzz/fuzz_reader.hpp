// SPDX-License-Identifier: BSD-3-Clause
// What is fuzzed: a table of readers. Each takes the bytes of a file and demands more than that nothing crashes; what
// it demands is said where it is defined. The table is put together in fuzz_readers.cpp.
#pragma once

#include <span>
#include <string_view>

namespace warren::fuzz {

struct FuzzReader {
  std::string_view name;  ///< also the folder of its seeds
  void (*read)(std::string_view bytes);
};

std::span<const FuzzReader> plane_readers();    ///< walls and polygons: plane_readers.cpp
std::span<const FuzzReader> map_readers();      ///< cells: map_readers.cpp
std::span<const FuzzReader> record_readers();   ///< all else: record_readers.cpp
std::span<const FuzzReader> roadmap_readers();  ///< saved roadmaps: roadmap_readers.cpp
std::span<const FuzzReader> request_readers();  ///< what comes over a socket: request_readers.cpp

}  // namespace warren::fuzz
