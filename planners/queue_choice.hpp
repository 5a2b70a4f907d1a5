// SPDX-License-Identifier: BSD-3-Clause
// The one place where a search's queue is chosen, once a search.
#pragma once

#include <cstddef>

#include "core/search_queues.hpp"
#include "planners/roadmap_options.hpp"

namespace warren {

/// Calls f with an empty queue of the kind, ready for vertex_count vertices.
template <class F>
auto with_queue(QueueKind kind, std::size_t vertex_count, const F& f) {
  const auto call = [&](auto queue) {
    queue.resize(vertex_count);
    return f(queue);
  };
  switch (kind) {
    case QueueKind::lazy_heap:
      return call(LazyHeap());
    case QueueKind::sorted_array:
      return call(SortedArray());
    case QueueKind::resorted_array:
      return call(ResortedArray());
    case QueueKind::heap:
      break;
  }
  return call(IndexedHeap<4>());
}

}  // namespace warren
