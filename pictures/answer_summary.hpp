// SPDX-License-Identifier: BSD-3-Clause
// An answer as a few lines for a person: the answer first, then what it took, then where things were written.
#pragma once

#include <span>
#include <string>

#include "scenes/text/human_units.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// Each line with its newline; Palette(false) for text without colours.
std::string summary_of(const Answer& answer, const Palette& palette, std::span<const std::string> files_written);

/// In per cent, rounded up as bounds must be: "0.001 %", "0.42 %", "3.4 %", "120 %". share >= 0.
std::string share_text(double share);

}  // namespace warren
