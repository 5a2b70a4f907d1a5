// SPDX-License-Identifier: BSD-3-Clause
// Disjoint regions of cells (union-find) for the maze generators that join regions. One Id an element.
#pragma once

#include <cstddef>
#include <utility>

#include "core/base/raw_vector.hpp"
#include "core/search/union_find.hpp"
#include "parallel/chunks.hpp"

namespace warren::maze {

template <class Id>
class Regions {
 public:
  /// Elements 0 .. count - 1, each a region of its own. Throws Stopped.
  Regions(std::size_t count, const Execution& execution) : parents_(count) {
    for_chunks(count, std::size_t{1} << 16, {execution.threads, execution.deadline}, [&](Range r) {
      for (std::size_t i = r.first; i < r.last; ++i) parents_[i] = static_cast<Id>(i);
    });
  }
  Id root(Id i) { return root_of(parents_, i); }
  /// Joins the regions of a and b; false if they were one already.
  bool join(Id a, Id b) { return unite(parents_, a, b); }

 private:
  RawVector<Id> parents_;
};

}  // namespace warren::maze
