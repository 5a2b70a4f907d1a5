// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/agreement.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "core/base/error.hpp"
#include "distributed/messages.hpp"

namespace warren {
namespace {

struct Difference {
  unsigned rank;
  std::string facts;
};

}  // namespace

bool agree(Transport& transport, std::string_view facts, const Execution& execution) {
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
  throw InputError(
      fmt::format("rank {}", first->rank),
      fmt::format("is another program or was given other words than rank 0: '{}', not '{}'", first->facts, facts));
}

EndOfFollowers::~EndOfFollowers() {
  const Deadline patience(5.0);
  for (unsigned rank = 1; rank < transport_.ranks(); ++rank) {
    try {
      const Request end = Request::end;
      transport_.send(rank, std::as_bytes(std::span(&end, 1)), {.deadline = &patience});
    } catch (...) {  // whoever does not hear it is ended by what ended the run
    }
  }
}

}  // namespace warren
