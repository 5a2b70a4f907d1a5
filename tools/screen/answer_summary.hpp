// SPDX-License-Identifier: BSD-3-Clause
// What `solve` tells a person: the answer first, then what it took, then where things were written.
#pragma once

#include <span>
#include <string>

#include "solve/answer/answer.hpp"
#include "tools/screen/terminal.hpp"

namespace warren {

std::string summary_of(const Answer& answer, const Palette& palette, std::span<const std::string> files_written);

}  // namespace warren
