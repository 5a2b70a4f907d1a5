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

namespace warren::serve {

/// Any number of threads may call. It outlives its leases.
template <class Value>
class KeptValues {
  struct Entry {
    std::string name;
    Value value;
    std::size_t bytes;
    std::size_t leases = 0;
    bool is_kept = true;
  };
  using Entries = std::list<Entry>;
  using Place = typename Entries::iterator;
  using Places = std::map<std::string, Place>;

 public:
  explicit KeptValues(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// A value, or none. It stays while the lease does, even if it is forgotten or replaced meanwhile.
  class Lease {
   public:
    Lease() = default;
    Lease(Lease&& other) noexcept : owner_(std::exchange(other.owner_, nullptr)), place_(other.place_) {}
    ~Lease() {
      if (owner_ != nullptr) owner_->give_back(place_);
    }
    explicit operator bool() const { return owner_ != nullptr; }
    const Value& operator*() const { return place_->value; }
    const Value* operator->() const { return &place_->value; }

   private:
    friend class KeptValues;
    Lease(KeptValues* owner, Place place) : owner_(owner), place_(place) { ++place->leases; }
    KeptValues* owner_ = nullptr;
    Place place_ = {};
  };

  /// Replaces what had the name. The oldest go; a value of more than half of the bytes isn't kept.
  Lease put(const std::string& name, Value value, std::size_t bytes) {
    Entries gone;  // ends after the lock
    const std::lock_guard lock(mutex_);
    return put(name, std::move(value), bytes, gone);
  }
  /// The value of that name, or what make() gives, which is put: one alone of many who ask for it at once.
  template <class Make>
  Lease find_or_put(const std::string& name, std::size_t bytes, const Make& make) {
    Entries gone;
    const std::lock_guard lock(mutex_);
    if (auto known = look(name)) return known;
    return put(name, make(), bytes, gone);
  }
  /// The value of that name; none: it was never put or is forgotten.
  Lease find(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return look(name);
  }
  /// Of those that are kept.
  std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  Lease look(const std::string& name) {
    const auto found = places_.find(name);
    if (found == places_.end()) return {};
    order_.splice(order_.begin(), order_, found->second);
    return Lease(this, found->second);
  }
  /// Memory is taken before anything is forgotten: where it ends, all stays as it was.
  Lease put(const std::string& name, Value value, std::size_t bytes, Entries& gone) {
    const bool is_kept = bytes <= most_bytes_ / 2;
    Entries made;
    made.push_front({name, std::move(value), bytes, 0, is_kept});
    Places named;
    if (is_kept) named.emplace(name, made.begin());
    forget(places_.find(name), gone);
    while (is_kept && bytes_ + bytes > most_bytes_) forget(places_.find(order_.back().name), gone);
    places_.merge(named);
    if (is_kept) bytes_ += bytes;
    Entries& there = is_kept ? order_ : held_;
    there.splice(there.begin(), made);
    return Lease(this, there.begin());
  }
  void forget(typename Places::iterator found, Entries& gone) {
    if (found == places_.end()) return;
    const Place place = found->second;
    bytes_ -= place->bytes;
    places_.erase(found);
    place->is_kept = false;
    Entries& there = place->leases > 0 ? held_ : gone;
    there.splice(there.begin(), order_, place);
  }
  void give_back(Place place) {
    Entries gone;
    const std::lock_guard lock(mutex_);
    if (--place->leases == 0 && !place->is_kept) gone.splice(gone.begin(), held_, place);
  }

  const std::size_t most_bytes_;
  std::mutex mutex_;  // guards what follows; bytes_ is only written under it
  Entries order_;     // the last used first
  Entries held_;      // not kept any more, but leased
  Places places_;
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace warren::serve
