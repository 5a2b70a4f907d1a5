// SPDX-License-Identifier: BSD-3-Clause
// What a call says that is refused.
#pragma once

#include <string>

namespace warren::test {

/// The words of the exception; "" where there is none. Others pass.
template <class Exception, class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const Exception& exception) {
    return exception.what();
  }
  return "";
}

}  // namespace warren::test
