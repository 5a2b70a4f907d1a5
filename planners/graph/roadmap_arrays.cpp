// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/roadmap_arrays.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string_view>

#include "core/base/error.hpp"
#include "core/plane/se2.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/assemble_graph.hpp"

namespace warren {
namespace {

constexpr std::size_t parts_grain = std::size_t{1} << 14;

class PartsCheck {
 public:
  PartsCheck(const RoadmapParts& parts, const std::string& where, const Execution& execution)
      : parts_(parts), where_(where), execution_{execution.threads, execution.deadline} {}

  void check() const {
    check_sizes();
    check_states();
    check_first();
    check_rows();
    check_edge_states();
    if (!parts_.directed) check_twins();
    check_components();
  }

 private:
  static std::string number(std::uint64_t n) { return std::to_string(n); }
  [[noreturn]] void fail(const std::string& place, std::string_view what, const std::string& found) const {
    throw InputError(where_ + ": " + place, what, found);
  }
  void check_size(const std::string& array, std::size_t found, std::size_t expected) const {
    if (found != expected) fail(array, "expected " + number(expected) + " elements", number(found));
  }
  void check_sizes() const {
    const std::size_t d = parts_.dimension;
    if (d < 2 || d > most_numbers) fail("dimension", "expected 2 to 14 numbers a state", number(d));
    if (parts_.first.empty()) fail("first", "expected one element more than vertices", "0");
    const std::size_t n = parts_.vertex_count();
    if (n > no_vertex) fail("first", "expected fewer than 2^32 vertices", number(n));
    check_size("states", parts_.states.size(), n * d);
    check_size("to", parts_.to.size(), parts_.first.back());
    check_size("edge_states", parts_.edge_states.size(), edge_state_words(parts_.to.size()));
    check_size("component", parts_.component.size(), n);
  }
  void check_states() const {
    const auto states = parts_.states;
    const std::size_t bad = first_that(states.size(), parts_grain, execution_,
                                       [&](std::size_t i) { return !(std::abs(states[i]) <= largest_coordinate); });
    if (bad != states.size()) {
      fail("states[" + number(bad) + "]", "expected a finite number of at most 1e60", std::to_string(states[bad]));
    }
    if (parts_.dimension != 3) return;
    const std::size_t n = parts_.vertex_count();
    const std::size_t turned = first_that(n, parts_grain, execution_,
                                          [&](std::size_t v) { return std::abs(states[3 * v + 2]) > largest_heading; });
    if (turned == n) return;
    fail("states[" + number(3 * turned + 2) + "]", "expected a heading of at most 1000 rad",
         std::to_string(states[3 * turned + 2]));
  }
  void check_first() const {
    const auto first = parts_.first;
    if (first.front() != 0) fail("first[0]", "expected 0", number(first.front()));
    const std::size_t bad =
        first_that(first.size() - 1, parts_grain, execution_, [&](std::size_t v) { return first[v] > first[v + 1]; });
    if (bad == first.size() - 1) return;
    fail("first[" + number(bad + 1) + "]", "expected no less than " + number(first[bad]), number(first[bad + 1]));
  }

  /// Rows ascend strictly, so that a last element below V is enough for all of them.
  bool is_sound_row(VertexId v) const {
    const std::size_t begin = parts_.first[v];
    const std::size_t last = parts_.first[v + 1];
    if (begin == last) return true;
    bool sound = parts_.to[last - 1] < parts_.vertex_count() && parts_.to[begin] != v;
    for (std::size_t end = begin + 1; end < last; ++end) {
      execution_.poll(end);  // a chunk may have any number of them
      sound &= parts_.to[end - 1] < parts_.to[end] && parts_.to[end] != v;
    }
    return sound;
  }
  void check_rows() const {
    const std::size_t n = parts_.vertex_count();
    const std::size_t bad =
        first_that(n, parts_grain, execution_, [&](std::size_t v) { return !is_sound_row(static_cast<VertexId>(v)); });
    if (bad == n) return;
    for (std::size_t end = parts_.first[bad]; end < parts_.first[bad + 1]; ++end) {
      const std::string place = "to[" + number(end) + "]";
      const VertexId w = parts_.to[end];
      if (w >= n) fail(place, "expected a vertex below " + number(n), number(w));
      if (w == bad) fail(place, "expected no edge from a vertex to itself", number(w));
      if (end > parts_.first[bad] && w <= parts_.to[end - 1]) {
        fail(place, "expected more than " + number(parts_.to[end - 1]) + ", the one before it in its row", number(w));
      }
    }
  }

