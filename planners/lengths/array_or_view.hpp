// SPDX-License-Identifier: BSD-3-Clause
// A constant array that is either owned or a view of somebody else's memory, say of a mapped file: what reads it can't
// tell. Moves keep the elements where they are; copies aren't made by accident.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/raw_vector.hpp"
#include "parallel/once.hpp"

namespace warren {

/// Of plain elements only. A view must not outlive what it looks at.
template <class T>
class ArrayOrView {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;
  ArrayOrView() = default;
  explicit ArrayOrView(RawVector<T> elements) : own_(std::move(elements)), all_(own_) {}
  explicit ArrayOrView(std::span<const T> elements, FirstLook first_look = {})
      : all_(elements), first_look_(first_look) {}
  /// What was moved from may be assigned to or destroyed, nothing else.
  ArrayOrView(ArrayOrView&&) noexcept = default;
  ArrayOrView& operator=(ArrayOrView&&) noexcept = default;
  ~ArrayOrView() = default;

  std::size_t size() const { return all_.size(); }
  bool empty() const { return all_.empty(); }
  const T* data() const { return all_.data(); }
  const T& operator[](std::size_t i) const { return all_[i]; }
  std::span<const T> span() const { return all_; }
  /// Whoever reads a view of a large file calls it before it reads these elements, which must be there. Throws what the
  /// view's owner says of damage.
  void look(std::size_t first, std::size_t count) const { first_look_.ensure(first * sizeof(T), count * sizeof(T)); }

 private:
  RawVector<T> own_;
  std::span<const T> all_;
  FirstLook first_look_;
};

}  // namespace warren
