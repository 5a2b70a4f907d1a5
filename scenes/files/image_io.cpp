// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/image_io.hpp"

#include <fmt/format.h>

#include <numeric>
#include <optional>

#include "core/base/error.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

// Offsets are those of BITMAPFILEHEADER (14 bytes) and BITMAPINFOHEADER (40 and more); numbers are little-endian. A row
// is as many whole words of 32 bits as its pixels need, the lowest row first unless the height is negative.

constexpr std::size_t file_header_bytes = 14;

std::uint32_t number_at(std::string_view bytes, std::size_t at, unsigned size = 4) {
  std::uint32_t number = 0;
  while (size-- > 0) number = number << 8U | static_cast<unsigned char>(bytes[at + size]);
  return number;
}

struct Layout {
  ImageHeader header;
  unsigned bits = 0;  ///< of a pixel
  bool is_top_down = false;
  std::string_view palette;  ///< four bytes a colour: blue, green, red, nothing
  std::size_t row_bytes = 0;
  std::string_view rows;
};

/// What the bits of a pixel are; false: another kind of BMP.
bool read_kind(std::string_view bytes, Layout& layout) {
  const std::uint32_t coding = number_at(bytes, 30);
  layout.bits = number_at(bytes, 28, 2);
  bool has_alpha = layout.bits == 32;
  if (coding == 3 && layout.bits == 32 && bytes.size() >= 70) {  // its masks must be those of blue, green, red, alpha
    has_alpha = number_at(bytes, 14) >= 56 && number_at(bytes, 66) == 0xff000000;
    if (number_at(bytes, 54) != 0xff0000 || number_at(bytes, 58) != 0xff00 || number_at(bytes, 62) != 0xff)
      return false;
  } else if (coding != 0) {
    return false;
  }
  layout.header.channels = has_alpha ? 4 : 3;
  return layout.bits == 1 || layout.bits == 4 || layout.bits == 8 || layout.bits == 24 || layout.bits == 32;
}

/// Without masks the fourth byte of pixels means nothing, and is 0, but where a writer has put alpha there.
bool has_fourth_bytes(const Layout& layout, const Execution& execution) {
  for (std::size_t at = 3; at < layout.row_bytes * layout.header.height; at += 4) {
    execution.poll(at / 4);
    if (layout.rows[at] != 0) return true;
  }
  return false;
}

/// Before anybody makes room for many pixels: a row takes so many bytes, `or_more` or not.
void check_pixels_are_there(const InputFile& file, const ImageHeader& header, std::size_t row_bytes, std::size_t bytes,
                            std::string_view or_more = {}) {
  if (bytes / row_bytes >= header.height) return;
  throw InputError(file.name(),
                   fmt::format("expected {} x {} pixels, {} bytes{} after the header", header.width, header.height,
                               row_bytes * header.height, or_more),
                   fmt::format("{} bytes", bytes));
}

Layout layout_of(const InputFile& file, const Execution& execution) {
  const std::string_view bytes = file.bytes();
  Layout layout;
  if (bytes.size() < file_header_bytes + 40 || number_at(bytes, 14) < 40 || !read_kind(bytes, layout)) {
    throw InputError(file.name(), "expected a BMP of 1, 4, 8, 24 or 32 bits a pixel that is not compressed");
  }
  const auto width = static_cast<std::int32_t>(number_at(bytes, 18));
  const std::int64_t height = static_cast<std::int32_t>(number_at(bytes, 22));
  layout.is_top_down = height < 0;
  check_map_size(file.name(), static_cast<std::uint64_t>(std::max(width, 0)),
                 static_cast<std::uint64_t>(std::abs(height)));
  layout.header.width = static_cast<std::uint32_t>(width);
  layout.header.height = static_cast<std::uint32_t>(std::abs(height));
  layout.row_bytes = (std::size_t{layout.bits} * layout.header.width + 31) / 32 * 4;
  const std::size_t first = std::min<std::size_t>(number_at(bytes, 10), bytes.size());
  layout.rows = bytes.substr(first);
  check_pixels_are_there(file, layout.header, layout.row_bytes, layout.rows.size());
  const bool has_masks = number_at(bytes, 30) != 0;
  if (layout.bits == 32 && !has_masks && !has_fourth_bytes(layout, execution)) layout.header.channels = 3;
  if (layout.bits > 8) return layout;
  const std::size_t head = file_header_bytes + std::size_t{number_at(bytes, 14)};
  const std::size_t colours = number_at(bytes, 46) == 0 ? std::size_t{1} << layout.bits : number_at(bytes, 46);
  layout.palette = head < first ? bytes.substr(head, std::min(4 * colours, first - head)) : std::string_view();
  return layout;
}

