// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/letters.hpp"

#include <utility>

#include "core/base/printable.hpp"

namespace warren {
// The outlines of ASCII's and Latin-1's letters, so that pictures in pixels don't depend on a machine's fonts, stand in
// the file pictures/letters/outlines: a line a glyph of U+0020 to U+007E and U+00A0 to U+00FF. A glyph is its advance
// and its contours, a contour the count of its points and these: TrueType's quadratic curves, 1024 units to the
// letters' size. Points are steps from the one before, y up, y doubled + 1 where the point is on the curve; instead of
// a count 0 stands before a contour of an earlier glyph: the glyph, which of its contours, and the step from it. A
// number is a digit of base 91 (# to ~ without the backslash) below 40, else two; steps are doubled, those back are
// -2 n - 1. They are derived from DejaVu Sans 2.37 with another name, as its licence asks, which stands beside them.

namespace {

constexpr double units = 1024.0;

/// Reads the numbers of a glyph.
struct GlyphReader {
  std::string_view digits;
  int number() {
    constexpr int small = 40;
    const int first = digit();
    return first < small ? first : small + 91 * (first - small) + digit();
  }
  static int step(int number) { return number % 2 == 0 ? number / 2 : -(number / 2) - 1; }
  int digit() {
    const char c = digits.front();
    digits.remove_prefix(1);
    return c - (c > '\\' ? '$' : '#');
  }
};

GlyphReader glyph(std::size_t number) {
  static const std::vector<std::string_view> glyphs = split(letter_files().back().bytes, "\n");
  return {glyphs[number]};
}

std::size_t glyph_of(char latin1) {
  const auto code = static_cast<unsigned char>(latin1);
  return code < 0x80U ? code - 0x20U : code - 0xa0U + 95U;
}

struct CurvePoint {
  Vec2 at;
  bool on = false;
};
using CurveContour = std::vector<CurvePoint>;

/// In units, y up.
std::vector<CurveContour> contours_of(std::size_t number) {
  std::vector<CurveContour> contours;
  GlyphReader reader = glyph(number);
  reader.number();  // its advance
  const auto step = [&] { return static_cast<double>(GlyphReader::step(reader.number())); };
  while (!reader.digits.empty()) {
    CurveContour contour(static_cast<std::size_t>(reader.number()));
    Vec2 at;
    for (CurvePoint& p : contour) {
      at.x += step();
      const int y = reader.number();
      at.y += GlyphReader::step(y / 2);
      p = {at, y % 2 == 1};
    }
    if (contour.empty()) {
      const std::vector<CurveContour> earlier = contours_of(static_cast<std::size_t>(reader.number()));
      contour = earlier[static_cast<std::size_t>(reader.number())];
      at.x = step();
      at.y = step();
      for (CurvePoint& p : contour) p.at = p.at + at;
    }
    contours.push_back(std::move(contour));
  }
  return contours;
}

/// The contour in chords: between two points off the curve lies one on it, half-way.
std::vector<Vec2> contour_of(const CurveContour& points) {
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
  for (const char c : latin1_text(text)) width += glyph(glyph_of(c)).number();
  return width * size / units;
}

PolygonSet text_outlines(std::string_view text, double size) {
  PolygonSet outlines;
  double pen = 0.0;
  const double scale = size / units;
  for (const char c : latin1_text(text)) {
    for (CurveContour& contour : contours_of(glyph_of(c))) {
      for (CurvePoint& p : contour) p.at = {pen + scale * p.at.x, -scale * p.at.y};
      outlines.add(contour_of(contour));
    }
    pen += scale * glyph(glyph_of(c)).number();
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
