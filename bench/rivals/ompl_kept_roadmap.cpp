// SPDX-License-Identifier: BSD-3-Clause
// A roadmap that is built once and asked often: a maze with 10 % loops, uniform milestones, questions between random
// ones of them. All contestants have the same milestones and edges:
//   warren, index        RoadmapQuery by the contraction hierarchy: attached, asked, verified
//   warren, search       the whole question without the index
//   Boost's A*           Boost.Graph's astar_search from milestone to milestone, over rows with their lengths; no
//                        attaching, no verification
//   OMPL's PRM           the milestones and edges handed to og::PRM; a question is clearQuery() and solve(), whose
//   second
//                        thread polls every millisecond while the first one grows the roadmap further
//   its A* alone         start and goal as milestones, constructSolution(), as solve() does once
//   overlay search       prm by tiles (planners/mazes), which keeps nothing and builds its overlay for each question
// CPU time of the process, all threads of it. Lengths are compared with Boost's; OMPL joins start and goal to
// more.
//   rival_ompl_kept_roadmap [SIDE [SAMPLES [QUESTIONS]]]
#include <ompl/util/Console.h>

#include <algorithm>
#include <boost/graph/astar_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/rivals/ompl_prm.hpp"
#include "core/base/rng.hpp"
#include "planners/roadmap/prm.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/kept/roadmap_query.hpp"

namespace warren {
namespace {

constexpr double clearance = 0.1;

struct Asked {
  Vec2 start;
  Vec2 goal;
  VertexId from;
  VertexId to;
};

Vec2 place(const Roadmap& roadmap, VertexId v) {
  const auto state = roadmap.arrays.parts().state(v);
  return {state[0], state[1]};
}

std::vector<Asked> questions_of(const Roadmap& roadmap, int count) {
  SequentialRng rng(7);
  std::vector<Asked> questions;
  const auto any = [&] { return static_cast<VertexId>(rng.below(count_states(roadmap))); };
  while (static_cast<int>(questions.size()) < count) {
    const VertexId from = any();
    const VertexId to = any();
    if (roadmap.arrays.component[from] != roadmap.arrays.component[to]) continue;
    questions.push_back({place(roadmap, from), place(roadmap, to), from, to});
  }
  return questions;
}

struct Weight {
  double length;
};
using BoostGraph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Weight, boost::no_property,
                                                      std::uint32_t, std::uint32_t>;
struct Found {};
struct StopAt : boost::default_astar_visitor {
  std::uint32_t goal;
  explicit StopAt(std::uint32_t vertex) : goal(vertex) {}
  void examine_vertex(std::uint32_t v, const BoostGraph&) const {
    if (v == goal) throw Found();
  }
};
struct Estimate : boost::astar_heuristic<BoostGraph, double> {
  const Roadmap* roadmap;
  Vec2 goal;
  Estimate(const Roadmap& all, Vec2 to) : roadmap(&all), goal(to) {}
  double operator()(std::uint32_t v) const { return distance(place(*roadmap, v), goal); }
};

class BoostSearch {
 public:
  explicit BoostSearch(const Roadmap& roadmap) : roadmap_(roadmap), parent_(count_states(roadmap)) {
    const RoadmapParts parts = roadmap.arrays.parts();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
    std::vector<Weight> weights;
    for (VertexId v = 0; v < parts.vertex_count(); ++v) {
      for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
        if (parts.state_of_end(end) != EdgeState::free) continue;
        ends.emplace_back(v, parts.to[end]);
        weights.push_back({distance(place(roadmap, v), place(roadmap, parts.to[end]))});
      }
    }
    graph_ = BoostGraph(boost::edges_are_sorted, ends.begin(), ends.end(), weights.begin(),
                        static_cast<std::uint32_t>(parts.vertex_count()));
    for (auto* values : {&g_, &f_}) values->resize(parent_.size());
    color_.resize(parent_.size());
  }
  double length(const Asked& asked) {
    const auto index = get(boost::vertex_index, graph_);
    const auto map = [&](auto& values) { return boost::make_iterator_property_map(values.begin(), index); };
    try {
      boost::astar_search(graph_, asked.from, Estimate(roadmap_, asked.goal),
                          boost::weight_map(get(&Weight::length, graph_))
                              .distance_map(map(g_))
                              .rank_map(map(f_))
                              .predecessor_map(map(parent_))
                              .color_map(map(color_))
                              .visitor(StopAt(asked.to)));
    } catch (const Found&) {
      return g_[asked.to];
    }
    throw std::runtime_error("Boost's A*: no path");
  }

 private:
  const Roadmap& roadmap_;
  BoostGraph graph_;
  std::vector<double> g_;
  std::vector<double> f_;
  std::vector<std::uint32_t> parent_;
  std::vector<boost::default_color_type> color_;
};

/// og::PRM with the roadmap's own milestones and edges; what comes later is joined within the radius.
class GivenPrm : public ompl::geometric::PRM {
 public:
  GivenPrm(const ompl::base::SpaceInformationPtr& space, const Roadmap& roadmap)
      : ompl::geometric::PRM(space), roadmap_(roadmap) {
    setProblemDefinition(ompl_prm::make_problem(space, place(roadmap, 0), place(roadmap, 0)));
    setConnectionStrategy([this](Vertex v) -> const std::vector<Vertex>& { return neighbours(v); });
    setup();
    for (VertexId v = 0; v < count_states(roadmap); ++v) addMilestone(ompl_prm::make_state(space, place(roadmap, v)));
  }
  double solve_after_clear(const Asked& asked) {
    clearQuery();
    const auto problem = ompl_prm::make_problem(si_, asked.start, asked.goal);
    setProblemDefinition(problem);
    PRM::solve(ompl::base::timedPlannerTerminationCondition(60.0));
    return problem->getSolutionPath() ? problem->getSolutionPath()->length() : std::nan("");
  }
  double search_alone(const Asked& asked) {
    const Vertex from = addMilestone(ompl_prm::make_state(si_, asked.start));
    const Vertex to = addMilestone(ompl_prm::make_state(si_, asked.goal));
    const auto path = constructSolution(from, to);
    return path ? path->length() : std::nan("");
  }

