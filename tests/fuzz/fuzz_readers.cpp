// SPDX-License-Identifier: BSD-3-Clause
// One program for all readers, since each links the same libraries: WARREN_FUZZ_READER says which one is fed. It is in
// the environment because libFuzzer's own children (-fork, -merge) inherit it.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fuzz_reader.hpp"

namespace warren::fuzz {
namespace {

auto all_readers() {
  return std::array{plane_readers(), map_readers(), record_readers(), roadmap_readers(), request_readers()};
}

const FuzzReader* reader_named(std::string_view name) {
  for (const auto readers : all_readers()) {
    const auto found = std::find_if(readers.begin(), readers.end(), [&](const auto& r) { return r.name == name; });
    if (found != readers.end()) return &*found;
  }
  return nullptr;
}

const FuzzReader& chosen_reader() {
  const char* name = std::getenv("WARREN_FUZZ_READER");
  const FuzzReader* reader = reader_named(name == nullptr ? "" : name);
  if (reader != nullptr) return *reader;
  std::fputs("WARREN_FUZZ_READER must be one of:", stderr);
  for (const auto readers : all_readers()) {
    for (const FuzzReader& known : readers)
      std::fprintf(stderr, " %.*s", static_cast<int>(known.name.size()), known.name.data());
  }
  std::fputs("\n", stderr);
  std::exit(2);
}

}  // namespace
}  // namespace warren::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT: libFuzzer's name

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  // NOLINT: libFuzzer's name
  static const warren::fuzz::FuzzReader& reader = warren::fuzz::chosen_reader();
  reader.read({reinterpret_cast<const char*>(data), size});
  return 0;
}
