// SPDX-License-Identifier: BSD-3-Clause
// The parts of the module warren._core, a file each. What users see of it is apps/python/warren/: classes with their
// documentation over these bare ones.
#pragma once

#include <pybind11/pybind11.h>

#include "apps/python/library_calls.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kept/roadmap_query.hpp"

namespace warren::python {

/// An answer, and what its planner made where it was asked to keep it.
struct KeptAnswer {
  Answer answer;
  ByProducts made = {};
};

/// An answer as it is told, without what nobody asked to keep. Throws what Python's handlers of signals raise that have
/// stopped it, or its explanation.
KeptAnswer finished(KeptAnswer said, bool keep, CallLimits& limits);

/// A roadmap that Python holds, with what its questions need: made when they are first asked, kept for the next ones.
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
  static constexpr int learner = -1;
  int askers_ = 0;  // calls that ask now, or `learner`; read and written with the interpreter's lock held

  Roadmap roadmap_;
  MadeOnce<RoadmapQuery> query_;
  MadeOnce<RoadmapArrays> lattice_;
  MadeOnce<RawVector<double>> lengths_;
};

/// One of those who ask: any number of them, while nobody learns; or the only one, who learns and may change the
/// roadmap. Made and ended with the interpreter's lock held, which is free between.
class Asking : NotCopied {
 public:
  /// Throws ValueError while another thread learns, and for who `learns` while another one asks.
  explicit Asking(KeptRoadmap& kept, bool learns = false) : kept_(kept) {
    if (learns && kept.askers_ != 0) throw pybind11::value_error("learn: another thread asks this roadmap now");
    if (kept.askers_ == KeptRoadmap::learner)
      throw pybind11::value_error("roadmap: another thread calls its learn() now");
    kept.askers_ = learns ? KeptRoadmap::learner : kept.askers_ + 1;
  }
  ~Asking() { kept_.askers_ = kept_.askers_ == KeptRoadmap::learner ? 0 : kept_.askers_ - 1; }

 private:
  KeptRoadmap& kept_;
};

void bind_worlds(pybind11::module_& module);
void bind_answers(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);
void bind_solving(pybind11::module_& module);
void bind_roadmaps(pybind11::module_& module);
void bind_studies(pybind11::module_& module);

// Worlds and answers as bytes, for pickle: what one version of the library writes, the same version reads. One list of
// members a type (binary_archive.cpp) serves both ways.

template <class T>
pybind11::bytes bytes_of(const T& value);

/// Throws InputError for the bytes of another version, or cut off.
template <class T>
T from_bytes(const pybind11::bytes& bytes);

}  // namespace warren::python
