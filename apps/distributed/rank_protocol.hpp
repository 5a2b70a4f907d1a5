// SPDX-License-Identifier: BSD-3-Clause
// How the processes of one run, its ranks, hand bytes to each other (two models: MPI, mpi_transport.hpp, and threads
// of one process, for tests), and what rank 0 asks of the others, and how they answer. Rank 0 leads: it sends the same
// request to all, does its own share, and takes the others' answers; nobody else ever speaks first. So no two ranks
// wait for each other, and a message that comes to a rank at work can only be the end.
#pragma once

#include <time.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/packed_values.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"

namespace warren::distributed {

/// Messages between two ranks arrive in their order. One call at a time. Waits sleep, poll the deadline and throw
/// Stopped.
class Transport : NotCopied {
 public:
  virtual ~Transport() = default;
  virtual unsigned rank() const = 0;  ///< 0 .. ranks() - 1
  virtual unsigned ranks() const = 0;
  /// Returns when the bytes may be changed.
  virtual void send(unsigned to, std::span<const std::byte> bytes, const Execution& execution) = 0;
  /// The same, of a plain value as it lies in memory.
  template <class T>
  void send_value(unsigned to, const T& value, const Execution& execution) {
    send(to, std::as_bytes(std::span(&value, 1)), execution);
  }
  /// Waits for the next message of that rank.
  virtual Bytes receive(unsigned from, const Execution& execution) = 0;
  /// Has a message of that rank come?
  virtual bool has_message(unsigned from) = 0;

  std::uint64_t bytes_sent() const { return bytes_sent_; }

 protected:
  std::uint64_t bytes_sent_ = 0;
};

/// Waiting for another process: sleeps, so that whoever shares the core can work, 50 us first and 2 ms at most.
class Patience {
 public:
  /// Throws Stopped.
  void wait(const Execution& execution) {
    execution.check();
    const timespec pause{0, pause_ns_};
    ::nanosleep(&pause, nullptr);
    pause_ns_ = std::min(2 * pause_ns_, 2'000'000L);
  }
  /// What was waited for has come.
  void renew() { pause_ns_ = 50'000; }

 private:
  long pause_ns_ = 50'000;
};

/// The stages of a run, as messages name them.
enum class Request : std::uint32_t { make, turn, reduce, hand_over, rounds, steps, judge, read, end };
inline constexpr std::size_t request_count = 9;
constexpr auto enum_names(Request) {
  return std::array<std::string_view, request_count>{"generate", "join",   "connect", "gather", "rounds",
                                                     "expand",   "verify", "search",  "end"};
}

/// How an answer begins: what follows is what was asked for, a StopReason, or the line of an error. Alone stand the
/// answer to Request::end, and what a rank says last of all.
enum class Reply : std::uint32_t { done, stopped, refused, ended, gone };

/// Rank 0's side of the conversation: it asks, the others answer, and what keeps one of them from it is thrown here.
/// Refers to the transport, whose rank is 0.
class Requests {
 public:
  Requests(Transport& transport, const Execution& execution) : transport_(transport), execution_(execution) {}

  unsigned ranks() const { return transport_.ranks(); }
  /// Whoever waits from now on waits so.
  void wait_as(const Execution& execution) { execution_ = execution; }
  const Execution& waits_as() const { return execution_; }  ///< how
  void ask_one(unsigned rank, Request request, std::span<const std::byte> body);
  /// Asks each of the others; say(rank, body) adds what it needs.
  template <class Say>
  void ask_each(Request request, const Say& say) {
    for (unsigned rank = 1; rank < ranks(); ++rank) {
      ValuePacker body;
      say(rank, body);
      ask_one(rank, request, body.bytes());
    }
  }
  /// The answer of one. Throws Stopped, InputError.
  Bytes answer(unsigned rank);
  /// The answers of these ranks, by rank; of the others nothing. Throws Stopped, InputError.
  std::vector<Bytes> answers(std::vector<unsigned> awaited);
  /// take(rank, answer) takes what each of the others says, when all have answered. Throws as answers().
  template <class Take>
  void take_each(const Take& take) {
    std::vector<unsigned> all(ranks() - 1);
    std::iota(all.begin(), all.end(), 1U);
    const std::vector<Bytes> found = answers(all);
    for (const unsigned rank : all) take(rank, ValueUnpacker(found[rank], "rank " + std::to_string(rank)));
  }

  /// Bytes that this rank has sent and received for each kind of request: all that went over the wire.
  const std::array<std::uint64_t, request_count>& traffic() const { return traffic_; }

 private:
  Transport& transport_;
  Execution execution_;
  Request asked_ = Request::make;  // last
  std::array<std::uint64_t, request_count> traffic_{};
};

// The first and the last step of a run over ranks: all are the same program with the same words, or none begins; and
// whatever becomes of rank 0, the others are told that it is over.

/// Every rank calls it before what it is about begins, as often and in the same order as the others, with all that must
/// be the same everywhere: its words first, then what it sees of the world. Throws InputError at rank 0, which says
/// what a rank that differs does, and returns false at the others. These return false, too, where rank 0 has failed
/// before it. Throws Stopped.
bool agree(Transport& transport, std::string_view facts, const Execution& execution,
           std::string_view difference = "is another program or was given other words than rank 0");

/// Lives at rank 0 while the others follow().
class EndOfFollowers : NotCopied {
 public:
  explicit EndOfFollowers(Transport& transport) : transport_(transport) {}
  /// Tells the others, whatever they are doing, and hears them out: what they were sending, too, and that they have
  /// ended. Waits for some seconds at most.
  ~EndOfFollowers();

 private:
  Transport& transport_;
};

/// The last that rank 0 does; the others, who may still wait for it, are told the end. False where one of them does not
/// leave() within some seconds: they can't part in order then.
bool all_have_left(Transport& transport);

/// The last that every other rank does.
void leave(Transport& transport);

// What a rank that is stopped says last: where it was and why, for of many ranks that end somebody has to.

/// One line on standard error.
void say_where_stopped(const Transport& transport, const Progress& progress, StopReason reason);

/// Gives what work() gives. Throws as it does, after the line where that is Stopped or memory that is out.
template <class Work>
auto telling_where_stopped(const Transport& transport, const Progress& progress, const Work& work) {
  try {
    return work();
  } catch (const Stopped& stopped) {
    say_where_stopped(transport, progress, stopped.reason);
    throw;
  } catch (const std::bad_alloc&) {
    say_where_stopped(transport, progress, StopReason::memory);
    throw;
  }
}

}  // namespace warren::distributed
