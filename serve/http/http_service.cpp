// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http/http_service.hpp"

#include <exception>
#include <new>

namespace warren::serve {
namespace {

HttpResponse said_of(const Stopped& stopped) {
  if (stopped.reason == StopReason::memory) {
    return error_response(503, "memory", "", "this needs more memory than there is");
  }
  return error_response(504, "budget", "budget_ms", "this takes longer than it may");
}

HttpResponse said_of_what_is_thrown() {
  try {
    throw;
  } catch (const HttpError& error) {
    return error_response(error);
  } catch (const UsageError& error) {
    return error_response(400, "usage", "", error.what());
  } catch (const InputError& error) {
    return error_response(400, "bad_data", error.where(), error.what());
  } catch (const Stopped& stopped) {
    return said_of(stopped);
  } catch (const std::bad_alloc&) {
    return error_response(503, "memory", "", "memory is out");
  } catch (const std::exception& error) {
    return error_response(500, "internal", "", error.what());
  }
}

}  // namespace

HttpResponse answer_of(HttpService& service, const HttpRequest& request, const SignalFlag& gone) noexcept {
  try {
    return service.work(request, gone);
  } catch (...) {
    return said_of_what_is_thrown();
  }
}

}  // namespace warren::serve
