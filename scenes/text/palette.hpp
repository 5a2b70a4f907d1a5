// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace warren {

/// Wraps text in colour where it is on.
class Palette {
 public:
  explicit Palette(bool on) : on_(on) {}
  std::string good(std::string_view text) const { return painted("1;32", text); }
  std::string bad(std::string_view text) const { return painted("1;31", text); }
  std::string doubtful(std::string_view text) const { return painted("1;33", text); }
  std::string strong(std::string_view text) const { return painted("1", text); }
  std::string faint(std::string_view text) const { return painted("2", text); }

 private:
  std::string painted(std::string_view code, std::string_view text) const;
  bool on_;
};

}  // namespace warren
