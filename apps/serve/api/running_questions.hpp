// SPDX-License-Identifier: BSD-3-Clause
// Questions that are being answered, by the names that their askers gave them, and each better path of planners that
// get better with time: whoever waits for the answer sees what there is already.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "parallel/once.hpp"

namespace warren::serve {

/// Any number of threads may use it.
class RunningQuestions {
 public:
  /// A question that is named while this lives. Under a name that is taken, or "", nothing is seen of it.
  class Entry {
   public:
    Entry(RunningQuestions& all, std::string name);
    ~Entry();
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    bool is_seen() const { return is_seen_; }
    /// Keeps what came last, up to most_told; of ways of more than most_points the points are left out.
    void tell(const Improvement& improvement, std::vector<Vec2> way);

   private:
    RunningQuestions& all_;
    std::string name_;
    bool is_seen_;
  };

  static constexpr std::size_t most_told = 64;
  static constexpr std::size_t most_points = 2000;
  static constexpr std::size_t most_points_told = 4000;  ///< at once, but for the last way's

  /// Is a question of this name running, and what came from its from-th improvement on, or some of it; as JSON.
  std::string told(const std::string& name, std::uint64_t from) const;

 private:
  struct Told {
    Improvement improvement;
    std::vector<Vec2> way;  ///< of the reference point
  };
  struct Question {
    std::uint64_t first = 0;  ///< the number of the first that is kept
    std::deque<Told> told = {};
  };
  Guarded<std::map<std::string, Question>> questions_;
};

}  // namespace warren::serve
