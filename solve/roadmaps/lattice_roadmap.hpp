// SPDX-License-Identifier: BSD-3-Clause
// The roadmap of a maze's lattice, held as a route index (planners/route_index) instead of states and edges: two bits a
// cell for its edges, and about one byte a cell by which any question is answered exactly without a search.
//
// Ends are joined to the lattice as solve() joins them: to the milestones within a step that they reach freely, and
// where there is none to the nearest of the 256 nearest that they do. An end on a milestone that has an edge needs no
// look at the walls; others have one (solve/roadmaps/walls_near_ends), and the walls of a file are made first.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/solution.hpp"
#include "planners/route_index/route_index.hpp"
#include "planners/route_index/route_query.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "solve/roadmaps/walls_near_ends.hpp"

namespace warren {

/// where_it_pays ("auto"): of large lattices that are no open space; none: never.
enum class IndexChoice : std::uint8_t { where_it_pays, none };
constexpr auto enum_names(IndexChoice) { return std::array<std::string_view, 2>{"auto", "none"}; }

/// Lattices below are searched in less time than a person notices, and their roadmap is one that all can read.
inline constexpr std::uint64_t fewest_indexed_cells = 65'536;

/// The index of a maze whose lattice is the roadmap, where that is to be had: nullptr for other worlds and options, for
/// small lattices, and where the index doesn't pay. Throws InputError, Stopped.
std::unique_ptr<RouteIndex> lattice_index(const Scene& scene, const Question& body, const SolveOptions& options,
                                          const Execution& execution);

/// The cell whose milestone stands at p and has an edge.
std::optional<CellId> lattice_cell(const RouteIndex& index, Vec2 p);

/// The shortest way over the lattice between any two places.
class LatticeQuestion {
 public:
  /// `query`: of the index. All are referred to. Throws Stopped.
  LatticeQuestion(const WallsNearEnds& near, const WallProblem& problem, const RouteIndex& index, RouteQuery& query,
                  const Execution& execution);

  Outcome outcome() const { return outcome_; }
  /// Only for solved.
  double length() const { return length_; }
  /// Start, cells, goal.
  Path<Vec2> path() const;
  std::uint64_t links() const { return links_[0].size() + links_[1].size(); }

 private:
  struct Link {
    CellId cell;
    double length;
  };
  bool link(std::size_t end, Vec2 p);
  bool link_among(const MazeWorld& world, std::size_t end, Vec2 p);
  void join();

  const WallsNearEnds& near_;
  const WallProblem& problem_;
  const RouteIndex& index_;
  RouteQuery& query_;
  const Execution& execution_;
  std::vector<Link> links_[2];
  Outcome outcome_ = Outcome::not_connected;
  double length_ = 0.0;
  bool direct_ = false;
  CellId from_ = 0;
  CellId to_ = 0;
};

}  // namespace warren
