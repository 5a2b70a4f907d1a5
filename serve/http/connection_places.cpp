// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http/connection_places.hpp"

#include <algorithm>
#include <utility>

namespace warren::serve {

Connection& ConnectionPlaces::add(boost::asio::ip::tcp::socket socket, const boost::asio::ip::address& address,
                                  std::size_t buffer_bytes) {
  const std::uint64_t id = next_id_++;
  auto& place = connections_[id] = std::make_unique<Connection>(id, std::move(socket), buffer_bytes);
  place->address = address;
  return *place;
}

std::size_t ConnectionPlaces::of_address(const boost::asio::ip::address& address) const {
  const auto same = [&](const auto& other) { return other.second->address == address; };
  return static_cast<std::size_t>(std::count_if(connections_.begin(), connections_.end(), same));
}

Connection* ConnectionPlaces::longest_waiting() const {
  Connection* longest = nullptr;
  for (const auto& [id, other] : connections_) {
    const bool waits = !other->closed && (other->stage <= Stage::body || other->stage == Stage::linger);
    if (waits && (longest == nullptr || other->waits_since < longest->waits_since)) longest = other.get();
  }
  return longest;
}

}  // namespace warren::serve
