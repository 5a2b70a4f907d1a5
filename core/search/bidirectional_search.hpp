// SPDX-License-Identifier: BSD-3-Clause
// NBA*: bidirectional A* in which no vertex is expanded by both sides (Pijls, Post: Yet another bidirectional algorithm
// for finding the shortest path, Econometric Institute report EI 2009-10), made for two threads that give the same path
// and counts as one. Exact for undirected graphs with lengths >= 0 and consistent heuristics.
//
// Rounds. In a round each side settles up to N vertices (64, doubling to 4096) knowing, of the other side, only what
// was published at the last border: which vertices it has closed, its least key F', and the best length L of a path
// found. At the border both publish what they closed and compare the labels that they set with the other side's. So a
// round has two phases, advance() and exchange(), in which a side writes only what the other doesn't read; the order of
// the two sides within a phase can't matter.
//
// A side pops u with the least g(u) + h(u); it skips u if the other side had closed it; it closes u without expanding
// it if g(u) + h(u) >= L or g(u) + F' - h'(u) >= L; else it expands u, leaving out neighbours that the other side had
// closed.
//
// Why L is the distance at the end. Call a vertex settled if it is expanded with the right label. Invariant at borders,
// while L > d(s, t): there is a shortest path whose beginning is settled by the forward side, whose end is settled by
// the backward side, and whose middle is closed by neither and not empty. (1) Let the forward side's round go first. If
// it pops a vertex m of the middle, its label is right, for else the first unsettled vertex of the path, which is open
// with the right label, has a smaller key. m isn't rejected: g + h <= d(s, t) < L; and g(m) + F' - h'(m) >= L > d(s, t)
// would make F' > d(m, t) + h'(m), which bounds the key of the last vertex that the backward side had open on the path.
// So m is settled, and the tree path to m becomes the beginning. (2) Then the backward side's round, the same way. It
// does not know what the forward side closed in this round; if it pops such a vertex z of the path, z has the right
// label by the argument of (1), both labels of z are right, and the border finds L = d(s, t). (3) If the middle is
// empty, take the neighbours u and w where beginning and end meet: whoever expanded its one first, or either in the
// same round, had not been told that the other was closed and so labelled it rightly: again the border finds L = d(s,
// t). Hence when a side has nothing open, or F >= L, L is the distance. Old F', L and closed marks only prune less.
//
// Memory: 17 bytes a vertex and side (SearchState 12, heap 4, mark 1), and the queues.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/search/search.hpp"

namespace warren {

/// What a side tells at a border.
struct SearchBorder {
  double least_key = 0.0;  ///< no vertex that it settles later has a smaller key; infinity: nothing is open
  double best = std::numeric_limits<double>::infinity();  ///< length of the best path that it has seen
  VertexId meeting = no_vertex;                           ///< where that path changes sides
  bool stop = false;                                      ///< it was asked to stop, or failed
  /// A path of this length, which changes sides there, has been seen.
  void offer(double length, VertexId at) {
    if (length < best || (length == best && at < meeting)) {
      best = length;
      meeting = at;
    }
  }
};

/// What a side writes all the time may not share a cache line with what the other reads all the time.
inline constexpr std::size_t bytes_apart = 128;

/// One side of the search. Neighbours: neighbours(v, visit) calls visit(w, length) for each neighbour in ascending
/// order; an implicit graph may ask visit.wants(w, length) first, whether an edge of at least this length could help,
/// before it tests it. Where there are many, neighbours.fetch(v) asks the memory for the row of v, and
/// neighbours.for_each_target(v, visit) reads it ahead of time. to_target: consistent estimate to the other side's
/// root; to_root: to this side's root.
template <class Queue, class Neighbours, class ToTarget, class ToRoot>
class SearchSide : NotCopied {
 public:
  /// state and queue are cleared and sized here, and poll() is called meanwhile; all of it is used until the search
  /// ends.
  template <class Poll = NoPoll>
  SearchSide(VertexId root, std::size_t vertex_count, const Neighbours& neighbours, const ToTarget& to_target,
             const ToRoot& to_root, Queue& queue, SearchState& state, const Poll& poll = {})
      : neighbours_(neighbours), to_target_(to_target), to_root_(to_root), queue_(queue), state_(state) {
    queue_.clear();
    queue_.resize(vertex_count, poll);
    state_.resize(vertex_count, poll);
    assign_polled(closed_, vertex_count, std::uint8_t{0}, poll);
    state_.reach(root, 0.0, no_vertex);
    queue_.push(root, to_target_(root));
    labelled_.push_back(root);
  }

  /// Settles up to `limit` vertices. Reads the other side's published marks, writes nothing that it reads.
  template <class Other>
  void advance(const Other& other, const SearchBorder& agreed, double other_least_key, std::uint64_t limit) {
    drop_closed(other);
    for (std::uint64_t i = 0; i < limit && !queue_.empty() && queue_.top().key < agreed.best; ++i) {
      const VertexId v = queue_.pop().vertex;
      state_.close(v);
      newly_closed_.push_back(v);
      ++settled_;
      if (!queue_.empty()) fetch_ahead(queue_.top().vertex);
      const double g = state_.g(v);
      if (g + other_least_key - to_root_(v) < agreed.best) neighbours_(v, Visit<Other>{*this, other, v, g});
      drop_closed(other);
    }
  }

  /// Publishes. Reads the other side's labels, which nobody writes in this phase.
  template <class Other>
  void exchange(const Other& other, bool stop) {
    for (const VertexId v : labelled_) {
      if (other.state().reached(v)) border_.offer(state_.g(v) + other.state().g(v), v);
    }
    for (const VertexId v : newly_closed_) closed_[v] = 1;
    labelled_.clear();
    newly_closed_.clear();
    border_.least_key = queue_.empty() ? std::numeric_limits<double>::infinity() : queue_.top().key;
    border_.stop = stop;
  }

