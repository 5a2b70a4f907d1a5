// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/remote_cells.hpp"

#include "distributed/leader.hpp"

namespace warren::distributed {

class RemoteCells::Reader : public CellWallReader {
 public:
  explicit Reader(const RemoteCells& cells) : cells_(cells) {
    if (!cells.band_.is_empty()) own_ = cells.band_.walls(cells.who_).reader();
  }
  void read(std::size_t number, CellTile& tile) override {
    const Range own = cells_.band_.tiles();
    if (number >= own.first && number < own.last) return own_->read(number, tile);
    tile = cells_.leader_.tile(number, cells_.who_);
  }

 private:
  const RemoteCells& cells_;
  std::unique_ptr<CellWallReader> own_;
};

RemoteCells::RemoteCells(const Band& band, Leader& leader, WallsFor who)
    : CellWallSource(band.grid().rows, band.grid().cols, band.grid().side_log2),
      band_(band),
      leader_(leader),
      who_(who) {}

std::unique_ptr<CellWallReader> RemoteCells::reader() const { return std::make_unique<Reader>(*this); }

}  // namespace warren::distributed
