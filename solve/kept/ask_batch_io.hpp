// SPDX-License-Identifier: BSD-3-Clause
// Many questions to one roadmap: read from CSV or JSON lines, dealt to all threads, answered in the order of the
// questions, one line each (docs/file_formats.md). A line that can't be read, or that asks what can't be asked, is
// answered by what is wrong with it, and the others go on.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/kept/roadmap_query.hpp"

namespace warren {

struct BatchOptions {
  RoadmapSearchFields how = {};
  bool lengths_only = false;  ///< id, status and length; without verified and path
  bool csv = false;           ///< answers as CSV with a header, without paths, instead of JSON lines
};

struct BatchAccount {
  std::uint64_t questions = 0;
  std::uint64_t solved = 0;
  std::uint64_t wrong = 0;  ///< lines that were answered by an error
};

/// Hands the answers to `write`, some lines at a time. The same for any number of threads. Throws InputError for a CSV
/// whose header says nothing, Stopped: then what was written are the first answers, whole lines.
BatchAccount ask_batch(const RoadmapQuery& query, const InputFile& questions, const BatchOptions& options,
                       const Execution& execution, const std::function<void(std::string_view)>& write);

struct MatrixAccount {
  std::uint64_t starts = 0;
  std::uint64_t goals = 0;
  std::uint64_t solved = 0;  ///< pairs
  std::uint64_t wrong = 0;   ///< places that can't be read, and pairs of others that can't be asked
};

/// A table of lengths: from each of some starts to each of some goals, a line a start (docs/file_formats.md). Each pair
/// is a question of its own: a search for all goals at once could take another of two ways of equal length, and the
/// last digits with it. A place that can't be read is an error in its line or column, the others go on. Hands the table
/// to `write`, some lines at a time. The same for any number of threads, and the same lengths as ask_batch.
/// options.lengths_only means nothing. Throws InputError for a CSV whose header says nothing, Stopped: then what was
/// written are the first lines, whole.
MatrixAccount ask_matrix(const RoadmapQuery& query, const InputFile& starts, const InputFile& goals,
                         const BatchOptions& options, const Execution& execution,
                         const std::function<void(std::string_view)>& write);

}  // namespace warren
