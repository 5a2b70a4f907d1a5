// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template const Planned<JointState, false>& planned<JointState, false>();

}  // namespace warren
