// SPDX-License-Identifier: BSD-3-Clause
// What an explained answer tells beyond its summary, in lines for people, and as JSON.
#pragma once

#include <optional>
#include <string>

#include "scenes/text/human_units.hpp"
#include "solve/answer/answer.hpp"

namespace warren {

/// Lines of a name and a text, each with its end; empty unless the answer is explained.
std::string explanation_text(const Answer& answer, const Palette& palette);
/// "0.5 of room on leg 1, near 3,4"
std::string text_of(const NarrowPlace& narrow);
/// As JSON; null where there is none.
std::string narrowest_json(const std::optional<NarrowPlace>& narrow);
/// The value of the key "explained".
std::string explanation_json(const Answer& answer);

// What a summary's figures leave open unless somebody says it: samples that were dropped, edges that nobody asked
// about, what an estimate cost, that another option would find the shortest way.

/// Lines of a name and a text, each with its end; empty where there is nothing to note.
std::string notes_text(const Answer& answer, const Palette& palette);

}  // namespace warren