/// Blue, green, red and, where there is alpha, alpha of a pixel.
std::string_view pixel_of(const Layout& layout, std::string_view row, std::size_t x, const InputFile& file) {
  if (layout.bits > 8) return row.substr(x * layout.bits / 8, layout.bits / 8);
  const std::size_t bit = x * layout.bits;
  const unsigned shift = 8U - layout.bits - static_cast<unsigned>(bit % 8);  // the leftmost pixel stands highest
  const std::size_t colour = (number_at(row, bit / 8, 1) >> shift) & ((1U << layout.bits) - 1U);
  if (4 * colour + 4 > layout.palette.size()) {
    throw InputError(file.name(), fmt::format("expected pixels of the palette's {} colours", layout.palette.size() / 4),
                     fmt::format("{}", colour));
  }
  return layout.palette.substr(4 * colour, 4);
}

/// Rows as they lie in the file, the lowest or the highest first: fill(i, samples) writes the samples of one.
template <class Fill>
void hand_rows_over(const ImageHeader& header, bool lowest_first, const ImageSink& sink, const Execution& execution,
                    const Fill& fill) {
  sink.begin(header);
  const std::size_t count = std::size_t{header.channels} * header.width;
  execution.reserve(sizeof(std::uint16_t) * count);
  RawVector<std::uint16_t> samples(count);
  for (std::uint32_t i = 0; i < header.height; ++i) {
    fill(i, samples.data());
    sink.row({lowest_first ? header.height - 1 - i : i, 0, 1, samples});
  }
}

