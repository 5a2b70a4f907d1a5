// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template const Planned<Vec2, false>& planned<Vec2, false>();

}  // namespace warren
