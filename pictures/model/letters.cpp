// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/letters.hpp"

#include <array>

#include "core/base/printable.hpp"
#include "pictures/model/letter_outlines.hpp"

namespace warren {
namespace {

constexpr double units = 1024.0;

/// Reads the numbers of a glyph.
class GlyphReader {
 public:
  explicit GlyphReader(std::string_view digits) : digits_(digits) {}
  bool ended() const { return at_ >= digits_.size(); }
  int number() {
    const int high = digit(digits_[at_]);
    const int low = digit(digits_[at_ + 1]);
    at_ += 2;
    return high * 64 + low;
  }

 private:
  static int digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : 63;
  }
  std::string_view digits_;
  std::size_t at_ = 0;
};

constexpr std::size_t glyph_count = 95 + 96;

std::array<std::string_view, glyph_count> all_glyphs() {
  std::array<std::string_view, glyph_count> glyphs;
  std::string_view rest = letter_outlines;
  for (std::string_view& glyph : glyphs) {
    glyph = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), glyph.size() + 1));
  }
  return glyphs;
}

std::string_view glyph_of(char latin1) {
  static const std::array<std::string_view, glyph_count> glyphs = all_glyphs();
  const auto code = static_cast<unsigned char>(latin1);
  return glyphs[code < 0x80U ? code - 0x20U : code - 0xa0U + 95U];
}

struct CurvePoint {
  Vec2 at;
  bool on = false;
};

/// The contour in chords: between two points off the curve lies one on it, half-way.
std::vector<Vec2> contour_of(const std::vector<CurvePoint>& points) {
  constexpr int chords = 4;
  std::vector<Vec2> contour;
  const std::size_t n = points.size();
  const auto middle = [](Vec2 a, Vec2 b) { return 0.5 * (a + b); };
  for (std::size_t i = 0; i < n; ++i) {
    const CurvePoint& here = points[i];
    if (here.on) {
      contour.push_back(here.at);
      continue;
    }
    const CurvePoint& before = points[(i + n - 1) % n];
    const CurvePoint& after = points[(i + 1) % n];
    const Vec2 a = before.on ? before.at : middle(before.at, here.at);
    const Vec2 b = after.on ? after.at : middle(here.at, after.at);
    for (int k = before.on ? 1 : 0; k < chords; ++k) {
      const double t = static_cast<double>(k) / chords;
      contour.push_back((1 - t) * (1 - t) * a + 2 * t * (1 - t) * here.at + t * t * b);
    }
  }
  return contour;
}

/// Cut at the blanks that stand behind one of these letters; none: at all blanks.
std::vector<std::string> parts_between(const std::string& text, std::string_view behind) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    std::string& last = parts.back();
    if (c == ' ' && (behind.empty() || (!last.empty() && behind.find(last.back()) != std::string_view::npos))) {
      parts.emplace_back();
    } else {
      last += c;
    }
  }
  return parts;
}

}  // namespace

std::string latin1_text(std::string_view text) {
  std::string latin1;
  while (!text.empty()) {
    const std::size_t bytes = utf8_bytes(text);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
    unsigned code = '?';
    if (bytes == 1) code = byte(0);
    if (bytes == 2) code = (byte(0) & 0x1fU) << 6 | (byte(1) & 0x3fU);
    const bool known = (code >= 0x20U && code < 0x7fU) || (code >= 0xa0U && code <= 0xffU);
    latin1 += known ? static_cast<char>(code) : '?';
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return latin1;
}

double text_width(std::string_view text, double size) {
  int width = 0;
  for (const char c : latin1_text(text)) width += GlyphReader(glyph_of(c)).number();
  return width * size / units;
}

PolygonSet text_outlines(std::string_view text, double size) {
  PolygonSet outlines;
  double pen = 0.0;
  const double scale = size / units;
  std::vector<CurvePoint> points;
  for (const char c : latin1_text(text)) {
    GlyphReader glyph(glyph_of(c));
    const int advance = glyph.number();
    while (!glyph.ended()) {
      points.clear();
      for (int count = glyph.number(); count > 0; --count) {
        const int x = glyph.number() - 1024;
        const int y = glyph.number();
        points.push_back({{pen + scale * x, -scale * (y / 2 - 512)}, y % 2 == 1});
      }
      outlines.add(contour_of(points));
    }
    pen += scale * advance;
  }
  return outlines;
}

std::string fitting_text(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  std::string short_text = text;
  while (!short_text.empty() && text_width(short_text + "...", size) > width) {
    do short_text.pop_back();
    while (!short_text.empty() && utf8_bytes(std::string_view(text).substr(short_text.size())) == 0);
  }
  return short_text + "...";
}

std::string fitting_ends(const std::string& text, double size, double width) {
  const auto inside = [&](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) >> 6) == 2;
  };
  for (std::size_t kept = text.size(); kept > 0; --kept) {
    std::size_t begin = (kept + 1) / 2;
    std::size_t end = text.size() - kept / 2;
    while (inside(begin)) --begin;  // no letter is cut
    while (inside(end)) ++end;
    std::string ends = kept == text.size() ? text : text.substr(0, begin) + "..." + text.substr(end);
    if (text_width(ends, size) <= width) return ends;
  }
  return "...";
}

std::vector<std::string> wrapped_text(const std::string& text, double size, double width) {
  if (text.empty()) return {};
  std::vector<std::string> lines(1);
  const auto add = [&](const std::string& part) {
    std::string& line = lines.back();
    const std::string longer = line.empty() ? part : line + ' ' + part;
    if (line.empty() || text_width(longer, size) <= width) {
      line = longer;
    } else {
      lines.push_back(part);
    }
  };
  for (const std::string& part : parts_between(text, ",;")) {
    const auto words = text_width(part, size) <= width ? std::vector{part} : parts_between(part, "");
    for (const std::string& word : words) add(word);
  }
  for (std::string& some : lines) some = fitting_text(some, size, width);
  return lines;
}

}  // namespace warren
