// SPDX-License-Identifier: BSD-3-Clause
// The world of a roadmap. Whoever asks a lattice in a file for a length needs none of its walls, and making those of
// 10^8 cells takes a second and 1.6 GB: there they are made when a picture or an explanation first needs them. A judge
// and ends off the lattice look them up one by one, where bits say them.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "parallel/execution.hpp"
#include "parallel/made_once.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/roadmaps/kept_cells.hpp"

namespace warren {

/// Moves leave references to scenes valid only where the whole was made later. Any number of threads may ask.
class KeptWorld {
 public:
  using Make = std::function<Scene(const Execution&)>;
  using LookUp = std::function<std::unique_ptr<KeptCells>(const Execution&)>;

  KeptWorld() = default;
  explicit KeptWorld(Scene whole) : outline_(std::move(whole)) {}
  /// `outline`: all but the walls; make() gives the whole, or throws what whole() shall.
  /// look_up: what looked_up() shall give, or nothing.
  KeptWorld(Scene outline, Make make, LookUp look_up = {})
      : outline_(std::move(outline)), later_(std::make_unique<Later>(std::move(make), std::move(look_up))) {}

  /// Name, maze, bounds, body and what else a world says in a few words; its walls may be missing.
  const Scene& outline() const { return outline_; }
  /// Throws InputError for a world that is not what its file promises, Stopped; the next call then tries again.
  const Scene& whole(const Execution& execution) const {
    if (later_ == nullptr) return outline_;
    return later_->whole.get(execution, [&] { return std::make_unique<Scene>(later_->make(execution)); });
  }
  /// The same, which nobody keeps: for what is seldom asked. Throws as whole() does.
  Scene copy_of_whole(const Execution& execution) const {
    return later_ == nullptr ? outline_ : later_->make(execution);
  }
  /// Can its walls be looked up without being made?
  bool is_looked_up() const { return later_ != nullptr && later_->look_up; }
  /// Its walls as they can be looked up without being made, which are all that there is; nullptr: they can't be. Throws
  /// as whole() does.
  const KeptCells* looked_up(const Execution& execution) const {
    if (!is_looked_up()) return nullptr;
    return &later_->cells.get(execution, [&] { return later_->look_up(execution); });
  }

 private:
  struct Later {
    Later(Make how, LookUp look) : make(std::move(how)), look_up(std::move(look)) {}
    Make make;
    LookUp look_up;
    MadeOnce<Scene> whole;
    MadeOnce<KeptCells> cells;
  };
  Scene outline_;
  std::unique_ptr<Later> later_;  // nullptr: the outline is the whole
};

}  // namespace warren
