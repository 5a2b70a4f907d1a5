// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/arms/dh_table_io.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>
#include <vector>

#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

using scene_text::Fields, scene_text::Place;

/// Reads one table.
class TableReader {
 public:
  explicit TableReader(const std::string& name) : name_(name) {}

  void read_line(Fields fields) {
    last_line_ = fields.place().line;
    if (fields.done()) return;
    const std::string_view item = fields.word();
    if (item == "joint") return read_joint(fields);
    if (item == "convention") return read_convention(fields);
    if (item == "angles") return read_angles(fields);
    if (item == "tool") return read_tool(fields);
    fields.place().fail("expected one of joint, convention, angles, tool", item);
  }

  DhTable take() {
    if (table_.joints.empty()) Place{name_, last_line_}.fail("the file ends without any `joint D A ALPHA LOW HIGH`");
    for (DhJoint& joint : table_.joints) {
      for (double* angle : {&joint.alpha_rad, &joint.low_rad, &joint.high_rad, &joint.offset_rad}) *angle *= unit_;
    }
    return std::move(table_);
  }

 private:
  /// The numbers that are left in the line, between `least` and `most` of them.
  static std::vector<double> numbers(Fields& fields, std::size_t least, std::size_t most, std::string_view usage) {
    std::vector<double> found;
    while (!fields.done() && found.size() <= most) found.push_back(fields.number());
    if (found.size() < least || found.size() > most) {
      fields.place().fail("expected `" + std::string(usage) + "`", std::to_string(found.size()) + " numbers");
    }
    return found;
  }
  void read_joint(Fields& fields) {
    const std::vector<double> n = numbers(fields, 5, 6, "joint D A ALPHA LOW HIGH [OFFSET]");
    if (table_.joints.size() == most_chain_joints) fields.place().fail("an arm has at most 6 joints");
    if (n[3] > n[4]) fields.place().fail("LOW must not exceed HIGH", std::to_string(n[3]));
    table_.joints.push_back({n[0], n[1], n[2], n[3], n[4], n.size() > 5 ? n[5] : 0.0});
  }
  void read_convention(Fields& fields) {
    constexpr std::array<std::string_view, 2> words{"standard", "modified"};
    table_.convention = static_cast<DhConvention>(choice(fields, words, "convention standard|modified"));
  }
  void read_angles(Fields& fields) {
    constexpr std::array<std::string_view, 2> words{"radians", "degrees"};
    unit_ = choice(fields, words, "angles radians|degrees") == 0 ? 1.0 : std::numbers::pi / 180.0;
  }
  void read_tool(Fields& fields) {
    const std::vector<double> n = numbers(fields, 3, 3, "tool X Y Z");
    table_.tool.translation() = Vec3(n[0], n[1], n[2]);
  }
  static std::size_t choice(Fields& fields, const std::array<std::string_view, 2>& words, std::string_view usage) {
    const std::string_view word = fields.word();
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end() || !fields.done()) fields.place().fail("expected `" + std::string(usage) + "`", word);
    return static_cast<std::size_t>(found - words.begin());
  }

  const std::string& name_;
  DhTable table_;
  double unit_ = 1.0;
  std::size_t last_line_ = 1;
};

}  // namespace

DhTable read_dh_table(const InputFile& file, const Execution& execution) {
  TableReader reader(file.name());
  TextLines lines(file, execution);
  while (lines.next()) reader.read_line(lines.fields());
  return reader.take();
}

}  // namespace warren
