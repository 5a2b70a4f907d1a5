// SPDX-License-Identifier: BSD-3-Clause
#include "studies/measure/trace_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>

namespace warren::studies {

std::string trace_json(const Trace& trace) {
  std::string text =
      R"({"displayTimeUnit":"ms","otherData":{"version":"warren )" WARREN_VERSION R"("},"traceEvents":[)";
  text +=
      "\n"
      R"({"name":"process_name","ph":"M","pid":1,"tid":0,"args":{"name":"warren"}})";
  for (std::size_t thread = 0; thread < trace.thread_count(); ++thread) {
    fmt::format_to(std::back_inserter(text),
                   ",\n"
                   R"({{"name":"thread_name","ph":"M","pid":1,"tid":{0},"args":{{"name":"{1} {0}"}}}})",
                   thread, thread == 0 ? "main" : "worker");
  }
  for (const Trace::Event& event : trace.events()) {
    // Ends are rounded as beginnings are, so that what lies inside another event still does.
    const std::int64_t begin_ns = std::llround(1e3 * event.begin_us);
    const std::int64_t end_ns = std::llround(1e3 * (event.begin_us + event.duration_us));
    fmt::format_to(std::back_inserter(text),
                   ",\n"
                   R"({{"name":"{}","cat":"{}","ph":"X","ts":{:.3f},"dur":{:.3f},"pid":1,"tid":{}{}}})",
                   event.name, event.is_stage ? "stage" : "chunk", 1e-3 * static_cast<double>(begin_ns),
                   1e-3 * static_cast<double>(end_ns - begin_ns), event.thread,
                   event.items > 0 ? fmt::format(R"(,"args":{{"items":{}}})", event.items) : "");
  }
  return text + "\n]}\n";
}

}  // namespace warren::studies
