// SPDX-License-Identifier: BSD-3-Clause
// NumPy's arrays in and out. In: read where they lie, so their type and layout must fit, and a TypeError says how they
// don't; what is no array (lists, tuples) and whole numbers are converted, and what a mask hides is refused. Out:
// read-only views of what an object of ours holds, which keep that object alive, or arrays that own their block.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace warren::python {

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

}  // namespace warren::python
