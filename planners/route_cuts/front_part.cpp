// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/front_part.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "planners/route_cuts/min_plus.hpp"

namespace warren {

void FrontPart::add(GateRank first, std::uint32_t gates, std::span<const GateRank> bounds, const FrontMatrix& matrix) {
  fronts_.push_back({bounds_.size(), add_lengths(gates, matrix), add_ways(first, gates, matrix), first, gates,
                     static_cast<std::uint32_t>(bounds.size()), no_front});
  bounds_.insert(bounds_.end(), bounds.begin(), bounds.end());
}

/// In two bytes each where all fit; returns Front::rows.
std::uint64_t FrontPart::add_lengths(std::uint32_t gates, const FrontMatrix& matrix) {
  bool fits = true;
  for (std::size_t i = 0; i < gates; ++i) {
    fits = fits && std::all_of(matrix.row(i) + 1, matrix.row(i) + (matrix.size() - i),
                               [](std::uint32_t length) { return length < no_short_way || length == no_way; });
  }
  const std::uint64_t rows = fits ? 2 * short_lengths_.size() + 1 : 2 * lengths_.size();
  for (std::size_t i = 0; i < gates; ++i) {
    const std::uint32_t* const first = matrix.row(i) + 1;
    const std::uint32_t* const last = matrix.row(i) + (matrix.size() - i);
    if (fits) {
      std::transform(first, last, std::back_inserter(short_lengths_), [](std::uint32_t length) {
        return length == no_way ? no_short_way : static_cast<std::uint16_t>(length);
      });
    } else {
      lengths_.insert(lengths_.end(), first, last);
    }
  }
  return rows;
}

/// In as few bits as the largest one needs; returns Front::ways.
std::uint64_t FrontPart::add_ways(GateRank first, std::uint32_t gates, const FrontMatrix& matrix) {
  const auto for_each_way = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < gates; ++i) {
      const WayBy* const by = matrix.by(i);
      for (std::size_t j = 1; j < matrix.size() - i; ++j) {
        if (matrix.row(i)[j] >= no_way) {
          visit(0);
        } else {
          visit((by[j] & hop_bit) != 0 ? 2 * matrix.hop(by[j]) + 1 : 2 * std::uint64_t{first + i - by[j]});
        }
      }
    }
  };
  std::uint64_t all = 0;
  for_each_way([&](std::uint64_t way) { all |= way; });
  const unsigned width = unsigned{all >> 16U != 0} + unsigned{all >> 32U != 0};
  const std::uint64_t ways = 4 * ways_.size() + width;
  for_each_way([&](std::uint64_t way) {
    for (unsigned left = 1U << width; left > 0; --left, way >>= 16U) {
      ways_.push_back(static_cast<std::uint16_t>(way & 0xffffU));
    }
  });
  return ways;
}

void FrontPart::reserve_for(std::span<const FrontPart> parts, const Execution& execution) {
  std::size_t shorts = 0;
  std::size_t ways = 0;
  for (const FrontPart& part : parts) {
    shorts += part.short_lengths_.size();
    ways += part.ways_.size();
  }
  execution.reserve((shorts + ways) * sizeof(std::uint16_t) * 3 / 2);
  short_lengths_.reserve(shorts * 3 / 2);
  ways_.reserve(ways * 3 / 2);
}

void FrontPart::append(const FrontPart& next) {
  for (Front front : next.fronts_) {
    front.first_bound += bounds_.size();
    front.rows += 2 * (front.is_short() ? short_lengths_.size() : lengths_.size());
    front.ways += 4 * ways_.size();
    fronts_.push_back(front);
  }
  bounds_.insert(bounds_.end(), next.bounds_.begin(), next.bounds_.end());
  lengths_.insert(lengths_.end(), next.lengths_.begin(), next.lengths_.end());
  short_lengths_.insert(short_lengths_.end(), next.short_lengths_.begin(), next.short_lengths_.end());
  ways_.insert(ways_.end(), next.ways_.begin(), next.ways_.end());
}

void FrontPart::link() {
  for (Front& front : fronts_) {
    if (front.bounds == 0) continue;
    const GateRank lowest = bounds_[front.first_bound];
    const auto after = std::upper_bound(fronts_.begin(), fronts_.end(), lowest,
                                        [](GateRank rank, const Front& f) { return rank < f.first; });
    front.parent = static_cast<FrontId>(after - fronts_.begin() - 1);
  }
}

FrontArrays FrontPart::arrays(RawVector<LatticePlace> gate_place) {
  return {ArrayOrView<Front>(std::move(fronts_)),          ArrayOrView<GateRank>(std::move(bounds_)),
          ArrayOrView<std::uint32_t>(std::move(lengths_)), ArrayOrView<std::uint16_t>(std::move(short_lengths_)),
          ArrayOrView<std::uint16_t>(std::move(ways_)),    ArrayOrView<LatticePlace>(std::move(gate_place))};
}

}  // namespace warren
