// SPDX-License-Identifier: BSD-3-Clause
// `warren-mpi solve`: the words of `warren solve`, for mazes of mst that are made tile by tile, by all ranks together.
#pragma once

#include "distributed/transport.hpp"
#include "tools/words/command.hpp"

namespace warren::distributed {

/// The command of this rank: rank 0 answers, the others follow it. Refers to the transport.
tools::Command shared_solve_command(Transport& transport);

}  // namespace warren::distributed