  const SearchBorder& border() const { return border_; }
  const SearchState& state() const { return state_; }
  bool has_closed(VertexId v) const { return closed_[v] != 0; }  ///< as published
  const std::uint8_t* closed_marks() const { return closed_.data(); }
  std::uint64_t settled() const { return settled_; }
  std::uint64_t pushes() const { return pushes_; }
  std::uint64_t decreases() const { return decreases_; }

 private:
  template <class Other>
  struct Visit {
    SearchSide& side;
    const Other& other;
    VertexId from;
    double g;
    bool wants(VertexId w, double length) const { return side.state_.improves(w, g + length) && !other.has_closed(w); }
    double through() const { return g; }
    std::span<const double> labels() const { return side.state_.labels(); }
    const std::uint8_t* settled_elsewhere() const { return other.closed_marks(); }
    void operator()(VertexId w, double length) const {
      if (!wants(w, length)) return;
      ++(side.state_.reached(w) ? side.decreases_ : side.pushes_);
      side.state_.reach(w, g + length, from);
      side.queue_.push(w, g + length + side.to_target_(w));
      side.labelled_.push_back(w);
      if constexpr (fetches) side.neighbours_.fetch(w);
    }
  };
  static constexpr bool fetches = requires(const Neighbours& neighbours, VertexId v) { neighbours.fetch(v); };
  /// Asks for what settling v, probably the next one, will read.
  void fetch_ahead(VertexId v) const {
    if constexpr (fetches) {
      neighbours_.for_each_target(v, [&](VertexId w) {
        state_.fetch(w);
        if constexpr (requires { queue_.fetch(w); }) queue_.fetch(w);
      });
    }
  }
  /// Leaves at the top of the queue a vertex that nobody has closed.
  template <class Other>
  void drop_closed(const Other& other) {
    while (!queue_.empty() && (state_.closed(queue_.top().vertex) || other.has_closed(queue_.top().vertex)))
      queue_.pop();
  }

  const Neighbours& neighbours_;
  const ToTarget& to_target_;
  const ToRoot& to_root_;
  Queue& queue_;
  SearchState& state_;
  RawVector<std::uint8_t> closed_;                       // as published
  alignas(bytes_apart) std::vector<VertexId> labelled_;  // in this round, perhaps more than once
  std::vector<VertexId> newly_closed_;                   // in this round
  SearchBorder border_;
  std::uint64_t settled_ = 0;
  std::uint64_t pushes_ = 1;  // the root
  std::uint64_t decreases_ = 0;
};

/// What both sides know after an exchange; a pure function of what they published.
inline SearchBorder agree(const SearchBorder& forward, const SearchBorder& backward) {
  SearchBorder agreed = forward;
  agreed.offer(backward.best, backward.meeting);
  agreed.least_key = std::max(forward.least_key, backward.least_key);
  agreed.stop = forward.stop || backward.stop;
  return agreed;
}
inline bool is_over(const SearchBorder& agreed) { return agreed.stop || !(agreed.least_key < agreed.best); }

/// Vertices that a side settles in a round.
constexpr std::uint64_t round_size(std::uint64_t round) { return round < 6 ? std::uint64_t{64} << round : 4096; }

/// The answer after the last exchange. `expanded` counts the vertices settled by both sides.
template <class Forward, class Backward>
SearchResult joined_result(const SearchBorder& agreed, const Forward& forward, const Backward& backward) {
  SearchResult result;
  result.expanded = forward.settled() + backward.settled();
  if constexpr (requires { forward.pushes(); }) {
    result.pushes = forward.pushes() + backward.pushes();
    result.decreases = forward.decreases() + backward.decreases();
  }
  if (agreed.stop) {
    result.status = SearchStatus::stopped;
  } else if (agreed.meeting != no_vertex) {
    result.status = SearchStatus::found;
    result.length = agreed.best;
    result.path = forward.state().path_to(agreed.meeting);
    const RawVector<VertexId> end = backward.state().path_to(agreed.meeting);
    result.path.insert(result.path.end(), end.rbegin() + 1, end.rend());
  }
  return result;
}

/// What a side tells: SearchBorder, or what another kind of search makes of it, with an agree() of its own.
template <class Side>
using BorderOf = std::remove_cvref_t<decltype(std::declval<const Side&>().border())>;

/// Calls one after the other.
struct InTurn {
  void operator()(std::uint64_t, const auto& first, const auto& second) const {
    first();
    second();
  }
};

/// Both sides; should_stop() is asked once a round. together(round, first, second) runs two calls, of which each
/// touches its own side alone: here in turn, in parallel/ on two threads.
template <class Forward, class Backward, class ShouldStop = NeverStop, class Together = InTurn>
requires std::is_invocable_r_v<bool, ShouldStop> SearchResult bidirectional(Forward& forward, Backward& backward,
                                                                            const ShouldStop& should_stop = {},
                                                                            const Together& together = {}) {
  BorderOf<Forward> agreed;
  for (std::uint64_t round = 0; !is_over(agreed); ++round) {
    together(
        round, [&] { forward.advance(backward, agreed, backward.border().least_key, round_size(round)); },
        [&] { backward.advance(forward, agreed, forward.border().least_key, round_size(round)); });
    together(
        round, [&] { forward.exchange(backward, should_stop()); }, [&] { backward.exchange(forward, false); });
    agreed = agree(forward.border(), backward.border());
  }
  return joined_result(agreed, forward, backward);
}

}  // namespace warren
