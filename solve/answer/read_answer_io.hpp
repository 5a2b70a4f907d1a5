// SPDX-License-Identifier: BSD-3-Clause
// An answer read back from JSON: ours or anybody's that has a "path". Strict JSON, read in one pass without a tree, so
// a path of millions of points takes its own memory only.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/cell_potential.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// What a car's turns and gears cost, as an answer says that it was asked.
struct AskedDriving {
  std::optional<double> turn_cost;     ///< of a radian
  std::optional<double> cusp_cost;     ///< of a change of gear
  std::optional<double> reverse_cost;  ///< of a unit of length backwards
  bool optimise = false;               ///< then a change of gear costs a turning radius where nobody says it
};

/// A path that a file holds, and what it says of its problem: the program's own answers, or a path of anybody.
struct RecordedAnswer : ClaimedPath {
  Question problem;                          ///< what the answer says of the problem
  std::vector<std::string> joints;           ///< of an arm, in the order of its states; empty: not told
  std::vector<std::vector<double>> via;      ///< way-points that its path passes, in their order
  std::optional<std::string> world_hash;     ///< of the world that it is for; none: the file doesn't say
  std::optional<double> length;              ///< that it claims
  std::optional<double> gap;                 ///< the same
  AskedDriving driving;                      ///< behind the parts of that price
  std::optional<CellPotential> certificate;  ///< of the lower bound of all paths, from a file beside the answer
  std::string file;                          ///< where it stands, for messages
};

/// What a file "answer" would hold: an answer, or a path of these states alone.
RecordedAnswer recorded(const Answer& answer);
/// A path alone, as states of as many numbers each.
RecordedAnswer recorded(std::span<const std::vector<double>> states);

/// Masks are named, not read: read_masks() does. Throws InputError naming file and key, Stopped.
RecordedAnswer read_answer(const InputFile& input, const Execution& execution);
/// The same for a file of this name; "-" is standard input. Throws ReadError, too.
inline RecordedAnswer read_answer(const std::string& file, const Execution& execution) {
  return read_answer(InputFile(file, execution), execution);
}

/// All states of its path.
std::vector<std::vector<double>> states_of(const RecordedAnswer& answer);

/// Throws InputError unless each state of the path has so many numbers; `body` is whose they are.
void check_state_width(const RecordedAnswer& answer, std::size_t width, std::string_view body);

/// Does somebody name other joints than an arm has, or in another order? Who names none does not.
bool names_other_joints(std::span<const std::string> named, std::span<const ArmVariable> joints);

/// Throws InputError unless the states of the path are of these joints: by their number and, where the answer names
/// joints, by their names.
void check_joints(const RecordedAnswer& answer, std::span<const ArmVariable> joints);

/// The older path that a question keeps to is this one.
void keep_to(RouteRule& route, const RecordedAnswer& answer);

/// Throws InputError if the answer names the hash of another world.
void check_same_world(const RecordedAnswer& answer, const std::string& file, const Scene& scene,
                      const Execution& execution);
/// hash: of the scene.
[[noreturn]] void refuse_other_world(const RecordedAnswer& answer, const std::string& file, const Scene& scene,
                                     const std::string& hash);

}  // namespace warren