/// BMP: uncompressed, of 1, 4 or 8 bits with a palette, 24, or 32 whose fourth byte is alpha, as Nav2's map saver
/// writes them and its server reads them.
void read_bmp(const InputFile& file, const ImageSink& sink, const Execution& execution) {
  const Layout layout = layout_of(file, execution);
  hand_rows_over(layout.header, !layout.is_top_down, sink, execution, [&](std::uint32_t i, std::uint16_t* to) {
    const std::string_view row = layout.rows.substr(i * layout.row_bytes, layout.row_bytes);
    for (std::size_t x = 0; x < layout.header.width; ++x, to += layout.header.channels) {
      execution.poll(x);
      const std::string_view pixel = pixel_of(layout, row, x, file);
      for (const unsigned c : {0U, 1U, 2U}) to[c] = static_cast<unsigned char>(pixel[2 - c]);
      if (layout.header.channels == 4) to[3] = static_cast<unsigned char>(pixel[3]);
    }
  });
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

/// Tokens between white space; `#` starts a comment to the end of the line. Runs of blanks look at the deadline.
class PgmTokens {
 public:
  /// Begins behind the two letters that say what it is.
  PgmTokens(const InputFile& file, const Execution& execution)
      : name_(file.name()), rest_(file.bytes().substr(2)), execution_(execution) {}

  std::uint32_t number(std::string_view what, std::uint32_t least, std::uint32_t most) {
    constexpr std::size_t longest = 64;  // no number is longer, and a message shows no more
    skip();
    std::size_t length = 0;
    while (length < std::min(rest_.size(), longest) && !is_space(rest_[length]) && rest_[length] != '#') ++length;
    const std::string_view word = rest_.substr(0, length);
    const auto value = scene_text::number_in_full<std::uint32_t>(word);
    if (!value || *value < least || *value > most) {
      scene_text::Place{name_, line_}.fail(fmt::format("expected {}, {} to {}", what, least, most),
                                           word.empty() ? "the end of the file" : word);
    }
    rest_.remove_prefix(word.size());
    return *value;
  }
  std::string_view rest() const { return rest_; }
  /// Exactly one byte stands between header and binary pixels.
  std::string_view pixels() const { return rest_.substr(std::min<std::size_t>(1, rest_.size())); }

 private:
  void skip() {
    for (std::size_t steps = 1; !rest_.empty(); ++steps) {
      execution_.poll(steps);
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

  const std::string& name_;
  std::string_view rest_;
  const Execution& execution_;
  std::size_t line_ = 1;
};

/// Gives back what was read, all but the last bytes of the file, so that a large image is never held as a whole.
void forget_all_but(std::string_view rest, const InputFile& file, std::size_t& forgotten) {
  constexpr std::size_t piece = std::size_t{1} << 22;
  const std::size_t read = file.bytes().size() - rest.size();
  if (read - forgotten < piece) return;
  file.forget(forgotten, read);
  forgotten = read;
}

void read_binary(const InputFile& file, const ImageHeader& header, std::string_view pixels, const ImageSink& sink,
                 const Execution& execution) {
  const bool wide = header.maximum > 255;  // then two bytes a sample, the high one first
  const std::size_t row_bytes = std::size_t{header.width} * (wide ? 2 : 1);
  check_pixels_are_there(file, header, row_bytes, pixels.size());
  std::size_t forgotten = 0;
  hand_rows_over(header, false, sink, execution, [&](std::uint32_t y, std::uint16_t* samples) {
    forget_all_but(pixels.substr(y * row_bytes), file, forgotten);
    const std::string_view row = pixels.substr(y * row_bytes, row_bytes);
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(row[at]); };
    unsigned highest = 0;
    for (std::size_t x = 0; x < header.width;) {
      execution.check();
      for (const std::size_t end = std::min<std::size_t>(x + 65536, header.width); x < end; ++x) {
        samples[x] = static_cast<std::uint16_t>(wide ? byte(2 * x) << 8 | byte(2 * x + 1) : byte(x));
        highest = std::max<unsigned>(highest, samples[x]);
      }
    }
    if (highest > header.maximum) {
      throw InputError(file.name(),
                       fmt::format("expected pixels of at most {}, the maxval, in row {}", header.maximum, y),
                       fmt::format("{}", highest));
    }
  });
}

void read_ascii(const InputFile& file, const ImageHeader& header, PgmTokens& tokens, const ImageSink& sink,
                const Execution& execution) {
  constexpr std::uint32_t pixels_a_look = 1 << 14;
  constexpr std::uint64_t few_pixels = 1 << 20;  // of these the message names the line where they end
  if (std::uint64_t{header.width} * header.height > few_pixels) {
    check_pixels_are_there(file, header, std::size_t{2} * header.width, tokens.rest().size(), " or more");
  }
  std::size_t forgotten = 0;
  hand_rows_over(header, false, sink, execution, [&](std::uint32_t, std::uint16_t* samples) {
    for (std::uint32_t x = 0; x < header.width; ++x) {
      if (x % pixels_a_look == 0) {
        execution.check();
        forget_all_but(tokens.rest(), file, forgotten);
      }
      samples[x] = static_cast<std::uint16_t>(tokens.number("a pixel", 0, header.maximum));
    }
  });
}

/// PGM: P5 (binary) and P2 (ASCII), maxval up to 65535, comments anywhere in the header. What follows the pixels is
/// ignored.
void read_pgm(const InputFile& file, const ImageSink& sink, const Execution& execution) {
  constexpr std::uint32_t most_side = 0x7fffffff;
  PgmTokens tokens(file, execution);
  ImageHeader header;
  header.width = tokens.number("the width of a PGM image", 1, most_side);
  header.height = tokens.number("the height of a PGM image", 1, most_side);
  header.maximum = tokens.number("the maxval of a PGM image", 1, 65535);
  check_map_size(file.name(), header.width, header.height);
  if (file.bytes()[1] == '5') return read_binary(file, header, tokens.pixels(), sink, execution);
  read_ascii(file, header, tokens, sink, execution);
}

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG"); }

bool is_bmp(std::string_view bytes) {
  return bytes.size() > 17 && bytes.starts_with("BM") && bytes.substr(15, 3) == std::string_view("\0\0\0", 3);
}

bool is_pgm(std::string_view bytes) {
  return bytes.size() > 2 && (bytes.starts_with("P5") || bytes.starts_with("P2")) &&
         std::string_view(" \t\r\n#").find(bytes[2]) != std::string_view::npos;
}

}  // namespace

bool is_image(std::string_view bytes) { return is_png(bytes) || is_pgm(bytes) || is_bmp(bytes); }

void read_image(const InputFile& file, const ImageSink& sink, const Execution& execution) {
  if (is_png(file.bytes())) return read_png(file, sink, execution);
  if (is_pgm(file.bytes())) return read_pgm(file, sink, execution);
  if (is_bmp(file.bytes())) return read_bmp(file, sink, execution);
  throw InputError(file.name(), "expected a PNG, PGM (magic P5 or P2) or BMP image");
}

void write_map_pgm(const OccupancyMap& map, const std::string& path, UnknownCells unknown, const Execution& execution) {
  constexpr char free = static_cast<char>(254);
  const char grey = unknown == UnknownCells::grey ? static_cast<char>(205) : '\0';
  OutputFile file(path, execution);
  file.write(fmt::format("P5\n# CREATOR: warren {:.3f} m/pix\n{} {}\n255\n", map.cell, map.width(), map.height()));
  execution.reserve(map.width());
  std::string row(map.width(), free);
  for (std::uint32_t y = map.height(); y-- > 0;) {
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      execution.poll(x);
      row[x] = map.unknown.holds(x, y) ? grey : map.blocked.test(x, y) ? '\0' : free;
    }
    file.write(row);
  }
  file.commit();
}

