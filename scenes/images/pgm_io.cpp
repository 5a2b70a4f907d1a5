// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/images/pgm_io.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

/// Tokens between white space; `#` starts a comment to the end of the line. Runs of blanks look at the deadline.
class PgmTokens {
 public:
  PgmTokens(const InputFile& file, const Execution& execution)
      : name_(file.name()), rest_(file.bytes()), execution_(execution) {}

  std::uint32_t number(std::string_view what, std::uint32_t least, std::uint32_t most) {
    skip();
    const std::string_view word = rest_.substr(0, word_length());
    std::uint32_t value = 0;
    const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || last != word.data() + word.size() || value < least || value > most) {
      scene_text::Place{name_, line_}.fail(fmt::format("expected {}, {} to {}", what, least, most),
                                           word.empty() ? "the end of the file" : word);
    }
    rest_.remove_prefix(word.size());
    return value;
  }
  std::string_view rest() const { return rest_; }
  void magic() { rest_.remove_prefix(2); }
  /// Exactly one byte stands between header and binary pixels.
  std::string_view pixels() const { return rest_.substr(std::min<std::size_t>(1, rest_.size())); }

 private:
  void skip() {
    constexpr std::size_t batch = 1 << 16;
    for (std::size_t steps = 1; !rest_.empty(); ++steps) {
      if (steps % batch == 0) execution_.check();
      if (rest_.front() == '#') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      } else if (is_space(rest_.front())) {
        line_ += rest_.front() == '\n' ? 1 : 0;
        rest_.remove_prefix(1);
      } else {
        return;
      }
    }
  }
  /// No number is longer than that, and a message shows no more.
  std::size_t word_length() const {
    constexpr std::size_t longest = 64;
    std::size_t n = 0;
    while (n < std::min(rest_.size(), longest) && !is_space(rest_[n]) && rest_[n] != '#') ++n;
    return n;
  }

  const std::string& name_;
  std::string_view rest_;
  const Execution& execution_;
  std::size_t line_ = 1;
};

/// Gives back what was read, so that a large image is never held as a whole.
class Forgetting {
 public:
  explicit Forgetting(const InputFile& file) : file_(file) {}
  /// All before these last bytes of the file was read.
  void but(std::string_view rest) {
    constexpr std::size_t piece = std::size_t{1} << 22;
    const std::size_t read = file_.bytes().size() - rest.size();
    if (read - forgotten_ < piece) return;
    file_.forget(forgotten_, read);
    forgotten_ = read;
  }

 private:
  const InputFile& file_;
  std::size_t forgotten_ = 0;
};

/// One sample of a binary row; two bytes, the high one first, where maxval is beyond 255.
std::uint16_t sample(std::string_view bytes, std::size_t i, bool wide) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  return static_cast<std::uint16_t>(wide ? byte(2 * i) << 8 | byte(2 * i + 1) : byte(i));
}

/// Before anybody makes room for many pixels: `bytes_a_pixel` is the least that one takes.
void check_pixels_are_there(const InputFile& file, const ImageHeader& header, std::size_t bytes_a_pixel,
                            std::size_t bytes) {
  const std::size_t row_bytes = bytes_a_pixel * header.width;
  if (bytes / row_bytes >= header.height) return;
  throw InputError(file.name(),
                   fmt::format("expected {} x {} pixels, {} bytes{} after the header", header.width, header.height,
                               row_bytes * header.height, file.bytes()[1] == '5' ? "" : " or more"),
                   fmt::format("{} bytes", bytes));
}

void read_binary(const InputFile& file, const ImageHeader& header, std::string_view pixels, const ImageSink& sink,
                 const Execution& execution) {
  const bool wide = header.maximum > 255;
  const std::size_t row_bytes = std::size_t{header.width} * (wide ? 2 : 1);
  check_pixels_are_there(file, header, wide ? 2 : 1, pixels.size());
  sink.begin(header);
  execution.reserve(sizeof(std::uint16_t) * header.width);
  std::vector<std::uint16_t> samples(header.width);
  Forgetting forgetting(file);
  for (std::uint32_t y = 0; y < header.height; ++y) {
    execution.check();
    forgetting.but(pixels.substr(y * row_bytes));
    const std::string_view row = pixels.substr(y * row_bytes, row_bytes);
    unsigned highest = 0;
    for (std::uint32_t x = 0; x < header.width; ++x) {
      samples[x] = sample(row, x, wide);
      highest = std::max<unsigned>(highest, samples[x]);
    }
    if (highest > header.maximum) {
      throw InputError(file.name(),
                       fmt::format("expected pixels of at most {}, the maxval, in row {}", header.maximum, y),
                       fmt::format("{}", highest));
    }
    sink.row({y, 0, 1, samples});
  }
}

void read_ascii(const InputFile& file, const ImageHeader& header, PgmTokens& tokens, const ImageSink& sink,
                const Execution& execution) {
  constexpr std::uint32_t pixels_a_look = 1 << 14;
  constexpr std::uint64_t few_pixels = 1 << 20;  // of these the message names the line where they end
  if (std::uint64_t{header.width} * header.height > few_pixels) {
    check_pixels_are_there(file, header, 2, tokens.rest().size());
  }
  sink.begin(header);
  execution.reserve(sizeof(std::uint16_t) * header.width);
  std::vector<std::uint16_t> samples(header.width);
  Forgetting forgetting(file);
  for (std::uint32_t y = 0; y < header.height; ++y) {
    for (std::uint32_t x = 0; x < header.width; ++x) {
      if (x % pixels_a_look == 0) {
        execution.check();
        forgetting.but(tokens.rest());
      }
      samples[x] = static_cast<std::uint16_t>(tokens.number("a pixel", 0, header.maximum));
    }
    sink.row({y, 0, 1, samples});
  }
}

}  // namespace

void read_pgm(const InputFile& file, const ImageSink& sink, const Execution& execution) {
  constexpr std::uint32_t most_side = 0x7fffffff;
  PgmTokens tokens(file, execution);
  tokens.magic();
  ImageHeader header;
  header.width = tokens.number("the width of a PGM image", 1, most_side);
  header.height = tokens.number("the height of a PGM image", 1, most_side);
  header.maximum = tokens.number("the maxval of a PGM image", 1, 65535);
  check_map_size(file.name(), header.width, header.height);
  if (file.bytes()[1] == '5') return read_binary(file, header, tokens.pixels(), sink, execution);
  read_ascii(file, header, tokens, sink, execution);
}

void write_map_pgm(const OccupancyMap& map, const std::string& path, UnknownCells unknown, const Execution& execution) {
  constexpr char free = static_cast<char>(254);
  const char grey = unknown == UnknownCells::grey ? static_cast<char>(205) : '\0';
  OutputFile file(path, execution);
  file.write(fmt::format("P5\n# CREATOR: warren {:.3f} m/pix\n{} {}\n255\n", map.cell, map.width(), map.height()));
  std::string row(map.width(), free);
  for (std::uint32_t y = map.height(); y-- > 0;) {
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      row[x] = map.unknown.holds(x, y) ? grey : map.blocked.test(x, y) ? '\0' : free;
    }
    file.write(row);
  }
  file.commit();
}

}  // namespace warren
