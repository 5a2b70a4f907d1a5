// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/human_units.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/printable.hpp"

namespace warren {

std::string human_count(double count) {
  constexpr std::array<std::string_view, 4> units{"", " k", " M", " G"};
  std::size_t unit = 0;
  for (; count >= 1000.0 && unit + 1 < units.size(); ++unit) count /= 1000.0;
  return fmt::format("{:.{}f}{}", count, unit == 0 || count >= 100.0 ? 0 : 1, units[unit]);
}

std::string human_seconds(double seconds) {
  if (seconds < 0.1) return fmt::format("{:.{}f} ms", seconds * 1e3, seconds < 0.01 ? 2 : 1);
  if (seconds < 60.0) return fmt::format("{:.{}f} s", seconds, seconds < 10.0 ? 2 : 1);
  const auto whole = static_cast<std::uint64_t>(seconds < 1e15 ? seconds : 1e15);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string precise_seconds(double seconds) {
  constexpr std::array<std::string_view, 4> units{"ns", "us", "ms", "s"};
  double value = seconds * 1e9;
  std::size_t unit = 0;
  for (; std::abs(value) >= 999.5 && unit + 1 < units.size(); ++unit) value /= 1000.0;
  const double size = std::abs(value);
  return fmt::format("{:.{}f} {}", value, size >= 99.95 || unit == 0 ? 0 : size >= 9.995 ? 1 : 2, units[unit]);
}

std::string human_bytes(double bytes) {
  constexpr std::array<std::string_view, 5> units{"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  for (; bytes >= 1024.0 && unit + 1 < units.size(); ++unit) bytes /= 1024.0;
  return fmt::format("{:.{}f} {}", bytes, unit == 0 || bytes >= 100.0 ? 0 : 1, units[unit]);
}

std::string stop_text(StopReason reason, std::size_t wanted_bytes) {
  std::string text{text_of(reason)};
  if (reason != StopReason::memory || wanted_bytes == 0) return text;
  return text + fmt::format(", {} at least", human_bytes(static_cast<double>(wanted_bytes)));
}

std::string grouped(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ' ');
  return text;
}

std::string counted(std::uint64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", grouped(count), count == 1 ? one : many);
}

std::string human_number(double value) {
  constexpr double most_plain = 1e15;  // beyond it a power of ten is easier to read
  const std::string text = fmt::format("{:.6g}", value);
  const bool has_power = text.find("e+") != std::string::npos;
  return has_power && std::abs(value) < most_plain ? fmt::format("{:.0f}", value) : text;
}

std::string csv_field(std::string_view text) {
  std::string shown = printable(text);
  if (shown.find_first_of(",\"") == std::string::npos) return shown;
  std::string quoted = "\"";
  for (const char c : shown) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string Palette::painted(std::string_view code, std::string_view text) const {
  if (!on_) return printable(text);
  return "\x1b[" + std::string{code} + "m" + printable(text) + "\x1b[0m";
}

}  // namespace warren