 private:
  const std::vector<Vertex>& neighbours(Vertex v) {
    near_.clear();
    if (v >= count_states(roadmap_)) {
      nn_->nearestR(v, roadmap_.rule.radius, near_);
      return near_;
    }
    const RoadmapParts parts = roadmap_.arrays.parts();
    for (std::size_t end = parts.first[v]; end < parts.first[v + 1] && parts.to[end] < v; ++end) {
      if (parts.state_of_end(end) == EdgeState::free) near_.push_back(parts.to[end]);
    }
    return near_;
  }
  const Roadmap& roadmap_;
  std::vector<Vertex> near_;
};

CpuWall seconds_of(const std::function<void()>& work) {
  const Stopwatch watch;
  work();
  return watch.read();
}

/// Microseconds a question: median and the slowest of a hundred; how many lengths are Boost's.
void tell(const char* name, const std::vector<Asked>& questions, const std::vector<double>& lengths,
          const std::function<double(const Asked&)>& ask) {
  std::vector<double> times;
  int same = 0;
  int shorter = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    double length = 0.0;
    times.push_back(1e6 * seconds_of([&] { length = ask(questions[i]); }).cpu_s);
    same += std::abs(length - lengths[i]) <= 1e-9 * lengths[i] ? 1 : 0;
    shorter += length < lengths[i] * (1.0 - 1e-9) ? 1 : 0;
  }
  std::sort(times.begin(), times.end());
  std::printf("%-16s %12.1f %12.1f %8d %8d of %zu\n", name, times[times.size() / 2], times[times.size() * 99 / 100],
              same, shorter, times.size());
  std::fflush(stdout);
}

void compare(std::uint32_t side, std::uint64_t samples, int count) {
  MazeOptions maze{side, side, 1};
  maze.loops = 0.1;
  SolveOptions options{.planner = PlannerKind::prm, .sampler = SamplerKind::uniform};
  options.roadmap.samples = samples;
  Roadmap plain;
  Roadmap roadmap;
  const auto built = [&](IndexChoice index) { return build(maze_scene(maze, false, {}), {}, options, {}, index); };
  std::printf("build            %8.2f s\n", seconds_of([&] { plain = built(IndexChoice::none); }).cpu_s);
  const double with_index = seconds_of([&] { roadmap = built(IndexChoice::where_it_pays); }).cpu_s;
  std::printf("build, index     %8.2f s, %zu edges, %zu arcs\n", with_index,
              static_cast<std::size_t>(count_edges(roadmap, {}).free), roadmap.arrays.hierarchy.arcs.size());
  const MazeWorld world(roadmap.world.whole({}), clearance, {});
  const std::vector<Asked> questions = questions_of(roadmap, count);
  std::vector<Asked> few(questions.begin(), questions.begin() + std::min(count, 20));
  BoostSearch boost_search(roadmap);
  std::vector<double> lengths;
  for (const Asked& asked : questions) lengths.push_back(boost_search.length(asked));
  const RoadmapQuery query(roadmap);
  QuestionScratch scratch;
  const Execution one{.threads = 1};
  const auto by = [&](const RoadmapSearchFields& how) {
    return [&, how](const Asked& a) {
      return query.ask_within({a.start.x, a.start.y}, {a.goal.x, a.goal.y}, how, one, scratch).length;
    };
  };
  std::printf("%-16s %12s %12s %8s %8s\n", "microseconds", "median", "99 %", "same", "shorter");
  tell("warren, index", questions, lengths, by({}));
  tell("warren, search", questions, lengths, by({.search = SearchMethod::astar}));
  tell("Boost's A*", questions, lengths, [&](const Asked& asked) { return boost_search.length(asked); });
  RoadmapOptions plain_options;
  plain_options.samples = samples;
  tell("prm anew", few, lengths, [&](const Asked& asked) {
    const Solution<Vec2> found = prm(WorldView(world), asked.start, asked.goal, plain_options, {});
    return path_length(found.path, [](Vec2 a, Vec2 b) { return distance(a, b); });
  });
  std::unique_ptr<GivenPrm> ompl_side;
  const auto space = ompl_prm::make_space(world);
  std::printf("OMPL's milestones %7.2f s\n",
              seconds_of([&] { ompl_side = std::make_unique<GivenPrm>(space, roadmap); }).cpu_s);
  tell("its A* alone", few, lengths, [&](const Asked& asked) { return ompl_side->search_alone(asked); });
  tell("OMPL's PRM", few, lengths, [&](const Asked& asked) { return ompl_side->solve_after_clear(asked); });
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  const int side = argc > 1 ? std::atoi(argv[1]) : 110;
  const int samples = argc > 2 ? std::atoi(argv[2]) : 100'000;
  const int questions = argc > 3 ? std::atoi(argv[3]) : 200;
  if (side < 2 || samples < 1 || questions < 1) {
    std::fprintf(stderr, "usage: rival_ompl_kept_roadmap [SIDE [SAMPLES [QUESTIONS]]]\n");
    return 2;
  }
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  warren::compare(static_cast<std::uint32_t>(side), static_cast<std::uint64_t>(samples), questions);
  return 0;
}
