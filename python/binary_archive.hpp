// SPDX-License-Identifier: BSD-3-Clause
// Worlds and answers as bytes, for pickle: what one version of the library writes, the same version reads. One list of
// members a type (binary_archive.cpp) serves both ways.
#pragma once

#include <pybind11/pybind11.h>

namespace warren::python {

template <class T>
pybind11::bytes bytes_of(const T& value);

/// Throws InputError for the bytes of another version, or cut off.
template <class T>
T from_bytes(const pybind11::bytes& bytes);

}  // namespace warren::python
