// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/exports/state_names.hpp"

namespace warren {

std::vector<std::string> state_names(unsigned dimension) {
  if (dimension == 2) return {"x", "y"};
  if (dimension == 3) return {"x", "y", "theta"};
  std::vector<std::string> names;
  for (unsigned joint = 1; joint <= dimension; ++joint) names.push_back("q" + std::to_string(joint));
  return names;
}

}  // namespace warren
