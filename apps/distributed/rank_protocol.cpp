// SPDX-License-Identifier: BSD-3-Clause
#include "apps/distributed/rank_protocol.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "tools/screen/run_of_verb.hpp"

namespace warren::distributed {

void Requests::ask_one(unsigned rank, Request request, std::span<const std::byte> body) {
  const auto head = std::as_bytes(std::span(&request, 1));
  Bytes message(head.begin(), head.end());
  message.insert(message.end(), body.begin(), body.end());
  asked_ = request;
  traffic_[static_cast<std::size_t>(request)] += message.size();
  transport_.send(rank, message, execution_);
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

namespace {

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
    for (unsigned rank = 1; rank < transport.ranks(); ++rank) transport.send_value(rank, Request::end, patiently);
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
  std::optional<std::pair<unsigned, std::string>> first;  // rank that differs, and its facts
  for (unsigned rank = 1; rank < transport.ranks(); ++rank) {
    const Bytes theirs = transport.receive(rank, execution);
    std::string text(reinterpret_cast<const char*>(theirs.data()), theirs.size());
    if (text != facts && !first) first = std::pair(rank, std::move(text));
  }
  const Bytes answer{first ? std::byte{0} : std::byte{1}};
  for (unsigned rank = 1; rank < transport.ranks(); ++rank) transport.send(rank, answer, execution);
  if (!first) return true;
  const auto& [rank, its] = *first;
  throw InputError(fmt::format("rank {}", rank), fmt::format("{}: '{}', not '{}'", difference, its, facts));
}

EndOfFollowers::~EndOfFollowers() { end_others(transport_, Reply::ended); }

bool all_have_left(Transport& transport) { return end_others(transport, Reply::gone); }

void leave(Transport& transport) {
  const Deadline patience(patience_s);
  transport.send_value(0, Reply::gone, {.deadline = &patience});
}

void say_where_stopped(const Transport& transport, const Progress& progress, StopReason reason) {
  const char* stage = progress.stage();
  tools::say_on_standard_error(fmt::format("warren-mpi: rank {} of {}: stopped while it was at '{}': {}\n",
                                           transport.rank(), transport.ranks(), stage != nullptr ? stage : "the start",
                                           text_of(reason)));
}

}  // namespace warren::distributed
