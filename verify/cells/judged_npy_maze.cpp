// SPDX-License-Identifier: BSD-3-Clause
#include "verify/cells/judged_npy_maze.hpp"

#include <cstring>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

constexpr unsigned npy_side_log2 = 8;

/// Where the numbers begin: behind a header whose length stands at byte 8, in 2 bytes in version 1, in 4 in others.
std::size_t begin_of_numbers(const std::string& name, std::string_view bytes) {
  const auto byte = [&](std::size_t at) { return std::size_t{as_whole<unsigned char>(bytes[at])}; };
  if (bytes.size() < 12 || !bytes.starts_with("\x93NUMPY"))
    throw InputError(name, "is no .npy file that can be judged");
  const std::size_t begin = byte(6) == 1
                                ? 10 + byte(8) + 256 * byte(9)
                                : 12 + byte(8) + 256 * byte(9) + 65536 * byte(10) + std::size_t{16777216} * byte(11);
  if (begin > bytes.size()) throw InputError(name, "is no .npy file that can be judged");
  return begin;
}

}  // namespace

JudgedNpyMaze::JudgedNpyMaze(const std::string& name, std::string_view bytes, std::uint32_t rows, std::uint32_t cols,
                             Range held, const Forget& forget, const Execution& execution)
    : JudgedGridLines(rows, cols, npy_side_log2, held, execution) {
  constexpr std::size_t window = std::size_t{1} << 23;  // bytes
  const std::size_t begin = begin_of_numbers(name, bytes);
  const bool is_float = bytes.substr(0, begin).find("<f4") != std::string_view::npos;
  for (std::size_t at = begin; at < bytes.size(); at += window) {
    const std::string_view numbers = bytes.substr(at, window);
    is_float ? take_all<float>(name, numbers, execution) : take_all<double>(name, numbers, execution);
    if (forget) forget(at, at + numbers.size());
  }
}

template <class T>
void JudgedNpyMaze::take_all(const std::string& name, std::string_view numbers, const Execution& execution) {
  T wall[4];
  for (std::size_t at = 0; at + sizeof wall <= numbers.size(); at += sizeof wall) {
    if (at % (std::size_t{1} << 20) == 0) execution.check();
    std::memcpy(wall, numbers.data() + at, sizeof wall);
    take(name, wall[0], wall[1], wall[2], wall[3], execution);
  }
}

}  // namespace warren
