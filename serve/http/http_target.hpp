// SPDX-License-Identifier: BSD-3-Clause
// What a request is for: the target of its first line, taken apart and decoded once.
#pragma once

#include <string_view>

#include "serve/http/http_message.hpp"

namespace warren::serve {

inline constexpr std::size_t longest_target = 2048;

/// Fills in path and query, of a target that is a whole address (absolute-form) also the host. Throws HttpError: 414
/// for more than longest_target bytes; 400 for what is no address and begins with no /, for broken escapes, and for
/// escaped bytes that no name here has: controls, beyond ASCII.
void read_target(std::string_view target, HttpRequest& request);

}  // namespace warren::serve
