// SPDX-License-Identifier: BSD-3-Clause
// The one place where a search's queue is chosen, once a search.
#pragma once

#include <cstddef>

#include "core/search/search_queues.hpp"
#include "parallel/execution.hpp"
#include "planners/roadmap/roadmap_options.hpp"

namespace warren {

/// An array kept in order: one insertion costs as much as thousands into a heap, so each looks at the deadline.
template <class Queue>
class PolledArray : public Queue {
 public:
  explicit PolledArray(const Execution& execution) : execution_(&execution) {}
  void push(VertexId v, double key) {
    execution_->check();
    Queue::push(v, key);
  }

 private:
  const Execution* execution_;
};

/// Calls f with an empty queue of the kind, ready for vertex_count vertices. Throws Stopped.
template <class F>
auto with_queue(QueueKind kind, std::size_t vertex_count, const Execution& execution, const F& f) {
  const auto call = [&](auto queue) {
    queue.resize(vertex_count, [&] { execution.check(); });
    return f(queue);
  };
  switch (kind) {
    case QueueKind::lazy_heap:
      return call(LazyHeap());
    case QueueKind::sorted_array:
      return call(PolledArray<SortedArray>(execution));
    case QueueKind::resorted_array:
      return call(PolledArray<ResortedArray>(execution));
    case QueueKind::heap:
      break;
  }
  return call(IndexedHeap<4>());
}

}  // namespace warren
