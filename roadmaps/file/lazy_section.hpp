// SPDX-License-Identifier: BSD-3-Clause
// A section of a large .roadmap file of which only some is needed: each block of 1 MiB is checked when somebody first
// looks at one of its elements. A look at what was checked costs a load and a test more than at a plain array.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "roadmaps/file/roadmap_file.hpp"

namespace warren {

/// Refers to the file. Any number of threads may read.
template <FileElement T>
class LazySection {
 public:
  /// Throws InputError where the section is missing or of another type.
  LazySection(const RoadmapFile& file, std::string_view name)
      : file_(&file), all_(file.unchecked_section<T>(name)), place_(file.find(name)) {}

  std::size_t size() const { return all_.size(); }
  /// Throws InputError where the block that holds it is damaged.
  T operator[](std::size_t i) const {
    file_->ensure(*place_, i * sizeof(T), sizeof(T));
    return all_[i];
  }
  /// Elements first .. first + count - 1, which must be there. Throws InputError where one of their blocks is damaged.
  std::span<const T> part(std::size_t first, std::size_t count) const {
    file_->ensure(*place_, first * sizeof(T), count * sizeof(T));
    return all_.subspan(first, count);
  }

 private:
  const RoadmapFile* file_;
  std::span<const T> all_;
  const SectionPlace* place_;
};

}  // namespace warren
