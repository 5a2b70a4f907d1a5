// SPDX-License-Identifier: BSD-3-Clause
// What `warren-mpi` does on each rank. `solve`: the words of `warren solve`, for mazes of mst that are made tile by
// tile, by all ranks together. `scale` (shared_scale_io.cpp): what the clock, the processors, the wire and each rank's
// memory take of it.
#pragma once

#include <functional>
#include <string>

#include "apps/distributed/leader_follower.hpp"
#include "apps/distributed/rank_protocol.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "tools/words/command.hpp"

namespace warren::distributed {

/// The commands of this rank: rank 0 answers or measures, the others follow it. They refer to the transport.
tools::Command shared_solve_command(Transport& transport);
tools::Command shared_scale_command(Transport& transport);

/// Calls work(limits), which are as --threads and --memory say; telling_where_stopped(). The exit code.
int follow_as(const tools::Arguments& arguments, Transport& transport,
              const std::function<void(const FollowerLimits&)>& work);

/// The world that ranks share: a maze whose tiles any of them can make, or a file of which each reads its part. Files
/// of different hosts may have one name and other walls, so the ranks compare what they see before they begin.
struct SharedWorld {
  Scene scene;        ///< without its walls (is_unmade)
  std::string facts;  ///< what all ranks must see of it; of a .maze all its checksums, of a .npy its size and outline
};

/// Reads what a file says of itself: a .maze's header and checksums, a .npy's header and the four walls of the outline,
/// no other walls. Throws UsageError for what ranks do not share, InputError, ReadError, Stopped.
SharedWorld shared_world(const std::string& source, const Execution& execution);

}  // namespace warren::distributed
