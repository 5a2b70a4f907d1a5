// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/follower.hpp"

#include <chrono>
#include <csignal>
#include <limits>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/error.hpp"
#include "core/base/let_go.hpp"
#include "distributed/band_rounds.hpp"
#include "distributed/messages.hpp"
#include "parallel/ticker.hpp"
#include "planners/tiles/packed_tile_summary.hpp"

namespace warren::distributed {
namespace {

class Follower {
 public:
  Follower(Transport& transport, const BandTask& task, const FollowerLimits& limits)
      : transport_(transport),
        band_(task, band_rows(task.grid().tile_rows, transport.rank(), transport.ranks())),
        outer_(limits.signal),
        deadline_(std::numeric_limits<double>::infinity(), limits.memory_bytes, &stop_),
        waiting_(std::numeric_limits<double>::infinity(), limits.memory_bytes, limits.signal),
        execution_{limits.threads, &deadline_, limits.progress} {}

  void run() {
    while (serve(transport_.receive(0, {.deadline = &waiting_}))) {
    }
    const Reply ended = Reply::ended;
    transport_.send(0, std::as_bytes(std::span(&ended, 1)), {.deadline = &waiting_});
  }

 private:
  /// Answers one request; false at the end.
  bool serve(const Bytes& message) {
    ValueUnpacker from(message, "rank 0");
    const auto request = from.take<Request>();
    if (request == Request::end) return false;
    if (execution_.progress != nullptr) execution_.progress->begin(name_of(request).data(), 0);
    const bool is_short = request == Request::rounds && rounds_ && rounds_->is_short(from);
    const Bytes answer = answered(is_short, [&](ValuePacker& to) { work(request, from, to); });
    transport_.send(0, answer, {.deadline = &waiting_});
    return true;
  }

  /// The answer, or why there is none. A message that comes meanwhile is the end; of what is short that is found
  /// afterwards.
  template <class Work>
  Bytes answered(bool is_short, const Work& work) {
    using std::chrono::milliseconds;
    std::optional<Ticker> ticker;
    if (!is_short) {
      ticker.emplace(milliseconds(50), milliseconds(50), [this] {
        const int signal = outer_ != nullptr ? outer_->load() : 0;
        stop_.store(signal != 0 ? signal : transport_.has_message(0) ? SIGTERM : 0);
      });
    }
    ValuePacker packer;
    try {
      packer.add(Reply::done);
      work(packer);
      return packer.take();
    } catch (const Stopped& stopped) {
      return said(Reply::stopped, [&](ValuePacker& to) { to.add(stopped.reason); });
    } catch (const std::bad_alloc&) {
      return said(Reply::stopped, [&](ValuePacker& to) { to.add(StopReason::memory); });
    } catch (const Error& error) {
      return said(Reply::refused, [&](ValuePacker& to) { to.add_text(error.what()); });
    }
  }
  template <class Say>
  static Bytes said(Reply reply, const Say& say) {
    ValuePacker packer;
    packer.add(reply);
    say(packer);
    return packer.take();
  }

  void work(Request request, ValueUnpacker& from, ValuePacker& to) {
    if (request != Request::rounds) rounds_.reset();
    switch (request) {
      case Request::make:
        if (const auto rim = band_.make(execution_)) rim->pack(to);
        if (band_.read() != nullptr) KnownWalls::of(*band_.read()).pack(to);
        return;
      case Request::turn: {
        const auto edges = from.take_list<std::uint64_t>();
        if (!band_.is_empty()) band_.turn(edges);
        return;
      }
      case Request::reduce:
        return reduce(from, to);
      case Request::hand_over:
        return hand_over(to);
      case Request::rounds:
        return rounds(from, to);
      case Request::steps:
        for (const auto& steps : band_.steps_of(from.take_list<TileChain>(), execution_)) to.add_list(steps);
        return;
      case Request::judge: {
        const auto reach = from.take<double>();
        std::vector<NearLegs> legs;
        while (!from.is_done()) {
          const auto first = from.take<std::uint64_t>();
          legs.push_back({first, from.take_list<Vec2>()});
        }
        return to.add(band_.judge(legs, reach, execution_));
      }
      case Request::read:
        return read(from, to);
      case Request::end:
        return;
    }
  }

  void reduce(ValueUnpacker& from, ValuePacker& to) {
    ends_.start.links = from.take_list<EndLink>();
    ends_.goal.links = from.take_list<EndLink>();
    tiles_ = band_.reduce(ends_, from.take<BandPeeling>(), execution_);
    to.add(ReducedBand::of(tiles_));
  }
  void hand_over(ValuePacker& to) {
    std::size_t bytes = 0;
    for (const TileSummary& tile : tiles_) bytes += tile.bytes();
    execution_.reserve(bytes);
    for (TileSummary& tile : tiles_) {
      pack_summary(tile, to);
      tile = {};
    }
    let_go(tiles_);
  }
  void rounds(ValueUnpacker& from, ValuePacker& to) {
    if (!rounds_) {
      const TileGrid& grid = band_.grid();
      rounds_.emplace(grid, band_rows(grid.tile_rows, transport_.rank(), transport_.ranks()), ends_, std::move(tiles_),
                      execution_);
    }
    rounds_->serve(from, to);
  }
  void read(ValueUnpacker& from, ValuePacker& to) const {
    const auto number = from.take<std::size_t>();
    if (number < band_.tiles().first || number >= band_.tiles().last) throw InputError("tile", "is of another rank");
    CellTile tile;
    band_.walls(from.take<WallsFor>()).reader()->read(number, tile);
    for (const std::uint32_t value : {tile.first_col, tile.first_row, tile.width, tile.height}) to.add(value);
    to.add_list(tile.walls);
  }

  Transport& transport_;
  Band band_;
  const SignalFlag* outer_;
  SignalFlag stop_{0};
  Deadline deadline_;  // while it works
  Deadline waiting_;   // while it waits
  Execution execution_;
  OverlayEnds ends_;
  std::vector<TileSummary> tiles_;  // until they are handed over, or searched here
  std::optional<BandRounds> rounds_;
};

}  // namespace

void follow(Transport& transport, const BandTask& task, const FollowerLimits& limits) {
  Follower(transport, task, limits).run();
}

}  // namespace warren::distributed
