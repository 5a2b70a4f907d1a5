// SPDX-License-Identifier: BSD-3-Clause
// Denavit-Hartenberg tables as text: one item a line, `#` starts a comment, blanks or commas separate.
//
//   convention standard|modified          default standard
//   angles radians|degrees                of all joint lines; default radians
//   joint D A ALPHA LOW HIGH [OFFSET]     from the base to the tip, 1 to 6 of them
//   tool X Y Z                            of the last frame; default 0 0 0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/arms/arm_files_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

using scene_text::Fields, scene_text::Place;

/// The numbers that are left in the line, between `least` and `most` of them.
std::vector<double> numbers_left(Fields& fields, std::size_t least, std::size_t most, std::string_view usage) {
  std::vector<double> found;
  while (!fields.done() && found.size() <= most) found.push_back(fields.number());
  if (found.size() < least || found.size() > most) {
    fields.place().fail("expected `" + std::string(usage) + "`", scene_text::numbers_text(found.size()));
  }
  return found;
}

/// Which of two words is what is left in the line.
std::size_t choice(Fields& fields, const std::array<std::string_view, 2>& words, std::string_view usage) {
  const std::string_view word = fields.word();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end() || !fields.done()) fields.place().fail("expected `" + std::string(usage) + "`", word);
  return static_cast<std::size_t>(found - words.begin());
}

DhJoint read_joint(Fields& fields, std::size_t joints_before) {
  const std::vector<double> n = numbers_left(fields, 5, 6, "joint D A ALPHA LOW HIGH [OFFSET]");
  if (joints_before == most_chain_joints) fields.place().fail("an arm has at most 6 joints");
  if (n[3] > n[4]) fields.place().fail("LOW must not exceed HIGH", std::to_string(n[3]));
  return {n[0], n[1], n[2], n[3], n[4], n.size() > 5 ? n[5] : 0.0};
}

}  // namespace

DhTable read_dh_table(const InputFile& file, const Execution& execution) {
  DhTable table;
  double unit = 1.0;
  std::set<std::string, std::less<>> said;
  TextLines lines(file, execution);
  while (lines.next()) {
    Fields fields = lines.fields();
    if (fields.done()) continue;
    const std::string_view item = fields.word();
    if (item != "joint" && !said.emplace(item).second) fields.place().fail(fmt::format("a second `{}` line", item));
    if (item == "joint") {
      table.joints.push_back(read_joint(fields, table.joints.size()));
    } else if (item == "convention") {
      const std::size_t which = choice(fields, {"standard", "modified"}, "convention standard|modified");
      table.convention = static_cast<DhConvention>(which);
    } else if (item == "angles") {
      unit = choice(fields, {"radians", "degrees"}, "angles radians|degrees") == 0 ? 1.0 : std::numbers::pi / 180.0;
    } else if (item == "tool") {
      const std::vector<double> n = numbers_left(fields, 3, 3, "tool X Y Z");
      table.tool.translation() = Vec3(n[0], n[1], n[2]);
    } else {
      fields.place().fail("expected one of joint, convention, angles, tool", item);
    }
  }
  if (table.joints.empty()) {
    const std::size_t last_line = std::max<std::size_t>(1, lines.number());
    Place{file.name(), last_line}.fail("the file ends without any `joint D A ALPHA LOW HIGH`");
  }
  for (DhJoint& joint : table.joints) {
    for (double* angle : {&joint.alpha_rad, &joint.low_rad, &joint.high_rad, &joint.offset_rad}) *angle *= unit;
  }
  return table;
}

}  // namespace warren
