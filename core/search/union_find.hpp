// SPDX-License-Identifier: BSD-3-Clause
// Union-find on a list of parents, where each element is its own at first: path halving, the smaller root becomes the
// root of both, so that a root is the smallest element of its set. In practice two or three steps a call. One thread;
// for many at once see the forest of the components on all cores.
#pragma once

#include <utility>

namespace warren {

/// The root of the set of v.
template <class Parents, class Id>
Id root_of(Parents& parents, Id v) {
  while (parents[v] != v) v = parents[v] = parents[parents[v]];
  return v;
}

/// Makes the sets of a and b one; false if they were one already.
template <class Parents, class Id>
bool unite(Parents& parents, Id a, Id b) {
  a = root_of(parents, a);
  b = root_of(parents, b);
  if (a == b) return false;
  if (a < b) std::swap(a, b);
  parents[a] = b;
  return true;
}

}  // namespace warren
