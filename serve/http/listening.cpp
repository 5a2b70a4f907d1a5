// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http/listening.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/v6_only.hpp>
#include <string>
#include <utility>

#include "core/base/error.hpp"

namespace warren::serve {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

std::vector<Tcp::acceptor> acceptors_at(const HttpPlace& place, asio::io_context& io) {
  std::vector<Tcp::acceptor> acceptors;
  std::uint16_t port = place.port;
  for (const std::string& name : place.addresses) {
    boost::system::error_code code;
    const auto address = asio::ip::make_address(name, code);
    Tcp::acceptor acceptor(io);
    if (!code) acceptor.open(address.is_v4() ? Tcp::v4() : Tcp::v6(), code);
    if (!code) acceptor.set_option(Tcp::acceptor::reuse_address(true), code);
    if (!code && address.is_v6()) acceptor.set_option(asio::ip::v6_only(true), code);
    if (!code) acceptor.bind({address, port}, code);
    if (!code) acceptor.listen(asio::socket_base::max_listen_connections, code);
    if (code == asio::error::address_in_use && acceptors.empty()) {
      throw UsageError(fmt::format("@port: {} of {} is taken; 0 takes a free one", port, name));
    }
    if (code && acceptors.empty())
      throw UsageError(fmt::format("@listen: {}, port {}: {}", name, port, code.message()));
    if (code) continue;
    port = acceptor.local_endpoint().port();
    acceptors.push_back(std::move(acceptor));
  }
  return acceptors;
}

}  // namespace warren::serve
