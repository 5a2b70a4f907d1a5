// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/stopped_line.hpp"

#include <fmt/format.h>

#include "tools/screen/last_words.hpp"

namespace warren::distributed {

void say_where_stopped(const Transport& transport, const Progress& progress, StopReason reason) {
  const char* stage = progress.stage();
  tools::say_on_standard_error(fmt::format("warren-mpi: rank {} of {}: stopped while it was at '{}': {}\n",
                                           transport.rank(), transport.ranks(), stage != nullptr ? stage : "the start",
                                           text_of(reason)));
}

}  // namespace warren::distributed
