// SPDX-License-Identifier: BSD-3-Clause
// The whole maze as rank 0 sees it: its own tiles are made here, others by their ranks, when they are asked for. For
// the few tiles that no rank's share is about: those around start and goal; and for those of two components that are
// apart.
#pragma once

#include <memory>

#include "core/plane/cell_walls.hpp"
#include "distributed/band.hpp"

namespace warren::distributed {

class Leader;

/// Refers to both, which must outlive it.
class RemoteCells : public CellWallSource {
 public:
  RemoteCells(const Band& band, Leader& leader, WallsFor who);
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;

  const Band& band_;
  Leader& leader_;
  const WallsFor who_;
};

}  // namespace warren::distributed
