// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/search.hpp"

#include <algorithm>

namespace warren {

void SearchState::clear() {
  for (const VertexId block : touched_blocks_) {
    is_touched_[block] = 0;
    const std::size_t first = block * block_size;
    std::fill(g_.begin() + static_cast<std::ptrdiff_t>(first),
              g_.begin() + static_cast<std::ptrdiff_t>(std::min(first + block_size, g_.size())), unreached);
  }
  touched_blocks_.clear();
}

RawVector<VertexId> SearchState::path_to(VertexId v) const {
  RawVector<VertexId> path;
  for (; v != no_vertex; v = parent_[v]) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<VertexId> SearchState::touched() const {
  std::vector<VertexId> blocks = touched_blocks_;
  std::sort(blocks.begin(), blocks.end());
  std::vector<VertexId> vertices;
  for (const VertexId block : blocks) {
    const auto first = static_cast<VertexId>(block * block_size);
    for (VertexId v = first; v < vertex_count_ && v < first + block_size; ++v) {
      if (reached(v)) vertices.push_back(v);
    }
  }
  return vertices;
}

}  // namespace warren
