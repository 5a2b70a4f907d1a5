// SPDX-License-Identifier: BSD-3-Clause
// Where finished parts of a long work are kept, so that a later run of the same work goes on from them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/packed_values.hpp"

namespace warren {

enum class PartKind : std::uint32_t { maze_group = 1, tiles = 2 };

/// Any number of threads may call find() and keep() at once.
class KeptParts {
 public:
  KeptParts() = default;
  virtual ~KeptParts() = default;
  KeptParts(const KeptParts&) = delete;
  KeptParts& operator=(const KeptParts&) = delete;
  /// Before all else: what the work is, word for word all that its parts depend on. Throws InputError where parts of
  /// another work are kept.
  virtual void begin(std::string_view work) = 0;
  /// The bytes of a part, if an earlier run has kept it. Throws InputError where they are damaged.
  virtual std::optional<Bytes> find(PartKind kind, std::uint64_t number) = 0;
  /// Of a part that was not found.
  virtual void keep(PartKind kind, std::uint64_t number, std::span<const std::byte> bytes) = 0;
};

}  // namespace warren
