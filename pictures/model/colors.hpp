// SPDX-License-Identifier: BSD-3-Clause
// Colours by role and widths, the same in all formats. The roles keep apart for eyes that lack a kind of cone, too
// (colors_test simulates them); beside that, start and goal differ by shape, walls and paths by width.
#pragma once

#include <array>
#include <cstdint>

namespace warren {

struct Rgb {
  std::uint8_t red, green, blue;
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

/// So many hundredths of one colour, 0 .. 100, the rest of the other.
constexpr Rgb mixed(Rgb one, Rgb other, unsigned percent) {
  const auto part = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((percent * a + (100U - percent) * b + 50U) / 100U);
  };
  return {part(one.red, other.red), part(one.green, other.green), part(one.blue, other.blue)};
}

namespace colors {
inline constexpr Rgb paper{255, 255, 255};
inline constexpr Rgb text{34, 34, 34};
inline constexpr Rgb frame{136, 136, 136};
inline constexpr Rgb wall{30, 41, 59};
inline constexpr Rgb polygon{217, 221, 227};
inline constexpr Rgb blocked_cell{190, 197, 207};
inline constexpr Rgb occupied_cell{110, 121, 138};  ///< of maps that know of unknown ones, which are as blocked_cell
inline constexpr Rgb no_room{250, 224, 193};        ///< for the reference point, at one heading
inline constexpr Rgb outline{102, 113, 127};        ///< of polygons
inline constexpr Rgb search_tree{240, 180, 41};
inline constexpr Rgb path{200, 16, 46};
inline constexpr Rgb start{0, 114, 178};
inline constexpr Rgb goal{106, 13, 173};
inline constexpr Rgb layer{156, 195, 234};  ///< a planner's lines
inline constexpr Rgb body{48, 176, 144};
inline constexpr Rgb wrong{213, 94, 0};  ///< what should not be there
/// A roadmap component takes the colour of its rank. The last is for all that have no colour of their own.
inline constexpr std::array<Rgb, 9> components{{layer,
                                                {244, 178, 148},
                                                {150, 211, 168},
                                                {205, 176, 235},
                                                {240, 208, 126},
                                                {142, 208, 214},
                                                {240, 170, 200},
                                                {190, 200, 140},
                                                {200, 206, 214}}};
/// Several of one kind beside each other, by Okabe and Ito, and the ink: told apart by most eyes, and on paper.
inline constexpr std::array<Rgb, 9> series{{{0, 114, 178},
                                            {213, 94, 0},
                                            {0, 158, 115},
                                            {204, 121, 167},
                                            {181, 137, 0},
                                            {86, 180, 233},
                                            {85, 85, 85},
                                            {122, 81, 149},
                                            {0, 0, 0}}};
}  // namespace colors

/// Pixels of the page (1/96 inch) where a unit of the world (Canvas::unit) has some twenty; less where it has fewer.
namespace widths {
inline constexpr double wall = 2.0;
inline constexpr double outline = 1.0;
inline constexpr double milestone = 3.4;
inline constexpr double edge = 1.0;
inline constexpr double search_tree = 1.4;
inline constexpr double path = 3.4;
inline constexpr double mark = 7.0;  ///< radius
}  // namespace widths

}  // namespace warren