  void check_edge_states() const {
    constexpr std::uint64_t low_bits = 0x5555555555555555U;
    const auto words = parts_.edge_states;
    const std::size_t bad = first_that(words.size(), parts_grain, execution_,
                                       [&](std::size_t i) { return (words[i] & words[i] >> 1U & low_bits) != 0; });
    if (bad != words.size()) {
      const int bit = std::countr_zero(words[bad] & words[bad] >> 1U & low_bits);
      const std::size_t end = bad * edge_states_in_word + static_cast<std::size_t>(bit) / 2;
      fail("edge_states of end " + number(end), "expected 0, 1 or 2", "3");
    }
    const std::size_t used = parts_.to.size() % edge_states_in_word;
    if (used != 0 && words.back() >> (2 * used) != 0) {
      fail("edge_states[" + number(words.size() - 1) + "]", "expected zeros behind the last end", number(words.back()));
    }
  }

  /// The end that leads back from w to v; to.size() where there is none.
  std::size_t twin_of(VertexId v, VertexId w) const {
    const auto row = parts_.neighbours(w);
    const auto found = std::lower_bound(row.begin(), row.end(), v);
    if (found == row.end() || *found != v) return parts_.to.size();
    return parts_.first[w] + static_cast<std::size_t>(found - row.begin());
  }
  bool has_twin(VertexId v, std::size_t end) const {
    const std::size_t twin = twin_of(v, parts_.to[end]);
    return twin != parts_.to.size() && parts_.state_of_end(twin) == parts_.state_of_end(end);
  }
  bool has_all_twins(VertexId v, std::size_t begin, std::size_t last) const {
    for (std::size_t end = begin; end < last; ++end) {
      execution_.poll(end);
      if (!has_twin(v, end)) return false;
    }
    return true;
  }
  void check_twins() const {
    const std::size_t n = parts_.vertex_count();
    std::vector<std::size_t> uppers(chunk_count(n, parts_grain), 0);
    const std::size_t bad = first_in_chunks(n, parts_grain, execution_, [&](Range r) {
      std::size_t count = 0;
      for (std::size_t i = r.first; i < r.last; ++i) {
        const auto v = static_cast<VertexId>(i);
        const auto row = parts_.neighbours(v);
        const auto upper = static_cast<std::size_t>(row.end() - std::upper_bound(row.begin(), row.end(), v));
        count += upper;
        if (!has_all_twins(v, parts_.first[i + 1] - upper, parts_.first[i + 1])) return i;
      }
      uppers[r.first / parts_grain] = count;
      return r.last;
    });
    if (bad != n) fail_twin(static_cast<VertexId>(bad));
    if (2 * std::accumulate(uppers.begin(), uppers.end(), std::size_t{0}) == parts_.to.size()) return;
    const std::size_t lower = first_that(n, parts_grain, execution_, [&](std::size_t i) {
      return !has_all_twins(static_cast<VertexId>(i), parts_.first[i], parts_.first[i + 1]);
    });
    fail_twin(static_cast<VertexId>(lower));
  }
  [[noreturn]] void fail_twin(VertexId v) const {
    std::size_t end = parts_.first[v];
    while (has_twin(v, end)) ++end;
    const VertexId w = parts_.to[end];
    const std::string edge = "to[" + number(end) + "]: the edge from " + number(v) + " to " + number(w);
    if (twin_of(v, w) == parts_.to.size()) fail(edge, "expected to stand in the other vertex's row, too", "once");
    fail(edge, "expected the same state at both ends", "two");
  }

  void check_components() const {
    const std::size_t n = parts_.vertex_count();
    const RawVector<VertexId> expected = free_components(parts_, execution_);
    const std::size_t bad =
        first_that(n, parts_grain, execution_, [&](std::size_t v) { return expected[v] != parts_.component[v]; });
    if (bad == n) return;
    fail("component[" + number(bad) + "]",
         "expected the smallest vertex that free edges lead to, " + number(expected[bad]),
         number(parts_.component[bad]));
  }

  const RoadmapParts& parts_;
  const std::string& where_;
  Execution execution_;
};

}  // namespace

void check_parts(const RoadmapParts& parts, const std::string& where, const Execution& execution) {
  PartsCheck(parts, where, execution).check();
}

RawVector<VertexId> free_components(const RoadmapParts& parts, const Execution& execution) {
  return joined_labels(parts.vertex_count(), execution, [&](VertexId v, const auto& join) {
    for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
      if (parts.state_of_end(end) == EdgeState::free) join(parts.to[end]);
    }
  });
}

}  // namespace warren
