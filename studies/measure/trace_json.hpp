// SPDX-License-Identifier: BSD-3-Clause
// A Trace as Chrome trace events, for chrome://tracing and ui.perfetto.dev: complete events ("X"), microseconds.
#pragma once

#include <string>

#include "parallel/trace.hpp"

namespace warren::studies {

std::string trace_json(const Trace& trace);

}  // namespace warren::studies
