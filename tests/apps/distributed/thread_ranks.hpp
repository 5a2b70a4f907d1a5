// SPDX-License-Identifier: BSD-3-Clause
// Ranks that are threads of one process: a transport for tests, which counts what is sent and can let a rank fall
// silent.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "apps/distributed/rank_protocol.hpp"

namespace warren::test {

class ThreadRanks {
 public:
  explicit ThreadRanks(unsigned ranks) : boxes_(std::size_t{ranks} * ranks) {
    for (unsigned rank = 0; rank < ranks; ++rank) ends_.emplace_back(*this, rank, ranks);
  }

  distributed::Transport& at(unsigned rank) { return ends_[rank]; }
  /// Runs body(rank) on a thread each, 0 on this one; rethrows the first that threw, by rank.
  void run(const std::function<void(distributed::Transport&)>& body) {
    std::vector<std::exception_ptr> thrown(ends_.size());
    const auto guarded = [&](std::size_t rank) {
      try {
        body(ends_[rank]);
      } catch (...) {
        thrown[rank] = std::current_exception();
      }
    };
    std::vector<std::thread> threads;
    for (std::size_t rank = 1; rank < ends_.size(); ++rank) threads.emplace_back(guarded, rank);
    guarded(0);
    for (std::thread& thread : threads) thread.join();
    for (const std::exception_ptr& error : thrown) {
      if (error) std::rethrow_exception(error);
    }
  }
  std::uint64_t bytes_sent() const {
    std::uint64_t sum = 0;
    for (const End& end : ends_) sum += end.bytes_sent();
    return sum;
  }

 private:
  class End : public distributed::Transport {
   public:
    End(ThreadRanks& all, unsigned rank, unsigned ranks) : all_(all), rank_(rank), ranks_(ranks) {}
    unsigned rank() const override { return rank_; }
    unsigned ranks() const override { return ranks_; }
    void send(unsigned to, std::span<const std::byte> bytes, const Execution&) override {
      bytes_sent_ += bytes.size();
      const std::lock_guard lock(all_.mutex_);
      all_.boxes_[std::size_t{rank_} * ranks_ + to].emplace_back(bytes.begin(), bytes.end());
    }
    Bytes receive(unsigned from, const Execution& execution) override {
      distributed::Patience patience;
      while (!has_message(from)) patience.wait(execution);
      const std::lock_guard lock(all_.mutex_);
      auto& box = all_.boxes_[std::size_t{from} * ranks_ + rank_];
      Bytes bytes = std::move(box.front());
      box.pop_front();
      return bytes;
    }
    bool has_message(unsigned from) override {
      const std::lock_guard lock(all_.mutex_);
      return !all_.boxes_[std::size_t{from} * ranks_ + rank_].empty();
    }

   private:
    ThreadRanks& all_;
    const unsigned rank_;
    const unsigned ranks_;
  };

  std::mutex mutex_;
  std::vector<std::deque<Bytes>> boxes_;  // by sender and receiver
  std::deque<End> ends_;
};

}  // namespace warren::test
