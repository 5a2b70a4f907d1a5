// SPDX-License-Identifier: BSD-3-Clause
// What a summary's figures leave open unless somebody says it: samples that were dropped, edges that nobody asked
// about, what an estimate cost, that another option would find the shortest way.
#pragma once

#include <string>

#include "scenes/text/palette.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// Lines of a name and a text, each with its end; empty where there is nothing to note.
std::string notes_text(const Answer& answer, const Palette& palette);

}  // namespace warren
