// SPDX-License-Identifier: BSD-3-Clause
#include "apps/distributed/leader_follower.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iterator>
#include <utility>

#include "core/base/enum_names.hpp"
#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/once.hpp"
#include "parallel/ticker.hpp"
#include "planners/mazes/tile_plane.hpp"

namespace warren::distributed {
namespace {

/// What is known of a file's walls by reading them; the same at all ranks that have read all of it.
struct KnownWalls {
  std::string hash;  ///< empty: not known
  std::uint64_t count = 0;

  static KnownWalls of(const StreamedWalls& read) {
    return {read.hash().value_or(std::string{}), read.wall_count().value_or(0)};
  }
  void pack(ValuePacker& to) const {
    to.add_text(hash);
    to.add(count);
  }
  static KnownWalls unpack(ValueUnpacker& from) {
    std::string hash = from.take_text();
    return {std::move(hash), from.take<std::uint64_t>()};
  }
  bool operator==(const KnownWalls&) const = default;
};

constexpr std::uint64_t TileSummary::*tile_counts[] = {&TileSummary::milestones, &TileSummary::candidate_edges,
                                                       &TileSummary::free_edges, &TileSummary::closed_components};

/// A band's tiles, reduced, in sum.
struct ReducedBand {
  std::uint64_t bytes = 0;  ///< of their summaries
  std::uint64_t keys = 0;
  std::array<std::uint64_t, std::size(tile_counts)> counts = {};

