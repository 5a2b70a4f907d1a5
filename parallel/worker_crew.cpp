// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/worker_crew.hpp"

#include <algorithm>
#include <new>
#include <system_error>
#include <thread>

#include "parallel/execution.hpp"

namespace warren {
namespace {

constexpr int looks_before_sleep = 100;

/// Gives the core away some times while `waits` holds.
template <class Waits>
void look_out(const Waits& waits) {
  for (int look = 0; look < looks_before_sleep && waits(); ++look) std::this_thread::yield();
}

}  // namespace

SharedLoop::SharedLoop(std::size_t chunks, unsigned threads, const void* body, void (*call)(const void*, std::size_t))
    : chunks_(chunks),
      threads_(threads),
      body_(body),
      call_(call),
      share_count_(std::min({chunks, std::size_t{threads}, most_shares})) {
  std::size_t rest = chunks;
  for (std::size_t i = share_count_; i > 0; --i) {
    shares_[i - 1].end = rest;
    rest -= rest / i;
    shares_[i - 1].next = rest;
  }
}

void SharedLoop::work(std::size_t thread) noexcept {
  for (std::size_t i = 0; i < share_count_; ++i) work_on(shares_[(thread + i) % share_count_]);
}

void SharedLoop::work_on(Share& share) noexcept {
  while (!failed_.load(std::memory_order_relaxed)) {
    const std::size_t chunk = share.next++;
    if (chunk >= share.end) return;
    try {
      call_(body_, chunk);
    } catch (...) {
      if (!failed_.exchange(true)) error_ = std::current_exception();
    }
  }
}

bool SharedLoop::has_chunks() const {
  const auto end = shares_.begin() + static_cast<std::ptrdiff_t>(share_count_);
  return !failed_ && std::any_of(shares_.begin(), end, [](const Share& share) { return share.has_chunks(); });
}

void SharedLoop::rethrow() const {
  if (error_) std::rethrow_exception(error_);
}

void WorkerCrew::run(SharedLoop& loop) {
  open(loop);
  loop.work(0);
  close(loop);
  loop.rethrow();
}

void WorkerCrew::open(SharedLoop& loop) {
  const std::size_t helpers = std::min<std::size_t>(loop.threads_, loop.chunks_) - 1;
  const std::lock_guard lock(mutex_);
  grow(helpers);
  loop.next_loop_ = first_loop_;
  first_loop_ = &loop;
  posts_.fetch_add(1);
  for (std::size_t i = 0; i < std::min(helpers, workers_.size()); ++i) {
    if (workers_[i]->asleep) workers_[i]->wake.notify_one();
  }
}

/// Nobody joins the loop any more; returns when those who did have left.
void WorkerCrew::close(SharedLoop& loop) {
  {
    const std::lock_guard lock(mutex_);
    SharedLoop** link = &first_loop_;
    while (*link != &loop) link = &(*link)->next_loop_;
    *link = loop.next_loop_;
  }
  look_out([&] { return loop.inside_.load() > 0; });
  std::unique_lock lock(mutex_);  // also for those who have left, but still hold it
  loop.left_.wait(lock, [&] { return loop.inside_.load() == 0; });
}

void WorkerCrew::start_thread(WorkerCrew& crew, std::size_t index) {
  std::thread([&crew, index] { crew.help(index); }).detach();
}

/// Makes workers until there are `count`, or as many as the system allows; not again soon after it allowed no more.
void WorkerCrew::grow(std::size_t count) {
  if (posts_.load() - refused_at_ < loops_between_tries) return;
  try {
    while (workers_.size() < count) {
      workers_.push_back(std::make_unique<Worker>());
      try {
        start_(*this, workers_.size() - 1);
      } catch (...) {
        workers_.pop_back();
        throw;
      }
    }
  } catch (const std::system_error&) {  // no more threads now
    refused_at_ = posts_.load();
  } catch (const std::bad_alloc&) {  // nor memory for them
    refused_at_ = posts_.load();
  }
}

/// The newest loop that worker number `index` may help: so the same few threads help all loops on few threads.
SharedLoop* WorkerCrew::loop_for(std::size_t index) const {
  SharedLoop* loop = first_loop_;
  while (loop != nullptr && (index + 1 >= loop->threads_ || !loop->has_chunks())) loop = loop->next_loop_;
  return loop;
}

void WorkerCrew::help(std::size_t index) {
  std::unique_lock lock(mutex_);
  Worker& worker = *workers_[index];
  while (true) {
    SharedLoop* const loop = loop_for(index);
    if (loop == nullptr) {
      wait_for_work(lock, worker, index);
      continue;
    }
    ++loop->inside_;
    lock.unlock();
    loop->work(index + 1);
    lock.lock();
    if (--loop->inside_ == 0) loop->left_.notify_one();
  }
}

void WorkerCrew::wait_for_work(std::unique_lock<std::mutex>& lock, Worker& worker, std::size_t index) {
  const unsigned seen = posts_.load();
  if (index + 1 < thread_count(0)) {  // more threads than cores would only take them from each other
    lock.unlock();
    look_out([&] { return posts_.load() == seen; });
    lock.lock();
    if (posts_.load() != seen) return;
  }
  worker.asleep = true;
  worker.wake.wait(lock, [&] { return posts_.load() != seen; });
  worker.asleep = false;
}

}  // namespace warren
