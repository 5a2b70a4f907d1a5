// SPDX-License-Identifier: BSD-3-Clause
// Stands in for boost_search.cpp where Boost.Graph was not found when the program was built.
#include "apps/studies/search_graph.hpp"
#include "core/base/error.hpp"

namespace warren::studies {

bool has_boost_graph() { return false; }

std::unique_ptr<GraphSearch> boost_search(const SearchGraph&, SearchKind) {
  throw UsageError("@peer: this program was built without Boost.Graph (install libboost-dev and build it again)");
}

}  // namespace warren::studies
