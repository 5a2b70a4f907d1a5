// SPDX-License-Identifier: BSD-3-Clause
// `warren-mpi scale`: the same maze by more and more ranks (strong), and mazes that grow with them (weak): what the
// clock, the processors, the wire and each rank's memory take.
#pragma once

#include "apps/distributed/transport.hpp"
#include "tools/words/command.hpp"

namespace warren::distributed {

/// The command of this rank: rank 0 leads and prints, the others follow. Refers to the transport.
tools::Command shared_scale_command(Transport& transport);

}  // namespace warren::distributed
