// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/requests.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "core/base/error.hpp"
#include "distributed/patience.hpp"

namespace warren::distributed {

void Requests::ask_one(unsigned rank, Request request, std::span<const std::byte> body) {
  const auto head = std::as_bytes(std::span(&request, 1));
  Bytes message(head.begin(), head.end());
  message.insert(message.end(), body.begin(), body.end());
  asked_ = request;
  traffic_[static_cast<std::size_t>(request)] += message.size();
  transport_.send(rank, message, execution_);
}

void Requests::ask(Request request, std::span<const std::byte> body) {
  for (unsigned rank = 1; rank < ranks(); ++rank) ask_one(rank, request, body);
}

Bytes Requests::answer(unsigned rank) {
  const Bytes message = transport_.receive(rank, execution_);
  traffic_[static_cast<std::size_t>(asked_)] += message.size();
  ValueUnpacker from(message, fmt::format("rank {}", rank));
  switch (from.take<Reply>()) {
    case Reply::done:
      return {message.begin() + sizeof(Reply), message.end()};
    case Reply::stopped:
      throw Stopped(from.take<StopReason>());
    case Reply::refused:
      throw InputError(fmt::format("rank {}", rank), from.take_text());
    case Reply::ended:
    case Reply::gone:
      break;
  }
  from.refuse();
}

/// Whoever has failed is heard first, whatever its rank.
std::vector<Bytes> Requests::answers(std::vector<unsigned> awaited) {
  std::vector<Bytes> found(ranks());
  Patience patience;
  while (!awaited.empty()) {
    const auto has_answered = [&](unsigned rank) {
      if (!transport_.has_message(rank)) return false;
      found[rank] = answer(rank);
      return true;
    };
    if (std::erase_if(awaited, has_answered) > 0) {
      patience.renew();
    } else {
      patience.wait(execution_);
    }
  }
  return found;
}

std::vector<Bytes> Requests::answers() {
  std::vector<unsigned> all(ranks() - 1);
  std::iota(all.begin(), all.end(), 1U);
  return answers(std::move(all));
}

}  // namespace warren::distributed
