// SPDX-License-Identifier: BSD-3-Clause
// Bytes as base 64, piece by piece: images inside of text.
#pragma once

#include <string>
#include <string_view>

#include "pictures/formats/write_picture.hpp"

namespace warren {

class Base64 {
 public:
  explicit Base64(const Write& write) : write_(write) {}
  void write(std::string_view bytes);
  /// Writes what is left; nothing may follow.
  void end();

 private:
  const Write& write_;
  std::string left_;  // bytes that are no whole group of three
};

}  // namespace warren
