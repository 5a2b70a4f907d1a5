// SPDX-License-Identifier: BSD-3-Clause
// Values by name, the last used ones up to so many bytes: tiles and paths that will be asked for again.
#pragma once

#include <atomic>
#include <cstddef>
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace warren {

/// Any number of threads may call.
template <class Value>
class KeptValues {
 public:
  explicit KeptValues(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// Replaces what had the name. The oldest go; a value of more than half of the bytes isn't kept.
  void put(const std::string& name, Value value, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    forget(name);
    if (bytes > most_bytes_ / 2) return;
    while (bytes_ + bytes > most_bytes_) forget(std::string(order_.back().name));
    order_.push_front({name, std::move(value), bytes});
    places_[name] = order_.begin();
    bytes_ += bytes;
  }
  /// Shows the value of that name; false: there is none. Nobody else looks meanwhile.
  template <class Look>
  bool look(const std::string& name, const Look& look) {
    const std::lock_guard lock(mutex_);
    const auto found = places_.find(name);
    if (found == places_.end()) return false;
    order_.splice(order_.begin(), order_, found->second);
    look(std::as_const(found->second->value));
    return true;
  }
  /// Never waits for who looks.
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  struct Entry {
    std::string name;
    Value value;
    std::size_t bytes;
  };
  void forget(const std::string& name) {
    const auto found = places_.find(name);
    if (found == places_.end()) return;
    bytes_ -= found->second->bytes;
    order_.erase(found->second);
    places_.erase(found);
  }

  const std::size_t most_bytes_;
  std::mutex mutex_;        // guards what follows; bytes_ is only written under it
  std::list<Entry> order_;  // the last used first
  std::map<std::string, typename std::list<Entry>::iterator> places_;
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace warren
