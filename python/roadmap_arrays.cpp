// SPDX-License-Identifier: BSD-3-Clause
#include "python/roadmap_arrays.hpp"

#include "core/search/edge_states.hpp"
#include "python/interrupts.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

template <class List>
Shape size_of(const List& list) {
  return {static_cast<py::ssize_t>(list.size())};
}

}  // namespace

py::tuple all_rows(const py::object& self) {
  auto& kept = self.cast<KeptRoadmap&>();
  const Asking asking(kept);
  const RawVector<double>* lengths = nullptr;
  const RoadmapArrays* arrays = nullptr;
  CallLimits().run([&](const Execution& execution) {
    arrays = &kept.arrays(execution);
    lengths = &kept.lengths(execution);
  });
  // Below 2^31 unsigned numbers are the same bits as numbers with a sign, which SciPy has.
  const auto signed_view = [&](const auto& list) {
    return view_of(reinterpret_cast<const std::int32_t*>(list.data()), size_of(list), self);  // NOLINT
  };
  return py::make_tuple(signed_view(arrays->candidates.offsets()), signed_view(arrays->candidates.targets()),
                        view_of(lengths->data(), size_of(*lengths), self));
}

py::tuple free_rows_of(KeptRoadmap& kept) {
  const Asking asking(kept);
  EdgeRows rows = CallLimits().run([&](const Execution& execution) { return free_rows(kept, execution); });
  const Shape first = size_of(rows.first);
  const Shape ends = size_of(rows.to);
  return py::make_tuple(array_of<std::int32_t>(std::move(rows.first), first),
                        array_of<std::int32_t>(std::move(rows.to), ends),
                        array_of<double>(std::move(rows.lengths), ends));
}

py::array edge_states(KeptRoadmap& kept) {
  const Asking asking(kept);
  const RoadmapArrays* arrays = nullptr;
  CallLimits().run([&](const Execution& execution) { arrays = &kept.arrays(execution); });
  py::array_t<std::uint8_t> states(static_cast<py::ssize_t>(arrays->candidates.targets().size()));
  std::uint8_t* to = states.mutable_data();
  for (std::size_t i = 0; i < arrays->candidates.targets().size(); ++i) {
    to[i] = static_cast<std::uint8_t>(edge_state(arrays->edge_states, i));
  }
  return read_only(std::move(states));
}

py::array states_of(const py::object& self) {
  auto& kept = self.cast<KeptRoadmap&>();
  const Asking asking(kept);
  const RoadmapArrays* arrays = nullptr;
  CallLimits().run([&](const Execution& execution) { arrays = &kept.arrays(execution); });
  const auto width = static_cast<py::ssize_t>(arrays->dimension);
  return view_of(arrays->states.data(), {static_cast<py::ssize_t>(arrays->states.size()) / width, width}, self);
}

py::array components_of(KeptRoadmap& kept) {
  const Asking asking(kept);
  RawVector<VertexId> component =
      CallLimits().run([&](const Execution& execution) { return kept.arrays(execution).component; });
  const Shape size = size_of(component);
  return array_of<VertexId>(std::move(component), size);
}

}  // namespace warren::python
