// SPDX-License-Identifier: BSD-3-Clause
// The parts of the module warren._core, a file each. What users see of it is apps/python/warren/: classes with their
// documentation over these bare ones.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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

// NumPy's arrays in and out. In: read where they lie, so their type and layout must fit, and a TypeError says how they
// don't; what is no array (lists, tuples) and whole numbers are converted, and what a mask hides is refused. Out:
// read-only views of what an object of ours holds, which keep that object alive, or arrays that own their block.

using Shape = std::vector<pybind11::ssize_t>;

/// Of these sizes.
template <class... Sizes>
Shape shape_of(Sizes... sizes) {
  return {static_cast<pybind11::ssize_t>(sizes)...};
}

inline pybind11::array read_only(pybind11::array array) {
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Numbers in C order that `owner` holds.
template <class T>
pybind11::array view_of(const T* numbers, Shape shape, pybind11::handle owner) {
  return read_only(pybind11::array(pybind11::dtype::of<T>(), std::move(shape), {}, numbers, owner));
}

/// Takes a block of numbers: a vector of them, or of structs of them. row: the shape of each row, of which there are as
/// many as the block has numbers for.
template <class T, class Block>
pybind11::array array_of(Block block, Shape row = {}) {
  std::size_t rows = block.size() * sizeof(block[0]) / sizeof(T);
  for (const pybind11::ssize_t size : row) rows /= static_cast<std::size_t>(size);
  row.insert(row.begin(), static_cast<pybind11::ssize_t>(rows));
  auto held = std::make_unique<Block>(std::move(block));
  const auto* numbers = reinterpret_cast<const T*>(held->data());  // NOLINT: structs of T alone
  const pybind11::capsule owner(held.release(), [](void* p) { delete static_cast<Block*>(p); });
  return read_only(pybind11::array(pybind11::dtype::of<T>(), std::move(row), {}, numbers, owner));
}

/// Rows of numbers, float64 in C order. Keeps the array that holds them.
struct NumberRows {
  pybind11::array_t<double, pybind11::array::c_style> array;
  const double* numbers = nullptr;
  std::size_t rows = 0;
  std::size_t columns = 0;

  std::vector<double> row(std::size_t i) const { return {numbers + i * columns, numbers + (i + 1) * columns}; }
};

/// An (n, columns) argument, of float64 or of whole numbers. Throws TypeError, which names it, for another type or
/// shape.
NumberRows rows_of(pybind11::handle value, const std::string& name, std::initializer_list<std::size_t> columns);

/// Throws TypeError where it is an array with a mask that hides something.
void refuse_masked(pybind11::handle value, const std::string& name);

/// An array of whole numbers?
bool is_whole(pybind11::handle value);

/// "int64 (5, 2)": what an array is, for errors.
std::string kind_of(const pybind11::array& array);

// Worlds and answers as bytes, for pickle: what one version of the library writes, the same version reads. One list of
// members a type (binary_archive.cpp) serves both ways.

template <class T>
pybind11::bytes bytes_of(const T& value);

/// Throws InputError for the bytes of another version, or cut off.
template <class T>
T from_bytes(const pybind11::bytes& bytes);

}  // namespace warren::python
