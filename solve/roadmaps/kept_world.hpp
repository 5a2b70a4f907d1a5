// SPDX-License-Identifier: BSD-3-Clause
// The world of a roadmap. Whoever asks a lattice in a file for a length needs none of its walls, and making those of
// 10^8 cells takes a second and 1.6 GB: there they are made when a judge, an end off the lattice or a picture first
// needs them.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "parallel/execution.hpp"
#include "parallel/made_once.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Moves leave references to scenes valid only where the whole was made later. Any number of threads may ask.
class KeptWorld {
 public:
  using Make = std::function<Scene(const Execution&)>;

  KeptWorld() = default;
  explicit KeptWorld(Scene whole) : outline_(std::move(whole)) {}
  /// `outline`: all but the walls; make() gives the whole, or throws what whole() shall.
  KeptWorld(Scene outline, Make make)
      : outline_(std::move(outline)), later_(std::make_unique<Later>(std::move(make))) {}

  /// Name, maze, bounds, body and what else a world says in a few words; its walls may be missing.
  const Scene& outline() const { return outline_; }
  /// Throws InputError for a world that is not what its file promises, Stopped; the next call then tries again.
  const Scene& whole(const Execution& execution) const {
    if (later_ == nullptr) return outline_;
    return later_->whole.get(execution, [&] { return std::make_unique<Scene>(later_->make(execution)); });
  }

 private:
  struct Later {
    explicit Later(Make how) : make(std::move(how)) {}
    Make make;
    MadeOnce<Scene> whole;
  };
  Scene outline_;
  std::unique_ptr<Later> later_;  // nullptr: the outline is the whole
};

}  // namespace warren
