// SPDX-License-Identifier: BSD-3-Clause
// What every reader promises, whatever its bytes are: one of four exceptions at most, and a message that is one
// printable line. A promise that is broken ends the program with a line that says which.
#pragma once

#include <optional>
#include <string_view>
#include <type_traits>

#include "core/base/error.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::fuzz {

/// Prints `what` and aborts unless it holds.
void demand(bool holds, std::string_view what);

/// Demands one line of printable UTF-8: decided by a decoder of its own.
void demand_message(std::string_view text);

/// One thread, 1 GiB, no deadline: a reader that needs long for its bytes is libFuzzer's to find.
const Execution& fuzz_execution();

/// What `read` gives, or nothing where it refuses as it may.
template <class Read>
auto read_or_refuse(const Read& read) -> std::optional<std::invoke_result_t<Read>> {
  try {
    return read();
  } catch (const InputError& error) {
    demand_message(error.what());
  } catch (const ReadError& error) {
    demand_message(error.what());
  } catch (const UsageError& error) {
    demand_message(error.what());
  } catch (const Stopped&) {
  }
  return std::nullopt;
}

void demand_same_robot(const RobotSpec& a, const RobotSpec& b);
/// All that a scene says, its source and lines apart. Polygons as GeoJSON and WKT write them where `turned`: each
/// corner once, anticlockwise.
void demand_same_scene(const Scene& a, const Scene& b, bool turned);
/// Which cells are blocked, unknown and water.
void demand_same_cells(const OccupancyMap& a, const OccupancyMap& b);

}  // namespace warren::fuzz
