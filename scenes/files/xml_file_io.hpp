// SPDX-License-Identifier: BSD-3-Clause
// XML as robots and meshes are described in it: elements with their lines, attributes with numbers as the C locale
// writes them. Entities are not expanded, other files are not read.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "scenes/files/input_file_io.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Numbers between blanks.
class NumberText {
 public:
  explicit NumberText(std::string_view text) : rest_(text) { skip_blanks(); }
  bool done() const { return rest_.empty(); }
  /// The next number; false where there is none, or one that is not finite or beyond largest_coordinate.
  bool next(double& number);
  /// The same of a number without sign or fraction.
  bool next(std::size_t& number);
  /// What is left.
  std::string_view rest() const { return rest_; }

 private:
  void skip_blanks();
  template <class Number>
  bool parse(Number& number);

  std::string_view rest_;
};

class XmlFile {
 public:
  /// Reads all of it. Throws ReadError; InputError where it is no XML, its first element is not `root`, or it is larger
  /// than `most_bytes`; Stopped.
  XmlFile(const InputFile& file, std::string_view root, std::size_t most_bytes, const Execution& execution);

  const std::string& name() const { return file_.name(); }
  pugi::xml_node root() const { return document_.document_element(); }
  /// Throws InputError naming file and line.
  [[noreturn]] void fail(pugi::xml_node at, std::string_view what, std::string_view found = {}) const;

  /// An attribute that must be there and not be empty.
  std::string word(pugi::xml_node at, const char* attribute) const;
  /// An attribute that must be a number, if it is there.
  std::optional<double> number(pugi::xml_node at, const char* attribute) const;
  /// The same, which must be there, and not be negative.
  double size(pugi::xml_node at, const char* attribute) const;
  /// An attribute of three numbers.
  Vec3 vector(pugi::xml_node at, const char* attribute, const Vec3& otherwise) const;
  /// All numbers of a text, exactly as many as `to` holds.
  void numbers(pugi::xml_node at, std::string_view text, std::span<double> to) const;

 private:
  const InputFile& file_;
  pugi::xml_document document_;
};

// The same bits on every machine: Eigen's own products are fused where a processor has that.

/// A turn by so many radians about an axis of length 1.
Eigen::Matrix3d turn_about(const Vec3& axis, double radians);
/// a * b.
Eigen::Matrix3d portable_product(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);
/// a * b.
Vec3 portable_product(const Eigen::Matrix3d& a, const Vec3& b);
/// a * b.
Eigen::Isometry3d portable_product(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

}  // namespace warren
