// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/planned_worlds.hpp"

namespace warren {

template const Planned<Se2, false>& planned<Se2, false>();

}  // namespace warren
