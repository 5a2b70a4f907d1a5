// SPDX-License-Identifier: BSD-3-Clause
// Who is connected, and who gives way where all places are taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

#include "serve/http/http_connection.hpp"

namespace warren::serve {

/// Owns the connections.
class ConnectionPlaces {
 public:
  Connection& add(boost::asio::ip::tcp::socket socket, const boost::asio::ip::address& address,
                  std::size_t buffer_bytes);
  void forget(const Connection& connection) { connections_.erase(connection.id); }
  std::size_t size() const { return connections_.size(); }
  std::size_t of_address(const boost::asio::ip::address& address) const;
  /// Who has waited longest without a whole request; nullptr: all are worked on or answered.
  Connection* longest_waiting() const;
  /// Calls visit with each; it may forget the one that it is given.
  template <class Visit>
  void each(const Visit& visit) {
    for (auto next = connections_.begin(); next != connections_.end();) visit(*(next++)->second);
  }

 private:
  std::uint64_t next_id_ = 0;
  std::map<std::uint64_t, std::unique_ptr<Connection>> connections_;
};

}  // namespace warren::serve
