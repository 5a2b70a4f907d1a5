// SPDX-License-Identifier: BSD-3-Clause
// What `warren-mpi` does on each rank. `solve`: the words of `warren solve`, for mazes of mst that are made tile by
// tile, by all ranks together. `scale` (shared_scale_io.cpp): what the clock, the processors, the wire and each rank's
// memory take of it.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "apps/distributed/leader_follower.hpp"
#include "tools/words/command.hpp"

namespace warren::distributed {

/// The commands of this rank: rank 0 answers or measures, the others follow it. They refer to the transport.
tools::Command shared_solve_command(Transport& transport);
tools::Command shared_scale_command(Transport& transport);

/// Calls work(limits), which are as --threads and --memory say; telling_where_stopped(). The exit code.
int follow_as(const tools::Arguments& arguments, Transport& transport,
              const std::function<void(const FollowerLimits&)>& work);

/// The world that ranks share, without its walls (is_unmade): a maze whose tiles any of them can make, or a file of
/// which each reads its part. Files of different hosts may have one name and other walls, so the ranks compare before
/// they begin what they see, which the text tells: of a .maze all its checksums, of a .npy its size and the four walls
/// of the outline. No other walls are read. Throws UsageError for what ranks do not share, InputError, ReadError,
/// Stopped.
std::pair<Scene, std::string> shared_world(const std::string& source, const Execution& execution);

}  // namespace warren::distributed
