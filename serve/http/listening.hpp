// SPDX-License-Identifier: BSD-3-Clause
// Where a server listens.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <vector>

#include "serve/http/http_server.hpp"

namespace warren::serve {

/// Listens at all addresses that the machine has, at the first one's port. Throws UsageError where the first can't be.
std::vector<boost::asio::ip::tcp::acceptor> acceptors_at(const HttpPlace& place, boost::asio::io_context& io);

}  // namespace warren::serve
