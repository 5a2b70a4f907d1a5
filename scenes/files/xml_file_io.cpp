// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/xml_file_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "scenes/files/scene_text.hpp"

namespace warren {

void NumberText::skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size())); }

template <class Number>
bool NumberText::parse(Number& number) {
  const bool plus = rest_.size() > 1 && rest_[0] == '+' && rest_[1] != '-';
  const char* const end = rest_.data() + rest_.size();
  const auto [last, error] = std::from_chars(rest_.data() + (plus ? 1 : 0), end, number);
  const bool ends = last == end || *last == ' ' || *last == '\n' || *last == '\t' || *last == '\r';
  if (error != std::errc() || !ends) return false;
  rest_.remove_prefix(static_cast<std::size_t>(last - rest_.data()));
  skip_blanks();
  return true;
}

bool NumberText::next(double& number) {
  if (!parse(number) || !(std::abs(number) <= largest_coordinate)) return false;
  if (std::abs(number) < smallest_coordinate) number = 0.0;
  return true;
}

bool NumberText::next(std::size_t& number) { return parse(number); }

XmlFile::XmlFile(const InputFile& file, std::string_view root, std::size_t most_bytes, const Execution& execution)
    : file_(file) {
  const std::string_view bytes = file.bytes();
  if (bytes.size() > most_bytes) {
    throw InputError(name(), fmt::format("expected XML of at most {} MiB", most_bytes >> 20U),
                     fmt::format("{} bytes", bytes.size()));
  }
  constexpr std::size_t tree_bytes_a_byte = 20;  // "<a/>" takes 64
  execution.reserve(tree_bytes_a_byte * bytes.size());
  const pugi::xml_parse_result result =
      document_.load_buffer(bytes.data(), bytes.size(), pugi::parse_default, pugi::encoding_utf8);
  execution.check();
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result || document_.document_element().name() != root) {
    const std::size_t at = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, result.offset)), bytes.size());
    const auto line = 1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    scene_text::Place{name(), static_cast<std::size_t>(line)}.fail(
        fmt::format("expected XML whose first element is <{}>", root),
        result ? document_.document_element().name() : result.description());
  }
}

void XmlFile::fail(pugi::xml_node at, std::string_view what, std::string_view found) const {
  const std::string_view bytes = file_.bytes();
  const auto offset = std::clamp<std::ptrdiff_t>(at.offset_debug(), 0, static_cast<std::ptrdiff_t>(bytes.size()));
  const auto line = 1 + std::count(bytes.begin(), bytes.begin() + offset, '\n');
  const std::string_view element = at.name();
  scene_text::Place{name(), static_cast<std::size_t>(line)}.fail(fmt::format("<{}>: {}", element.substr(0, 40), what),
                                                                 found);
}

std::string XmlFile::word(pugi::xml_node at, const char* attribute) const {
  const std::string_view value = at.attribute(attribute).value();
  if (value.empty()) fail(at, fmt::format("`{}` is missing", attribute));
  return std::string{value};
}

std::optional<double> XmlFile::number(pugi::xml_node at, const char* attribute) const {
  const pugi::xml_attribute found = at.attribute(attribute);
  if (!found) return std::nullopt;
  NumberText text(found.value());
  double value = 0.0;
  if (!text.next(value) || !text.done()) fail(at, fmt::format("`{}` must be a number", attribute), found.value());
  return value;
}

double XmlFile::size(pugi::xml_node at, const char* attribute) const {
  const std::optional<double> value = number(at, attribute);
  if (!value) fail(at, fmt::format("`{}` is missing", attribute));
  if (*value < 0.0) fail(at, fmt::format("`{}` must be at least 0", attribute), at.attribute(attribute).value());
  return *value;
}

Vec3 XmlFile::vector(pugi::xml_node at, const char* attribute, const Vec3& otherwise) const {
  const pugi::xml_attribute found = at.attribute(attribute);
  if (!found) return otherwise;
  Vec3 value;
  numbers(at, found.value(), {value.data(), 3});
  return value;
}

void XmlFile::numbers(pugi::xml_node at, std::string_view text, std::span<double> to) const {
  NumberText read(text);
  bool good = true;
  for (double& number : to) good = good && read.next(number);
  if (!good || !read.done()) fail(at, fmt::format("expected {} numbers", to.size()), text);
}

Eigen::Matrix3d turn_about(const Vec3& axis, double radians) {
  const auto [sine, cosine] = portable::sin_and_cos(radians);
  Eigen::Matrix3d cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  const Eigen::Matrix3d outer = axis * axis.transpose();
  return cosine * Eigen::Matrix3d::Identity() + sine * cross + (1.0 - cosine) * outer;
}

Vec3 portable_product(const Eigen::Matrix3d& a, const Vec3& b) {
  return a.col(0) * b.x() + a.col(1) * b.y() + a.col(2) * b.z();
}

Eigen::Matrix3d portable_product(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  Eigen::Matrix3d product;
  for (Eigen::Index i = 0; i < 3; ++i) product.col(i) = portable_product(a, Vec3(b.col(i)));
  return product;
}

Eigen::Isometry3d portable_product(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  Eigen::Isometry3d product = Eigen::Isometry3d::Identity();
  product.linear() = portable_product(Eigen::Matrix3d(a.linear()), Eigen::Matrix3d(b.linear()));
  product.translation() = portable_product(Eigen::Matrix3d(a.linear()), Vec3(b.translation())) + a.translation();
  return product;
}

}  // namespace warren
