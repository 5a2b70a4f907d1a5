// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/base/error.hpp"
#include "distributed/messages.hpp"

namespace warren::distributed {
namespace {

struct Difference {
  unsigned rank;
  std::string facts;
};

constexpr double patience_s = 4.0;

bool is(const Bytes& message, Reply reply) {
  const auto bytes = std::as_bytes(std::span(&reply, 1));
  return std::equal(message.begin(), message.end(), bytes.begin(), bytes.end());
}

/// False where one of them does not say that last word in time. Whoever does not hear it is ended by what ended it.
bool end_others(Transport& transport, Reply last_word) {
  const Deadline patience(patience_s);
  const Execution patiently{.deadline = &patience};
  try {
    const Request end = Request::end;
    for (unsigned rank = 1; rank < transport.ranks(); ++rank) {
      transport.send(rank, std::as_bytes(std::span(&end, 1)), patiently);
    }
    for (unsigned rank = 1; rank < transport.ranks(); ++rank) {
      while (!is(transport.receive(rank, patiently), last_word)) {
      }
    }
    return true;
  } catch (const Stopped&) {
    return false;
  }
}

}  // namespace

bool agree(Transport& transport, std::string_view facts, const Execution& execution, std::string_view difference) {
  const auto bytes = std::as_bytes(std::span(facts));
  if (transport.rank() > 0) {
    transport.send(0, bytes, execution);
    const Bytes answer = transport.receive(0, execution);
    return answer == Bytes{std::byte{1}};
  }
  std::optional<Difference> first;
  for (unsigned rank = 1; rank < transport.ranks(); ++rank) {
    const Bytes theirs = transport.receive(rank, execution);
    std::string text;
    for (const std::byte byte : theirs) text += static_cast<char>(byte);
    if (text != facts && !first) first = Difference{rank, std::move(text)};
  }
  const Bytes answer{first ? std::byte{0} : std::byte{1}};
  for (unsigned rank = 1; rank < transport.ranks(); ++rank) transport.send(rank, answer, execution);
  if (!first) return true;
  throw InputError(fmt::format("rank {}", first->rank),
                   fmt::format("{}: '{}', not '{}'", difference, first->facts, facts));
}

EndOfFollowers::~EndOfFollowers() { end_others(transport_, Reply::ended); }

bool all_have_left(Transport& transport) { return end_others(transport, Reply::gone); }

void leave(Transport& transport) {
  const Deadline patience(patience_s);
  const Reply gone = Reply::gone;
  transport.send(0, std::as_bytes(std::span(&gone, 1)), {.deadline = &patience});
}

}  // namespace warren::distributed
