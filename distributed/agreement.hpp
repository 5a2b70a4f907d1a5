// SPDX-License-Identifier: BSD-3-Clause
// The first and the last step of a run over ranks: all are the same program with the same words, or none begins; and
// whatever becomes of rank 0, the others are told that it is over.
#pragma once

#include <string_view>

#include "distributed/transport.hpp"

namespace warren::distributed {

/// Every rank calls it before what it is about begins, as often and in the same order as the others, with all that must
/// be the same everywhere: its words first, then what it sees of the world. Throws InputError at rank 0, which says
/// what a rank that differs does, and returns false at the others. These return false, too, where rank 0 has failed
/// before it. Throws Stopped.
bool agree(Transport& transport, std::string_view facts, const Execution& execution,
           std::string_view difference = "is another program or was given other words than rank 0");

/// Lives at rank 0 while the others follow().
class EndOfFollowers {
 public:
  explicit EndOfFollowers(Transport& transport) : transport_(transport) {}
  /// Tells the others, whatever they are doing, and hears them out: what they were sending, too, and that they have
  /// ended. Waits for some seconds at most.
  ~EndOfFollowers();
  EndOfFollowers(const EndOfFollowers&) = delete;
  EndOfFollowers& operator=(const EndOfFollowers&) = delete;

 private:
  Transport& transport_;
};

/// The last that rank 0 does; the others, who may still wait for it, are told the end. False where one of them does not
/// leave() within some seconds: they can't part in order then.
bool all_have_left(Transport& transport);

/// The last that every other rank does.
void leave(Transport& transport);

}  // namespace warren::distributed
