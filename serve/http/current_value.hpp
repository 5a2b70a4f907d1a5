// SPDX-License-Identifier: BSD-3-Clause
// A value that is replaced while it is used: who took it keeps the one that was current then, and the last one to give
// it back ends it. Values themselves never change. Nobody waits for more than a few pointers.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <utility>

namespace warren::serve {

/// Any number of threads may call. It outlives its leases.
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
