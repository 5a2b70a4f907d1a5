// SPDX-License-Identifier: BSD-3-Clause
#include "apps/python/bind.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace warren::python {
namespace py = pybind11;
namespace {

using Numbers = py::array_t<double, py::array::c_style>;

Numbers converted(py::handle value, const std::string& name, const std::string& shape) {
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    for (const py::handle row : value) refuse_masked(row, name);
  }
  auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!numbers) {
    PyErr_Clear();
    throw py::type_error(fmt::format("{}: expected numbers in rows, {}", name, shape));
  }
  if (numbers.ndim() == 0)
    throw py::type_error(fmt::format("{}: expected numbers in rows, {} (found: one)", name, shape));
  if (numbers.size() == 0) return Numbers(Shape{0, 2});
  return Numbers(numbers);
}

}  // namespace

std::string kind_of(const py::array& array) {
  return py::str(array.dtype()).cast<std::string>() + " " +
         py::str(py::reinterpret_borrow<py::object>(array).attr("shape")).cast<std::string>();
}

void refuse_masked(py::handle value, const std::string& name) {
  if (!py::hasattr(value, "mask")) return;
  if (!py::module_::import("numpy").attr("ma").attr("is_masked")(value).cast<bool>()) return;
  throw py::type_error(name + ": a mask hides some of it, and nothing says what is there; give it filled()");
}

bool is_whole(py::handle value) {
  if (!py::isinstance<py::array>(value)) return false;
  const char kind = py::reinterpret_borrow<py::array>(value).dtype().kind();
  return kind == 'i' || kind == 'u';
}

NumberRows rows_of(py::handle value, const std::string& name, std::initializer_list<std::size_t> columns) {
  const std::string shape = fmt::format("(n, {})", fmt::join(columns.begin(), columns.end(), ") or (n, "));
  refuse_masked(value, name);
  if (!py::isinstance<py::array>(value) || is_whole(value)) {
    Numbers numbers = converted(value, name, shape);
    if (numbers.shape(0) == 0) return {numbers, numbers.data(), 0, *columns.begin()};
    return rows_of(numbers, name, columns);
  }
  const auto array = py::reinterpret_borrow<py::array>(value);
  const bool fits = array.ndim() == 2 && std::find(columns.begin(), columns.end(), array.shape(1)) != columns.end();
  if (!fits || !py::isinstance<Numbers>(value)) {
    const bool strided = fits && array.dtype().is(py::dtype::of<double>());
    throw py::type_error(fmt::format("{}: expected float64 {} in C order (found: {}{})", name, shape, kind_of(array),
                                     strided ? ", not in C order" : ""));
  }
  Numbers numbers = py::reinterpret_borrow<Numbers>(value);
  return {numbers, numbers.data(), static_cast<std::size_t>(array.shape(0)), static_cast<std::size_t>(array.shape(1))};
}

}  // namespace warren::python
