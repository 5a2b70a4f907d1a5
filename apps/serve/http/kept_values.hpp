// SPDX-License-Identifier: BSD-3-Clause
// Values by name, the last used ones up to so many bytes: tiles and paths that will be asked for again.
#pragma once

#include <atomic>
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "core/run/execution.hpp"
#include "parallel/once.hpp"

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

 public:
  explicit KeptValues(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// A value, or none. It stays while the lease does, even if it is forgotten meanwhile.
  class Lease {
   public:
    Lease() = default;
    Lease(Lease&& other) noexcept : owner_(std::exchange(other.owner_, nullptr)), place_(other.place_) {}
    Lease& operator=(Lease&&) = delete;
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
  Lease put(const std::string& name, Value value, std::size_t bytes, Entries& gone) {
    forget(name, gone);
    if (bytes > most_bytes_ / 2) {
      held_.push_front({name, std::move(value), bytes, 0, false});
      return Lease(this, held_.begin());
    }
    while (bytes_ + bytes > most_bytes_) forget(std::string(order_.back().name), gone);
    order_.push_front({name, std::move(value), bytes});
    places_[name] = order_.begin();
    bytes_ += bytes;
    return Lease(this, order_.begin());
  }
  void forget(const std::string& name, Entries& gone) {
    const auto found = places_.find(name);
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
  std::map<std::string, Place> places_;
  std::atomic<std::size_t> bytes_{0};
};

/// Values by name that take long to make: who asks first makes one, and who asks for the same meanwhile waits for it,
/// each within its own limits. The last used ones are kept, up to so many bytes. Any number of threads may call. It
/// outlives its leases.
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

/// A value that is replaced while it is used: who took it keeps the one that was current then, and the last one to give
/// it back ends it. Values themselves never change. Nobody waits for more than a few pointers. Any number of threads
/// may call. It outlives its leases.
template <class Value>
class CurrentValue {
  struct Entry {
    std::unique_ptr<Value> value;
    std::size_t leases = 0;
  };
  using Place = typename std::list<Entry>::iterator;

 public:
  explicit CurrentValue(std::unique_ptr<Value> first) { entries_.push_front({std::move(first)}); }

  /// The value as it was when the lease was taken.
  class Lease {
   public:
    ~Lease() { owner_.give_back(place_); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    Value& operator*() const { return *place_->value; }
    Value* operator->() const { return place_->value.get(); }

   private:
    friend class CurrentValue;
    Lease(CurrentValue& owner, Place place) : owner_(owner), place_(place) {}
    CurrentValue& owner_;
    Place place_;
  };
  Lease now() {
    const std::lock_guard lock(mutex_);
    ++entries_.front().leases;
    return Lease(*this, entries_.begin());
  }

  /// Who changes it, one at a time.
  class Change {
   public:
    explicit Change(CurrentValue& owner) : owner_(owner), is_mine_(owner.begin()) {}
    ~Change() {
      if (is_mine_) owner_.end();
    }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;
    /// false: somebody else changes it now.
    bool is_mine() const { return is_mine_; }
    /// From now on the value is that one. Only where is_mine().
    void replace(std::unique_ptr<Value> next) { owner_.replace(std::move(next)); }

   private:
    CurrentValue& owner_;
    bool is_mine_;
  };

 private:
  bool begin() {
    const std::lock_guard lock(mutex_);
    return !std::exchange(is_changing_, true);
  }
  void end() {
    const std::lock_guard lock(mutex_);
    is_changing_ = false;
  }
  void replace(std::unique_ptr<Value> next) {
    std::list<Entry> gone;  // ends after the lock
    const std::lock_guard lock(mutex_);
    entries_.push_front({std::move(next)});
    const Place before = std::next(entries_.begin());
    if (before->leases == 0) gone.splice(gone.begin(), entries_, before);
  }
  void give_back(Place place) {
    std::list<Entry> gone;
    const std::lock_guard lock(mutex_);
    if (--place->leases == 0 && place != entries_.begin()) gone.splice(gone.begin(), entries_, place);
  }

  std::mutex mutex_;          // guards what follows
  std::list<Entry> entries_;  // the current one first; the others are leased
  bool is_changing_ = false;
};

}  // namespace warren::serve
