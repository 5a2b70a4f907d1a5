// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/price_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <tuple>
#include <utility>

#include "parallel/asked_memory.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren {
namespace {

using scene_text::Fields;

// A file's name is one word: blanks, commas, # and \ in it stand as \xHH.

std::string word_of_file(std::string_view file) {
  std::string word;
  for (const char c : file) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte > 0x20 && byte != 0x7f && c != ',' && c != '#' && c != '\\';
    word += is_plain ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
  }
  return word;
}

std::string file_of_word(std::string_view word) {
  std::string file;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned byte = 0;
    const std::string_view digits = word.substr(i).starts_with("\\x") ? word.substr(i + 2, 2) : "";
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    const bool is_byte = error == std::errc{} && digits.size() == 2 && end == digits.data() + 2;
    file += is_byte ? static_cast<char>(byte) : word[i];
    if (is_byte) i += 3;
  }
  return file;
}

/// Reads one line.
class PriceReader {
 public:
  PriceReader(const PriceWord& word, Fields& fields, Prices& prices, const Execution& execution)
      : word_(word), fields_(fields), prices_(prices), execution_(execution) {}

  void read() {
    if (word_.name == "clearance-price") {
      const std::vector<double> n = numbers(1, 2);
      check(n[0] >= 0.0 && n[0] <= largest_price, fmt::format("P must be from 0 to {}", largest_price), n[0]);
      if (n.size() == 2) check(n[1] > 0.0, "D must be greater than 0", n[1]);
      prices_.clearance = {n[0], n.size() == 2 ? std::optional(n[1]) : std::nullopt};
    } else if (word_.name == "area") {
      if (!fields_.number_follows()) refuse_usage(fields_.done() ? "nothing" : fields_.word());
      const double factor = factor_of(fields_.number());
      push_asked(prices_.areas, {factor, corners(), fields_.place().line}, execution_);
    } else if (word_.name == "keep-out") {
      push_asked(prices_.keep_out, {corners(), fields_.place().line}, execution_);
    } else if (word_.name == "unknown") {
      prices_.unknown = factor_of(numbers(1, 1)[0]);
    } else {
      read_mask();
    }
  }

 private:
  [[noreturn]] void refuse_usage(std::string_view found) const {
    fields_.place().fail(
        fmt::format("expected `{}`", is_option() ? word_.usage.substr(word_.name.size() + 1) : word_.usage), found);
  }
  bool is_option() const { return fields_.place().line == 0; }
  void check(bool holds, std::string_view what, double value) const {
    if (holds) return;
    fields_.place().fail(is_option() ? std::string(what) : fmt::format("`{}`: {}", word_.name, what),
                         fmt::format("{}", value));
  }
  double factor_of(double factor) const {
    check(factor >= 1.0 && factor <= largest_price, fmt::format("F must be from 1 to {}", largest_price), factor);
    return factor;
  }
  std::vector<double> numbers(std::size_t least, std::size_t most) {
    constexpr std::size_t numbers_per_look = 4096;
    std::vector<double> read;
    while (!fields_.done()) {
      push_asked(read, fields_.number(), execution_);
      if (read.size() % numbers_per_look == 0) execution_.check();
    }
    const std::size_t count = read.size();
    if (count < least || count > most) refuse_usage(fmt::format("{} number{}", count, count == 1 ? "" : "s"));
    return read;
  }
  std::vector<Vec2> corners() {
    const std::vector<double> n = numbers(6, std::numeric_limits<std::size_t>::max());
    if (n.size() % 2 != 0) refuse_usage(fmt::format("{} coordinates", n.size()));
    execution_.reserve(n.size() * sizeof(double));
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n.size(); i += 2) points.push_back({n[i], n[i + 1]});
    check_body(points, fields_.place().text(), execution_);
    return points;
  }
  void read_mask() {
    PriceMask mask;
    mask.file = file_of_word(fields_.word());
    const std::string_view kind = fields_.word();
    if (mask.file.empty() || kind.empty()) refuse_usage("too few words");
    if (kind == "areas") {
      mask.factor = factor_of(numbers(1, 1)[0]);
    } else if (kind == "keep-out") {
      mask.kind = MaskKind::keep_out;
      if (const std::vector<double> n = numbers(0, 1); !n.empty()) mask.factor = factor_of(n[0]);
    } else if (kind == "speed") {
      mask.kind = MaskKind::speed;
      const std::vector<double> n = numbers(0, 2);
      if (n.size() == 1) refuse_usage("1 number");
      if (n.size() == 2) std::tie(mask.base, mask.multiplier) = std::pair(n[0], n[1]);
      for (const double x : n) check(std::abs(x) <= largest_of_speed, "BASE and MULTIPLIER are at most 1e6", x);
    } else {
      refuse_usage(kind);
    }
    push_asked(prices_.masks, std::move(mask), execution_);
  }

  static constexpr double largest_of_speed = 1e6;

  const PriceWord& word_;
  Fields& fields_;
  Prices& prices_;
  const Execution& execution_;
};

std::string digits_of(double x) { return fmt::format("{}", x + 0.0); }  // no negative zeros

std::string corners_text(const std::vector<Vec2>& corners) {
  std::string text;
  for (const Vec2 p : corners) text += fmt::format(" {} {}", digits_of(p.x), digits_of(p.y));
  return text;
}

std::string mask_text(const PriceMask& mask, const std::string& file) {
  const std::string text = "mask " + word_of_file(file);
  const std::string factor = mask.factor ? ' ' + digits_of(*mask.factor) : "";
  if (mask.kind == MaskKind::areas) return text + " areas" + factor;
  if (mask.kind == MaskKind::keep_out) return text + " keep-out" + factor;
  return fmt::format("{} speed {} {}", text, digits_of(mask.base), digits_of(mask.multiplier));
}

}  // namespace

void read_price(const PriceWord& word, Fields& fields, Prices& prices, const Execution& execution) {
  PriceReader(word, fields, prices, execution).read();
}

void read_price_line(std::string_view line, const std::string& where, Prices& prices, const Execution& execution) {
  Fields fields(line, {where, 0});
  const std::string_view name = fields.word();
  const auto word = std::ranges::find(price_line_words, name, &PriceWord::name);
  if (word == price_line_words.end())
    scene_text::Place{where, 0}.fail("expected lines of a scene's prices, such as 'clearance-price 3 0.5'", line);
  read_price(*word, fields, prices, execution);
}

std::vector<std::string> price_lines(const Prices& prices,
                                     const std::function<std::string(const std::string&)>& name_of_file) {
  std::vector<std::string> lines;
  if (const auto& clearance = prices.clearance) {
    const std::string reach = clearance->reach ? ' ' + digits_of(*clearance->reach) : "";
    lines.push_back(fmt::format("clearance-price {}{}", digits_of(clearance->price), reach));
  }
  for (const PricedArea& area : prices.areas)
    lines.push_back(fmt::format("area {}{}", digits_of(area.factor), corners_text(area.corners)));
  for (const PriceMask& mask : prices.masks) lines.push_back(mask_text(mask, name_of_file(mask.file)));
  for (const KeepOut& area : prices.keep_out) lines.push_back("keep-out" + corners_text(area.corners));
  if (prices.unknown) lines.push_back("unknown " + digits_of(*prices.unknown));
  return lines;
}

std::vector<std::string> price_lines(const Prices& prices) {
  return price_lines(prices, [](const std::string& file) { return file; });
}

}  // namespace warren
