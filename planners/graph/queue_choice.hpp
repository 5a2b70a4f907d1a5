// SPDX-License-Identifier: BSD-3-Clause
// The one place where a search's queue is chosen, once a search.
#pragma once

#include <cstddef>
#include <variant>

#include "core/search/search_queues.hpp"
#include "parallel/execution.hpp"
#include "planners/graph/roadmap_options.hpp"

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

/// The queues that are there to be compared with the heap, as one type: else each search of each world would be
/// compiled four times. Choosing costs one or two nanoseconds an operation; studies/searches times each queue without
/// it.
class ComparedQueue {
 public:
  ComparedQueue(QueueKind kind, const Execution& execution)
      : queue_(kind == QueueKind::lazy_heap      ? Any(LazyHeap())
               : kind == QueueKind::sorted_array ? Any(PolledArray<SortedArray>(execution))
                                                 : Any(PolledArray<ResortedArray>(execution))) {}

  template <class Poll>
  void resize(std::size_t vertex_count, const Poll& poll) {
    std::visit([&](auto& queue) { queue.resize(vertex_count, poll); }, queue_);
  }
  bool empty() const {
    return std::visit([](const auto& queue) { return queue.empty(); }, queue_);
  }
  void clear() {
    std::visit([](auto& queue) { queue.clear(); }, queue_);
  }
  void push(VertexId v, double key) {
    std::visit([&](auto& queue) { queue.push(v, key); }, queue_);
  }
  const QueueEntry& top() const {
    return std::visit([](const auto& queue) -> const QueueEntry& { return queue.top(); }, queue_);
  }
  QueueEntry pop() {
    return std::visit([](auto& queue) { return queue.pop(); }, queue_);
  }

 private:
  using Any = std::variant<LazyHeap, PolledArray<SortedArray>, PolledArray<ResortedArray>>;
  Any queue_;
};

/// Calls f with an empty queue of the kind, ready for vertex_count vertices. Throws Stopped.
template <class F>
auto with_queue(QueueKind kind, std::size_t vertex_count, const Execution& execution, const F& f) {
  const auto call = [&](auto queue) {
    queue.resize(vertex_count, [&] { execution.check(); });
    return f(queue);
  };
  if (kind == QueueKind::heap) return call(IndexedHeap<4>());
  return call(ComparedQueue(kind, execution));
}

}  // namespace warren
