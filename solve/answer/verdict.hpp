// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "solve/question/question.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

/// What a judge says of a path, and about which question: the members of Verification (verified, length, min_clearance
/// around the body, first_violation, …) and the problem that was judged.
struct Verdict : Verification {
  Problem problem;  ///< that was judged
};

}  // namespace warren