namespace {

/// Below 128 of 255: 255 v < 128 maximum.
bool is_dark(std::uint64_t sum, std::uint64_t maximum) { return 255 * sum < 128 * maximum; }

bool is_dark(const ImageHeader& header, const std::uint16_t* pixel) {
  const unsigned colours = header.channels - (header.has_alpha() ? 1 : 0);
  const std::uint64_t sum = std::accumulate(pixel, pixel + colours, std::uint64_t{0});
  const std::uint64_t brightest = std::uint64_t{colours} * header.maximum;
  if (!header.has_alpha()) return is_dark(sum, brightest);
  const std::uint64_t alpha = pixel[colours];
  return is_dark(alpha * sum + (header.maximum - alpha) * brightest, header.maximum * brightest);
}

void set_dark_greys(std::uint64_t maximum, std::span<const std::uint16_t> samples, std::span<std::uint64_t> words,
                    const Execution& execution) {
  for (std::size_t w = 0; w < words.size(); ++w) {
    execution.poll(w);
    const auto part = samples.subspan(w * 64, std::min<std::size_t>(64, samples.size() - w * 64));
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < part.size(); ++i) word |= std::uint64_t{is_dark(part[i], maximum)} << i;
    words[w] = word;
  }
}

/// Sets the bits of dark pixels.
void set_dark(const ImageHeader& header, const PixelRun& run, Bitmap& dark, const Execution& execution) {
  const std::uint32_t y = header.height - 1 - run.y;
  if (header.channels == 1 && run.step_x == 1)
    return set_dark_greys(header.maximum, run.samples, dark.row(y), execution);
  std::uint32_t x = run.first_x;
  for (const std::uint16_t* pixel = run.samples.data(); pixel != run.samples.data() + run.samples.size();
       pixel += header.channels, x += run.step_x) {
    execution.poll(static_cast<std::size_t>(pixel - run.samples.data()));
    if (is_dark(header, pixel)) dark.set(x, y);
  }
}

/// The middle of the only free cell of a row.
std::optional<Vec2> opening(const OccupancyMap& map, std::uint32_t y, const Execution& execution) {
  std::optional<Vec2> found;
  for (std::uint32_t x = 0; x < map.width(); ++x) {
    execution.poll(x);
    if (map.blocked.test(x, y)) continue;
    if (found) return std::nullopt;
    found = cell_centre(map, {x, y});
  }
  return found;
}

}  // namespace

OccupancyMap read_maze_image(const InputFile& file, const Execution& execution) {
  OccupancyMap map;
  map.source = file.name();
  ImageHeader header;
  const auto begin = [&](const ImageHeader& read) {
    header = read;
    map.blocked = cell_bitmap(header.width, header.height, execution);
  };
  read_image(file, {begin, [&](const PixelRun& run) { set_dark(header, run, map.blocked, execution); }}, execution);
  map.occupied = map.blocked.count();
  map.free = map.blocked.size() - map.occupied;
  map.start = opening(map, map.height() - 1, execution);
  if (map.height() > 1) map.goal = opening(map, 0, execution);
  return map;
}

}  // namespace warren