  static ReducedBand of(std::span<const TileSummary> tiles) {
    ReducedBand sum;
    for (const TileSummary& tile : tiles) {
      sum.bytes += tile.bytes();
      sum.keys += tile.keys.size();
      for (std::size_t i = 0; i < sum.counts.size(); ++i) sum.counts[i] += tile.*tile_counts[i];
    }
    return sum;
  }
  void add(const ReducedBand& other) {
    bytes += other.bytes;
    keys += other.keys;
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
  }
  /// As a tile that has nothing else.
  TileSummary as_tile() const {
    TileSummary tile;
    for (std::size_t i = 0; i < counts.size(); ++i) tile.*tile_counts[i] = counts[i];
    return tile;
  }
};

/// Those of a path that come within `reach` of rows of tiles; whatever leaves the maze is near its outermost rows.
std::vector<NearLegs> legs_near(std::span<const Vec2> path, Range rows, const TileGrid& grid, double reach,
                                const Execution& execution) {
  std::vector<NearLegs> runs;
  if (rows.first == rows.last) return runs;
  constexpr double far = std::numeric_limits<double>::infinity();
  const double margin = reach + 1.0;  // a cell more than is asked for
  const auto y = [&](std::size_t row) { return static_cast<double>(row << grid.side_log2) + 0.5; };
  const double low = rows.first == 0 ? -far : y(rows.first) - margin;
  const double high = rows.last == grid.tile_rows ? far : y(rows.last) + margin;
  bool goes_on = false;
  for (std::size_t leg = 0; leg + 1 < path.size(); ++leg) {
    execution.poll(leg);
    const auto [least, most] = std::minmax({path[leg].y, path[leg + 1].y});
    const bool is_near = most >= low && least <= high;
    if (is_near && !goes_on) push_asked(runs, {leg, {path[leg]}}, execution);
    if (is_near) push_asked(runs.back().points, path[leg + 1], execution);
    goes_on = is_near;
  }
  return runs;
}

/// Edges that a rank's tiles and the row of tiles below them have to know.
std::vector<std::uint64_t> edges_near(std::span<const std::uint64_t> edges, Range rows, unsigned side_log2,
                                      const Execution& execution) {
  std::vector<std::uint64_t> near;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    execution.poll(i);
    const std::size_t row = maze::edge_row(edges[i]) >> side_log2;
    if (row + 1 >= rows.first && row < rows.last) push_asked(near, edges[i], execution);
  }
  return near;
}

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
    const Execution waiting{.deadline = &waiting_};
    for (;;) {
      const Bytes message = transport_.receive(0, waiting);
      ValueUnpacker from(message, "rank 0");
      const auto request = from.take<Request>();
      if (request == Request::end) return transport_.send_value(0, Reply::ended, waiting);
      if (execution_.progress != nullptr) execution_.progress->begin(name_of(request).data(), 0);
      transport_.send(0, answered(request, from), waiting);
    }
  }

 private:
  /// The answer, or why there is none. A message that comes meanwhile is the end; of what is short that is found
  /// afterwards.
  Bytes answered(Request request, ValueUnpacker& from) {
    using std::chrono::milliseconds;
    const bool is_short = request == Request::rounds && rounds_ && BandRounds::is_short(from);
    std::optional<Ticker> ticker;
    if (!is_short) {
      ticker.emplace(milliseconds(50), milliseconds(50), [this] {
        const int signal = outer_ != nullptr ? outer_->load() : 0;
        stop_.store(signal != 0 ? signal : transport_.has_message(0) ? SIGTERM : 0);
      });
    }
    ValuePacker packer;
    const auto instead = [&](Reply reply) -> ValuePacker& {
      packer = ValuePacker();
      packer.add(reply);
      return packer;
    };
    try {
      const auto stopped = stopped_by([&] {
        packer.add(Reply::done);
        work(request, from, packer);
      });
      if (stopped) instead(Reply::stopped).add(*stopped);
    } catch (const Error& error) {
      instead(Reply::refused).add_text(error.what());
    }
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
        ends_.start.links = from.take_list<EndLink>();
        ends_.goal.links = from.take_list<EndLink>();
        tiles_ = band_.reduce(ends_, from.take<BandPeeling>(), execution_);
        return to.add(ReducedBand::of(tiles_));
      case Request::hand_over:
        return hand_over(to);
      case Request::rounds:
        if (!rounds_) rounds_ = band_rounds(band_.grid(), band_.rows(), ends_, std::move(tiles_), execution_);
        return rounds_->serve(from, to);
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
  void read(ValueUnpacker& from, ValuePacker& to) const {
    const auto number = from.take<std::size_t>();
    if (number < band_.tiles().first || number >= band_.tiles().last) throw InputError("tile", "is of another rank");
    CellTile tile;
    band_.walls(from.take<WallsFor>()).reader()->read(number, tile);
    to.add(std::array{tile.first_col, tile.first_row, tile.width, tile.height});
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
  std::unique_ptr<BandRounds> rounds_;
};

/// The whole maze as rank 0 sees it: its own tiles are made here, others by their ranks, when they are asked for. For
/// the few tiles that no rank's share is about: those around start and goal; and for those of two components that are
/// apart. Refers to all that it is given, which must outlive it.
class RemoteCells : public CellWallSource {
 public:
  RemoteCells(const Band& band, Requests& requests, const OneAtATime& asking, WallsFor who)
      : CellWallSource(band.grid().rows, band.grid().cols, band.grid().side_log2),
        band_(band),
        requests_(requests),
        asking_(asking),
        who_(who) {}
  std::unique_ptr<CellWallReader> reader() const override { return std::make_unique<Reader>(*this); }

 private:
  class Reader : public CellWallReader {
   public:
    explicit Reader(const RemoteCells& cells) : cells_(cells) {
      if (!cells.band_.is_empty()) own_ = cells.band_.walls(cells.who_).reader();
    }
    void read(std::size_t number, CellTile& tile) override {
      const Range own = cells_.band_.tiles();
      if (number >= own.first && number < own.last) return own_->read(number, tile);
      tile = cells_.asked(number);
    }

   private:
    const RemoteCells& cells_;
    std::unique_ptr<CellWallReader> own_;
  };
  /// A tile of another rank. Any thread.
  CellTile asked(std::size_t number) const {
    const unsigned rank = rank_of_row(number / band_.grid().tile_cols, band_.grid().tile_rows, requests_.ranks());
    return asking_([&] {
      ValuePacker packer;
      packer.add(number);
      packer.add(who_);
      requests_.ask_one(rank, Request::read, packer.bytes());
      const Bytes bytes = requests_.answer(rank);
      ValueUnpacker from(bytes, fmt::format("rank {}", rank));
      const auto [col, row, width, height] = from.take<std::array<std::uint32_t, 4>>();
      CellTile tile{col, row, width, height, from.take_list<std::uint8_t>()};
      if (tile.walls.size() != (std::size_t{tile.width} + 1) * (std::size_t{tile.height} + 1)) from.refuse();
      return tile;
    });
  }

  const Band& band_;
  Requests& requests_;
  const OneAtATime& asking_;
  const WallsFor who_;
};

class LeaderOfRanks : public Leader, private OtherTiles, private JudgesElsewhere {
 public:
  LeaderOfRanks(Transport& transport, const BandTask& task, const Execution& execution, std::uint64_t most_keys)
      : requests_(transport, execution),
        task_(task),
        most_keys_(most_keys),
        band_(task, band_rows(task.grid().tile_rows, 0, transport.ranks())),
        planned_(band_, requests_, asking_, WallsFor::planner),
        judged_(band_, requests_, asking_, WallsFor::judge) {}

  std::unique_ptr<StreamedWalls> make(const Execution& execution) override {
    requests_.wait_as(execution);
    requests_.ask_each(Request::make, [](unsigned, ValuePacker&) {});
    std::vector<maze::RimPart> rims;
    if (auto own = band_.make(execution)) rims.push_back(std::move(*own));
    if (band_.read() != nullptr) known_ = KnownWalls::of(*band_.read());
    requests_.take_each([&](unsigned rank, ValueUnpacker from) {
      if (from.is_done()) return;
      if (task_.unmade.packed) {
        learn(KnownWalls::unpack(from), rank);
      } else {
        rims.push_back(maze::RimPart::unpack(from));
      }
    });
    if (!task_.unmade.packed) join_trees(std::move(rims), execution);
    return std::make_unique<Walls>(*this);
  }
  OtherTiles& tiles() override { return *this; }
  JudgesElsewhere& judges() override { return *this; }
  std::optional<SearchLack> lack() const override { return lack_; }
  const std::array<std::uint64_t, request_count>& traffic() const override { return requests_.traffic(); }

 private:
  class Walls : public StreamedWalls {
   public:
    explicit Walls(const LeaderOfRanks& leader) : leader_(leader) {}
    const CellWallSource& planned() const override { return leader_.planned_; }
    const CellWallSource& judged() const override { return leader_.judged_; }
    std::optional<std::size_t> wall_count() const override {
      return leader_.known_.hash.empty() ? std::nullopt : std::optional<std::size_t>(leader_.known_.count);
    }
    std::optional<std::string> hash() const override {
      return leader_.known_.hash.empty() ? std::nullopt : std::optional(leader_.known_.hash);
    }

   private:
    const LeaderOfRanks& leader_;
  };
  /// All bands' tiles: those of this rank, what they are in sum, and what handing them over takes.
  struct Reduced {
    std::vector<TileSummary> own;
    ReducedBand all;
    std::size_t bytes_to_come;
  };

  void learn(const KnownWalls& theirs, unsigned rank) {
    if (known_.hash.empty()) known_ = theirs;
    if (known_ == theirs) return;
    throw InputError(fmt::format("rank {}", rank), "sees another file than a lower rank: its walls have another hash",
                     fmt::format("{}, not {}", theirs.hash, known_.hash));
  }
  void join_trees(std::vector<maze::RimPart> rims, const Execution& execution) {
    constexpr std::size_t most_on_sides = std::numeric_limits<std::uint32_t>::max();
    std::size_t edges = 0;
    std::size_t on_sides = 0;  // cells
    for (const maze::RimPart& rim : rims) {
      edges += rim.edges.size() + rim.at.width;
      on_sides += 2 * (std::size_t{rim.at.width} + rim.at.height);
    }
    if (on_sides >= most_on_sides) {
      throw InputError("maze",
                       fmt::format("has 2^32 cells or more on the sides of {} bands; take fewer ranks", rims.size()));
    }
    execution.reserve(edges * 64 + on_sides * 2 * sizeof(std::uint32_t));
    const maze::JoinedParts joined = join_parts(task_.unmade.formula->seed, rims, 1, band_.grid().side_log2, execution);
    const auto near = [&](unsigned rank) {
      return edges_near(joined.turned, band_rows(tile_rows(), rank, requests_.ranks()), band_.grid().side_log2,
                        execution);
    };
    if (!band_.is_empty()) band_.turn(near(0));
    requests_.ask_each(Request::turn, [&](unsigned rank, ValuePacker& to) { to.add_list(near(rank)); });
    requests_.take_each([](unsigned, const ValueUnpacker&) {});
  }
  /// Each reduces its tiles, and keeps them. own: those of this rank.
  Reduced reduce_bands(const OverlayEnds& ends, BandPeeling peeling, const Execution& execution) {
    requests_.ask_each(Request::reduce, [&](unsigned, ValuePacker& to) {
      to.add_list(ends.start.links);
      to.add_list(ends.goal.links);
      to.add(peeling);
    });
    Reduced reduced{band_.reduce(ends, peeling, execution), {}, 0};
    reduced.all = ReducedBand::of(reduced.own);
    std::size_t largest = 0;
    requests_.take_each([&](unsigned, ValueUnpacker from) {
      const auto band = from.take<ReducedBand>();
      largest = std::max<std::size_t>(largest, band.bytes);
      reduced.bytes_to_come += band.bytes;
      reduced.all.add(band);
    });
    reduced.bytes_to_come += 2 * largest;
    return reduced;
  }
  /// Room for all is asked for before the first comes.
  std::vector<TileSummary> reduce_all(const OverlayEnds& ends, const Execution& execution) override {
    Reduced reduced = reduce_bands(ends, BandPeeling::band, execution);
    const auto reserve = [&] { execution.reserve(reduced.bytes_to_come + reduced.all.keys * bytes_of_key); };
    if (reduced.all.keys <= most_keys_ && memory_holds(reserve)) return hand_over(std::move(reduced.own), execution);
    if (!reduced.own.empty()) {
      rounds_ = band_rounds(band_.grid(), band_.rows(), ends, std::move(reduced.own), execution);
    }
    searches_ = true;
    return {reduced.all.as_tile()};
  }
  std::vector<TileSummary> reduce_whole(const OverlayEnds& ends, const Execution& execution) override {
    Reduced reduced = reduce_bands(ends, BandPeeling::none, execution);
    execution.reserve(reduced.bytes_to_come);
    return hand_over(std::move(reduced.own), execution);
  }
  /// tiles: those of this rank.
  std::vector<TileSummary> hand_over(std::vector<TileSummary> tiles, const Execution& execution) {
    tiles.reserve(band_.grid().count());
    for (unsigned rank = 1; rank < requests_.ranks(); ++rank) {
      execution.check();
      requests_.ask_one(rank, Request::hand_over, {});
      const Bytes bytes = requests_.answer(rank);
      ValueUnpacker from(bytes, fmt::format("rank {}", rank));
      while (!from.is_done()) tiles.push_back(unpack_summary(from, band_.grid().side()));
    }
    if (tiles.size() != band_.grid().count()) throw InputError("ranks", "do not have all tiles between them");
    return tiles;
  }
  bool searches() const override { return searches_; }
  ToldRoute search(const OverlayEnds& ends, const Execution& execution) override {
    ToldRoute route = search_over_ranks(requests_, rounds_.get(), band_.grid(), ends, execution, lack_);
    rounds_.reset();
    return route;
  }
  std::vector<std::vector<std::uint8_t>> steps_of(std::span<const TileChain> chains,
                                                  const Execution& execution) override {
    std::vector<std::vector<std::size_t>> of_rank(requests_.ranks());
    for (std::size_t i = 0; i < chains.size(); ++i) {
      of_rank[rank_of_row(chains[i].tile / band_.grid().tile_cols, tile_rows(), requests_.ranks())].push_back(i);
    }
    requests_.ask_each(Request::steps, [&](unsigned rank, ValuePacker& to) {
      std::vector<TileChain> own;
      for (const std::size_t i : of_rank[rank]) own.push_back(chains[i]);
      to.add_list(own);
    });
    std::vector<std::vector<std::uint8_t>> steps = band_.steps_of(chains, execution);
    requests_.take_each([&](unsigned rank, ValueUnpacker from) {
      for (const std::size_t i : of_rank[rank]) {
        steps[i] = from.take_list<std::uint8_t>();
        if (steps[i].size() != chains[i].length) from.refuse();
      }
    });
    return steps;
  }
  Range own_tiles() const override { return band_.tiles(); }
  void begin(std::span<const Vec2> path, double reach) override {
    requests_.ask_each(Request::judge, [&](unsigned rank, ValuePacker& to) {
      to.add(reach);
      for (const NearLegs& run : legs_near(path, band_rows(tile_rows(), rank, requests_.ranks()), band_.grid(), reach,
                                           requests_.waits_as())) {
        to.add(run.first);
        to.add_list(run.points);
      }
    });
  }
  std::vector<NearestWalls> take() override {
    std::vector<NearestWalls> found;
    requests_.take_each([&](unsigned, ValueUnpacker from) { found.push_back(from.take<NearestWalls>()); });
    return found;
  }
  std::size_t tile_rows() const { return band_.grid().tile_rows; }

  Requests requests_;
  const BandTask task_;
  const std::uint64_t most_keys_;
  Band band_;
  OneAtATime asking_;
  const RemoteCells planned_;
  const RemoteCells judged_;
  KnownWalls known_;  // of a file
  std::unique_ptr<BandRounds> rounds_;
  bool searches_ = false;  // all ranks do
  std::optional<SearchLack> lack_;
};

}  // namespace

std::unique_ptr<Leader> leader_of(Transport& transport, const BandTask& task, const Execution& execution,
                                  std::uint64_t most_keys) {
  return std::make_unique<LeaderOfRanks>(transport, task, execution, most_keys);
}

void follow(Transport& transport, const BandTask& task, const FollowerLimits& limits) {
  Follower(transport, task, limits).run();
}

}  // namespace warren::distributed
