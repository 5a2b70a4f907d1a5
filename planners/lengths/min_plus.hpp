// SPDX-License-Identifier: BSD-3-Clause
// Sums of lengths and their least, many at once: what fronts are made of. Integers only, so every instruction set gives
// the same numbers; which one is used is asked of the processor once.
#pragma once

#include <cstddef>
#include <cstdint>

namespace warren {

/// No way. Two lengths, and a length and no_way, can be added.
inline constexpr std::uint32_t no_way = std::uint32_t{1} << 30;

/// No way among short lengths.
inline constexpr std::uint16_t no_short_way = 0xffff;

/// least[i] becomes the smaller of itself and first + rest[i], for i < count. The arrays don't overlap.
using LessenRow = void (*)(std::uint32_t* least, const std::uint32_t* rest, std::uint32_t first, std::size_t count);

/// The fastest of this processor.
LessenRow lessen_row();
/// The same of short lengths; no_short_way lessens nothing that is at most no_way.
using LessenRowShort = void (*)(std::uint32_t* least, const std::uint16_t* rest, std::uint32_t first,
                                std::size_t count);
LessenRowShort lessen_row_short();

/// lessen_row() where it is told by what: by[i] becomes `gate` where least[i] became smaller. `by` overlaps neither.
using LessenRowBy = void (*)(std::uint32_t* least, std::uint32_t* by, const std::uint32_t* rest, std::uint32_t first,
                             std::uint32_t gate, std::size_t count);
LessenRowBy lessen_row_by();

/// What needs nothing special.
void lessen_row_short_plain(std::uint32_t* least, const std::uint16_t* rest, std::uint32_t first, std::size_t count);
void lessen_row_plain(std::uint32_t* least, const std::uint32_t* rest, std::uint32_t first, std::size_t count);
void lessen_row_by_plain(std::uint32_t* least, std::uint32_t* by, const std::uint32_t* rest, std::uint32_t first,
                         std::uint32_t gate, std::size_t count);

}  // namespace warren
