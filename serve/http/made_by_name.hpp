// SPDX-License-Identifier: BSD-3-Clause
// Values by name that take long to make: who asks first makes one, and who asks for the same meanwhile waits for it,
// each within its own limits. The last used ones are kept, up to so many bytes.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "parallel/execution.hpp"
#include "parallel/made_once.hpp"
#include "serve/http/kept_values.hpp"

namespace warren::serve {

/// Any number of threads may call. It outlives its leases.
template <class Value>
class MadeByName {
  using Kept = KeptValues<std::unique_ptr<MadeOnce<Value>>>;

 public:
  explicit MadeByName(std::size_t most_bytes) : kept_(most_bytes) {}

  /// The value stays where it is while one of these has it.
  class Lease {
   public:
    const Value& operator*() const { return *value_; }
    const Value* operator->() const { return value_; }

   private:
    friend class MadeByName;
    Lease(typename Kept::Lease kept, const Value& value) : kept_(std::move(kept)), value_(&value) {}
    typename Kept::Lease kept_;
    const Value* value_;
  };
  /// make() gives a std::unique_ptr that isn't empty. bytes: of the value; one of more than half of those that are kept
  /// is made for each who asks. Throws what make() throws, and the next one who asks makes it; Stopped while another
  /// thread makes it.
  template <class Make>
  Lease get(const std::string& name, std::size_t bytes, const Execution& execution, const Make& make) {
    auto kept = kept_.find_or_put(name, bytes, [] { return std::make_unique<MadeOnce<Value>>(); });
    const Value& value = (*kept)->get(execution, make);
    return Lease(std::move(kept), value);
  }

 private:
  Kept kept_;
};

}  // namespace warren::serve
