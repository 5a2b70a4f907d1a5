// SPDX-License-Identifier: BSD-3-Clause
// A roadmap that Python holds, with what its questions need: made when they are first asked, kept for the next ones.
#pragma once

#include "apps/python/arrays.hpp"
#include "parallel/once.hpp"
#include "solve/kept/roadmap_query.hpp"

namespace warren::python {

/// Not movable, for queries refer to the roadmap. Any number of threads may ask.
class KeptRoadmap {
 public:
  explicit KeptRoadmap(Roadmap roadmap) : roadmap_(std::move(roadmap)) {}

  const Roadmap& roadmap() const { return roadmap_; }
  const RoadmapQuery& query(const Execution& execution) const;
  /// States and edges; a lattice's are made for it.
  const RoadmapArrays& arrays(const Execution& execution) const;
  /// Length of each edge end, in the order of arrays().
  const RawVector<double>& lengths(const Execution& execution) const;
  double length(VertexId from, VertexId to, const RoadmapQuery* query) const;
  /// Takes over what the questions so far have learnt of the edges. Nobody may ask meanwhile.
  void learn(const Execution& execution);

 private:
  friend class Asking;
  friend class Learning;
  static constexpr int learner = -1;
  int askers_ = 0;  // calls that ask now, or `learner`; read and written with the interpreter's lock held

  Roadmap roadmap_;
  MadeOnce<RoadmapQuery> query_;
  MadeOnce<RoadmapArrays> lattice_;
  MadeOnce<RawVector<double>> lengths_;
};

/// One of those who ask: any number of them, while nobody learns. Made and ended with the interpreter's lock held,
/// which is free between.
class Asking {
 public:
  /// Throws ValueError while another thread learns.
  explicit Asking(KeptRoadmap& kept) : kept_(kept) {
    if (kept.askers_ == KeptRoadmap::learner)
      throw pybind11::value_error("roadmap: another thread calls its learn() now");
    ++kept_.askers_;
  }
  ~Asking() { --kept_.askers_; }
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;

 private:
  KeptRoadmap& kept_;
};

/// The only one, who may change the roadmap.
class Learning {
 public:
  /// Throws ValueError while another thread asks or learns.
  explicit Learning(KeptRoadmap& kept) : kept_(kept) {
    if (kept.askers_ != 0) throw pybind11::value_error("learn: another thread asks this roadmap now");
    kept_.askers_ = KeptRoadmap::learner;
  }
  ~Learning() { kept_.askers_ = 0; }
  Learning(const Learning&) = delete;
  Learning& operator=(const Learning&) = delete;

 private:
  KeptRoadmap& kept_;
};

/// Rows of edges as RoadmapParts has them, with their lengths.
struct EdgeRows {
  RawVector<EdgeEnd> first;
  RawVector<VertexId> to;
  RawVector<double> lengths;
};

/// The edges that are known to be free. Throws Stopped.
EdgeRows free_rows(const KeptRoadmap& kept, const Execution& execution);

/// Lengths of the shortest ways between places, infinite where there is none: of pairs, row by row, or from each start
/// to each goal. The same for any number of threads. Throws InputError, which names the rows, Stopped.
void ask_lengths(const KeptRoadmap& kept, const NumberRows& starts, const NumberRows& goals, bool each_to_each,
                 const RoadmapSearchFields& how, const Execution& execution, double* lengths);

}  // namespace warren::python
