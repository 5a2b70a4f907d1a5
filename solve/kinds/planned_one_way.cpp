// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template const Planned<Se2, true>& planned<Se2, true>();

}  // namespace warren
