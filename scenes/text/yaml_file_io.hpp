// SPDX-License-Identifier: BSD-3-Clause
// A YAML file as a tree, and errors that name its lines. For the readers of formats that are YAML.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

class YamlFile {
 public:
  /// what: "a map server's YAML". Throws InputError where the file is larger, no YAML of keys with values, or
  /// more than one document, Stopped.
  YamlFile(const InputFile& file, std::string_view what, std::size_t most_mebibytes, const Execution& execution);

  const YAML::Node& root() const { return root_; }
  /// Its file and line.
  scene_text::Place place(const YAML::Node& node) const { return place(node.Mark()); }
  /// Throws InputError naming the line, and the value where the node is one.
  [[noreturn]] void fail(const YAML::Node& node, std::string_view what) const;
  /// A number of which is_right holds; infinities and what is no number are asked, too, and 0 for what is nearer to
  /// zero than smallest_coordinate. `key` and `expected` are for the error: "`key` must be EXPECTED".
  double number(const YAML::Node& node, std::string_view key, std::string_view expected,
                bool (*is_right)(double)) const;

 private:
  scene_text::Place place(const YAML::Mark& mark) const {
    return {name_, mark.is_null() ? 0 : static_cast<std::size_t>(mark.line) + 1};
  }

  std::string name_;
  YAML::Node root_;
};

}  // namespace warren
