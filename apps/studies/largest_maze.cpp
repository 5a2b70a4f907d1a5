// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/largest_maze.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"

namespace warren::studies {
namespace {

/// Directions 0 up, 1 right, 2 down, 3 left; d ^ 2 is the opposite one.
enum Direction : std::uint8_t { up, right, down, left };

constexpr std::uint8_t reached = 4;
constexpr int came_by_shift = 3;  ///< bits 3 and 4 of a reached cell's byte: the direction of the step into it
constexpr std::size_t poll_every = std::size_t{1} << 16;

class CellWalk {
 public:
  CellWalk(MazeCells& cells, const Execution& execution)
      : bytes_(cells.bytes()),
        steps_{1, cells.stride(), std::size_t{0} - 1, std::size_t{0} - cells.stride()},
        execution_(execution) {}

  bool reaches(std::size_t start, std::size_t goal) {
    std::vector<std::size_t> frontier{start};
    std::vector<std::size_t> next;
    bytes_[start] |= reached;
    for (std::size_t expanded = 0; !frontier.empty() && (bytes_[goal] & reached) == 0; std::swap(frontier, next)) {
      next.clear();
      for (const std::size_t i : frontier) {
        if (++expanded % poll_every == 0) execution_.check();
        expand(i, next);
      }
    }
    return (bytes_[goal] & reached) != 0;
  }
  RawVector<Direction> steps(std::size_t start, std::size_t goal) const {
    RawVector<Direction> steps;
    for (std::size_t i = goal; i != start;) {
      if (steps.size() % poll_every == 0) execution_.check();
      const auto came_by = static_cast<Direction>((bytes_[i] >> came_by_shift) & 3);
      push_asked(steps, came_by, execution_);
      i += steps_[came_by ^ 2];
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

 private:
  void expand(std::size_t i, std::vector<std::size_t>& next) {
    for (const Direction d : {up, right, down, left}) {
      const std::size_t to = i + steps_[d];
      if (d == left && i <= steps_[right]) continue;  // the first column has nothing there
      const std::uint8_t wall = d % 2 == 0 ? MazeCells::upper_wall : MazeCells::right_wall;
      if ((bytes_[d < down ? i : to] & wall) != 0 || (bytes_[to] & reached) != 0) continue;
      bytes_[to] = static_cast<std::uint8_t>(bytes_[to] | reached | (d << came_by_shift));
      next.push_back(to);
    }
  }

  std::span<std::uint8_t> bytes_;
  std::array<std::size_t, 4> steps_;  // from a cell's byte to its neighbours', those back modulo 2^64
  const Execution& execution_;
};

/// The side between two cells, as one sees it in walking through.
struct Gate {
  Vec2 left;
  Vec2 right;
};

constexpr std::array<Vec2, 4> ahead{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};

/// Where a walker stands who goes through the gates along the steps: in front of one of them. The last one is the goal.
struct Spot {
  std::size_t gate = 0;
  Vec2 cell{1.0, 1.0};
};

/// Left of a walker who faces in direction d is the direction before it.
Gate gate_at(const Spot& spot, const RawVector<Direction>& steps, Vec2 goal) {
  if (spot.gate == steps.size()) return {goal, goal};
  const Direction d = steps[spot.gate];
  const Vec2 middle = spot.cell + 0.5 * ahead[d];
  const Vec2 leftward = 0.5 * ahead[(d + 3) % 4];
  return {middle + leftward, middle - leftward};
}

Spot after(const Spot& spot, const RawVector<Direction>& steps) {
  if (spot.gate == steps.size()) return {spot.gate + 1, spot.cell};
  return {spot.gate + 1, spot.cell + ahead[steps[spot.gate]]};
}

/// One side's corner of the string, and whose gate's it is.
struct Corner {
  Vec2 at;
  Spot spot;
};

/// The taut string through the gates. Half-integer coordinates below 2^23 make every turn exact.
Path<Vec2> funnel(Vec2 start, const RawVector<Direction>& steps, Vec2 goal, const Execution& execution) {
  Path<Vec2> path{start};
  Corner left_end{start, {}};
  Corner right_end{start, {}};
  // False where the string bends round the other side's corner: the walk goes on after that corner's gate. inwards: the
  // sign of a turn from this side to the other one.
  const auto narrow = [&](Corner& own, Corner& other, double inwards, const Corner& next) {
    const Vec2 apex = path.back();
    const auto turn_from = [&](Vec2 corner) { return inwards * cross(corner - apex, next.at - apex); };
    if (turn_from(own.at) < 0.0) return true;
    const bool bends = apex != own.at && turn_from(other.at) > 0.0;
    if (bends) push_asked(path, other.at, execution);
    own = bends ? other : next;
    return !bends;
  };
  std::size_t gates_seen = 0;
  for (Spot at; at.gate <= steps.size(); at = after(at, steps)) {
    if (++gates_seen % poll_every == 0) execution.check();
    const Gate gate = gate_at(at, steps, goal);
    if (!narrow(right_end, left_end, 1.0, {gate.right, at}) || !narrow(left_end, right_end, -1.0, {gate.left, at}))
      at = left_end.spot;
  }
  if (path.back() != goal) push_asked(path, goal, execution);
  return path;
}

std::uint32_t extent(double cells) {
  return static_cast<std::uint32_t>(std::clamp(std::round(cells), 1.0, 4294967295.0));
}

class LargestSearch {
 public:
  LargestSearch(const LargestOptions& options, const Execution& execution,
                const std::function<void(std::string_view)>& note)
      : options_(options), execution_(execution), note_(note) {}

  LargestResult search() {
    try {
      probe();
      const std::uint32_t side = largest_side(options_.sizes, [&](std::uint32_t n) { return fits(n); });
      if (side > 0) confirm(side);
    } catch (const Stopped& stopped) {
      result_.signal = stopped.reason;
    }
    return std::move(result_);
  }

 private:
  /// The shape keeps the number of cells: rows * cols is about side * side.
  MazeOptions maze(std::uint32_t side, std::uint64_t seed) const {
    MazeOptions maze = options_.maze;
    const double lean = std::sqrt(options_.shape_rows / options_.shape_cols);
    maze.rows = extent(side * lean);
    maze.cols = extent(side / lean);
    maze.seed = seed;
    return maze;
  }
  /// What a cell takes, learned from a smaller maze: else the memory of a large first one could not be warmed, nor
  /// known to be too little.
  void probe() {
    constexpr std::uint32_t large = 2000;
    constexpr std::uint32_t enough = 500;
    if (options_.sizes.start > large)
      trial(maze(std::max(enough, options_.sizes.start / 10), options_.maze.seed), false);
  }
  bool fits(std::uint32_t side) {
    const auto ran = trial(maze(side, options_.maze.seed), false);
    if (!ran || !within_budget(*ran)) return false;
    result_.best = {*ran};
    return true;
  }
  void confirm(std::uint32_t side) {
    bool known = options_.seeds > 1;  // the first seed has run; with one seed it runs again, as the independent check
    while (side > 0 && !all_seeds_fit(side, known)) {
      side = side_below(options_.sizes, side);
      known = false;
    }
    result_.confirmed = side > 0;
  }
  bool all_seeds_fit(std::uint32_t side, bool first_is_known) {
    std::vector<MazeTrial> runs;
    if (first_is_known) runs = result_.best;
    while (runs.size() < options_.seeds) {
      const std::uint64_t seed = options_.maze.seed + runs.size();
      const auto ran = trial(maze(side, seed), runs.size() + 1 == options_.seeds);
      if (!ran || !within_budget(*ran)) {
        result_.best.clear();
        return false;
      }
      runs.push_back(*ran);
      result_.best = runs;
    }
    return true;
  }
  std::optional<MazeTrial> trial(const MazeOptions& maze, bool last) {
    if (!has_memory_for(maze)) return std::nullopt;
    std::optional<MazeTrial> tried;
    const bool fits = memory_holds([&] {
      double generate_s = 0.0;
      const Scene scene = generate_trial(maze, options_.planner, execution_, generate_s);
      tried = solve_trial(scene, maze, options_.question, options_.planner, options_.budget_s, execution_);
      MazeTrial& ran = *tried;
      ran.generate_s = generate_s;
      if (ran.outcome == Outcome::solved) bytes_a_cell_ = static_cast<double>(ran.peak_memory_bytes) / ran.cells();
      result_.trials.push_back(ran);
      say(ran);
      if (last && within_budget(ran) && !is_unmade(scene)) measure_bar(scene);
    });
    if (fits) return tried;
    result_.unbegun.push_back({maze.rows, maze.cols, execution_.deadline->memory_bytes()});
    note_(fmt::format("{:>6} x {:<6} too little memory to generate it", maze.rows, maze.cols));
    return std::nullopt;
  }
  bool has_memory_for(const MazeOptions& maze) {
    const double cells = static_cast<double>(maze.rows) * maze.cols;
    const auto expected = static_cast<std::size_t>(bytes_a_cell_ * cells);
    if (expected > execution_.deadline->memory_bytes()) {
      result_.unbegun.push_back({maze.rows, maze.cols, expected});
      note_(fmt::format("{:>6} x {:<6} not begun: it would need {}", maze.rows, maze.cols,
                        human_bytes(static_cast<double>(expected))));
      return false;
    }
    touch_memory(expected, result_.touch, execution_);
    return true;
  }
  bool within_budget(const MazeTrial& t) const { return t.verified && t.solve_s <= options_.budget_s; }
  /// On the maze that was just solved, while its walls are in memory.
  void measure_bar(const Scene& scene) {
    const auto begin = std::chrono::steady_clock::now();
    memory_holds([&] {  // or there is no bar
      const Path<Vec2> path = bfs_funnel(scene, execution_);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      result_.bar = HonestBar{seconds, path_length(path, [](Vec2 a, Vec2 b) { return distance(a, b); })};
    });
  }
  void say(const MazeTrial& t) const {
    const std::string_view verdict =
        t.outcome == Outcome::solved ? (within_budget(t) ? "within the budget" : "over the budget") : verdict_of(t);
    note_(fmt::format("{:>6} x {:<6} seed {}: {:>8}, {:>6.1f} ns a cell, {:>8}; {}", t.rows, t.cols, t.seed,
                      human_seconds(t.solve_s), t.solve_s * 1e9 / t.cells(),
                      human_bytes(static_cast<double>(t.peak_memory_bytes)), verdict));
  }

  const LargestOptions& options_;
  const Execution& execution_;
  const std::function<void(std::string_view)>& note_;
  LargestResult result_;
  double bytes_a_cell_ = 0.0;  // of the last run that came to its end
};

using Json = nlohmann::ordered_json;

void line(std::string& text, const Palette& palette, std::string_view name, const std::string& what) {
  text += fmt::format("  {}{}\n", palette.faint(fmt::format("{:<14}", name)), what);
}

/// The run of median solve_s (the upper one of two). best is not empty.
const MazeTrial& median_trial(const LargestResult& result) {
  std::vector<const MazeTrial*> runs;
  for (const MazeTrial& t : result.best) runs.push_back(&t);
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::ranges::nth_element(runs, middle, {}, &MazeTrial::solve_s);
  return **middle;
}

std::string headline(const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  if (result.best.empty()) {
    return result.signal
               ? palette.doubtful("interrupted") + " before a maze was solved within the budget\n"
               : palette.bad("none") + fmt::format(": no maze was solved within {}\n", human_seconds(options.budget_s));
  }
  const MazeTrial& best = result.best.front();
  const std::string size = palette.strong(fmt::format("{} x {}", best.rows, best.cols));
  if (!result.confirmed)
    return fmt::format("{} is the largest maze so far: {}\n", size, palette.doubtful("interrupted"));
  return fmt::format("{} is the largest maze {} within {}\n", size, palette.good("solved and verified"),
                     human_seconds(options.budget_s));
}

void add_best(std::string& text, const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  const MazeTrial& median = median_trial(result);
  const auto [fastest, slowest] = std::ranges::minmax_element(result.best, {}, &MazeTrial::solve_s);
  const double loops = options.maze.loops;
  line(text, palette, "size",
       fmt::format("{} cells, {} mazes, {}", grouped(static_cast<std::uint64_t>(median.cells())),
                   name_of(options.maze.algorithm),
                   loops > 0.0 ? human_number(loops) + " of the remaining walls taken out" : "perfect"));
  line(text, palette, "planner",
       fmt::format("{}, clearance {}, {} {}", planner_text(median), human_number(median.clearance), median.threads,
                   median.threads == 1 ? "thread" : "threads"));
  line(text, palette, "solve",
       fmt::format("{}, the median of {} {} ({} to {})", palette.strong(human_seconds(median.solve_s)),
                   result.best.size(), result.best.size() == 1 ? "seed" : "seeds", human_seconds(fastest->solve_s),
                   human_seconds(slowest->solve_s)));
  line(text, palette, "rate",
       fmt::format("{} cells a second, {:.1f} ns a cell", human_count(median.cells() / median.solve_s),
                   median.solve_s * 1e9 / median.cells()));
  for (const auto& [name, seconds] : named_stages(median.seconds)) {
    if (seconds == 0.0) continue;  // no stage of this planner: tiles do several in one
    line(text, palette, fmt::format("  {}", name),
         fmt::format("{:>9}  {:>5.1f} %  {:>7.2f} ns a cell", human_seconds(seconds), 100.0 * seconds / median.solve_s,
                     seconds * 1e9 / median.cells()));
  }
  const auto bytes = static_cast<double>(median.peak_memory_bytes);
  line(text, palette, "memory",
       fmt::format("{} at the peak, walls included: {:.1f} B a cell", human_bytes(bytes), bytes / median.cells()));
  if (const MemoryTouch& touch = result.touch; touch.bytes > 0) {
    line(text, palette, "first touch",
         fmt::format("{} took {} cold and {} warm, before the clock: a cold start adds {}",
                     human_bytes(static_cast<double>(touch.bytes)), human_seconds(touch.cold_s),
                     human_seconds(touch.warm_s), human_seconds(touch.cold_s - touch.warm_s)));
  }
  if (!result.bar) return;
  const MazeTrial& same = result.best.back();  // the bar's own maze
  line(text, palette, "BFS + funnel",
       fmt::format("{} from the same walls to {} path, touching allowed: {:.1f} times as fast, {:.1f} % shorter",
                   human_seconds(result.bar->seconds), loops > 0.0 ? "a taut" : "the shortest",
                   same.solve_s / result.bar->seconds, 100.0 * (1.0 - result.bar->length / same.length)));
}

/// Why not larger?
void add_limit(std::string& text, const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  const double cells = result.best.empty() ? 0.0 : result.best.front().cells();
  const MazeTrial* next = nullptr;
  for (const MazeTrial& t : result.trials) {
    const bool fits = t.verified && t.solve_s <= options.budget_s;
    if (!fits && t.cells() > cells && (next == nullptr || t.cells() < next->cells())) next = &t;
  }
  if (next != nullptr) {
    line(text, palette, "too large",
         fmt::format("{} x {}, seed {}: {}, {}", next->rows, next->cols, next->seed, human_seconds(next->solve_s),
                     next->verified ? std::string_view{"over the budget"} : verdict_of(*next)));
  }
  for (const UnbegunSize& size : result.unbegun) {
    line(text, palette, "not begun",
         fmt::format("{} x {}: it would need {}", size.rows, size.cols,
                     human_bytes(static_cast<double>(size.expected_bytes))));
  }
}

void add_figures(Json& json, const LargestResult& result) {
  if (result.best.empty()) return;
  const MazeTrial& median = median_trial(result);
  const auto [fastest, slowest] = std::ranges::minmax_element(result.best, {}, &MazeTrial::solve_s);
  json["confirmed"] = result.confirmed;
  json["seeds"] = Json::array();
  for (const MazeTrial& t : result.best) json["seeds"].push_back(t.seed);
  json["solve_s_range"] = {fastest->solve_s, slowest->solve_s};
  json["cells_per_s"] = median.cells() / median.solve_s;
  json["stages_s"] = trial_json(median)["stages_s"];
  json["bytes_per_cell"] = static_cast<double>(median.peak_memory_bytes) / median.cells();
}

}  // namespace

Path<Vec2> bfs_funnel(const Scene& scene, const Execution& execution) {
  MazeCells cells = cells_of_walls(scene.walls, *scene.maze, execution);
  const std::size_t first = cells.index(0, 0);
  const std::size_t last = cells.index(cells.cols() - 1, cells.rows() - 1);
  CellWalk walk(cells, execution);
  if (!walk.reaches(first, last)) return {};
  const Vec2 goal{cells.cols() + 0.5, static_cast<double>(cells.rows())};
  return funnel({0.5, 1.0}, walk.steps(first, last), goal, execution);
}

LargestResult find_largest(const LargestOptions& options, const Execution& execution,
                           const std::function<void(std::string_view)>& note) {
  return LargestSearch(options, execution, note).search();
}

std::uint32_t largest_side(const SizeSearch& search, const std::function<bool(std::uint32_t)>& fits) {
  std::uint32_t fitting = 0;
  std::uint32_t too_large = 0;  // 0: not found, both
  const auto ask = [&](std::uint32_t side) { (fits(side) ? fitting : too_large) = side; };
  ask(search.start);
  if (fitting > 0) {
    while (fitting < search.most && too_large == 0) {
      ask(static_cast<std::uint32_t>(std::min<double>(search.most, std::ceil(fitting * std::numbers::sqrt2))));
    }
  } else {
    while (too_large > search.least && fitting == 0) {
      ask(std::max(search.least, static_cast<std::uint32_t>(too_large / std::numbers::sqrt2)));
    }
  }
  if (fitting == 0 || too_large == 0) return fitting;
  while (too_large - fitting > std::max(1.0, search.step * fitting)) ask(fitting + (too_large - fitting) / 2);
  return fitting;
}

std::uint32_t side_below(const SizeSearch& search, std::uint32_t side) {
  const double next = std::min(std::floor(side / (1.0 + search.step)), side - 1.0);
  return next < search.least ? 0 : static_cast<std::uint32_t>(next);
}

std::string largest_summary(const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  std::string text = headline(options, result, palette);
  if (!result.best.empty()) add_best(text, options, result, palette);
  add_limit(text, options, result, palette);
  line(text, palette, "machine", machine_text());
  return text;
}

std::string largest_json(const LargestOptions& options, const LargestResult& result) {
  Json json{{"schema", "warren.largest/1"}, {"warren_version", WARREN_VERSION}, {"budget_s", options.budget_s}};
  const auto figure = [](const MazeTrial* trial, const char* key) {
    return trial == nullptr ? Json(nullptr) : trial_json(*trial)[key];
  };
  const MazeTrial* const best = result.best.empty() ? nullptr : &median_trial(result);
  for (const char* key : {"rows", "cols"}) json[key] = figure(best, key);
  json["cells"] = best == nullptr ? Json(nullptr) : Json(static_cast<std::uint64_t>(best->cells()));
  json["solve_s"] = figure(best, "solve_s");
  json["verified"] = best != nullptr && std::ranges::all_of(result.best, &MazeTrial::verified);
  const MazeTrial* const shown = best == nullptr && !result.trials.empty() ? &result.trials.back() : best;
  for (const char* key : {"planner", "sampler", "threads", "peak_memory_bytes"}) json[key] = figure(shown, key);
  json["bfs_funnel_s"] = result.bar ? Json(result.bar->seconds) : Json(nullptr);
  json["bfs_funnel_length"] = result.bar ? Json(result.bar->length) : Json(nullptr);
  json["algorithm"] = name_of(options.maze.algorithm);
  json["loops"] = options.maze.loops;
  if (result.signal) json["stopped_by"] = name_of(*result.signal);
  add_figures(json, result);
  const MemoryTouch& touch = result.touch;
  json["first_touch"] = {{"bytes", touch.bytes}, {"cold_s", touch.cold_s}, {"warm_s", touch.warm_s}};
  json["machine"] = machine_json();
  json["not_begun"] = Json::array();
  for (const UnbegunSize& size : result.unbegun) {
    json["not_begun"].push_back({{"rows", size.rows}, {"cols", size.cols}, {"expected_bytes", size.expected_bytes}});
  }
  json["trials"] = Json::array();
  for (const MazeTrial& t : result.trials) json["trials"].push_back(trial_json(t));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

PlotSheet largest_plot(const LargestOptions& options, const LargestResult& result) {
  PlotSeries tried{.name = "solved, fastest of a size"};
  PlotSeries cut{.name = "cut or unsolved", .joined = false};
  PlotSeries largest{.name = "largest size, a seed each", .joined = false};
  for (const MazeTrial& t : result.trials) (t.verified ? tried : cut).points.push_back({t.cells(), t.solve_s});
  for (const MazeTrial& t : result.best) largest.points.push_back({t.cells(), t.solve_s});
  std::ranges::sort(tried.points, {}, [](Vec2 p) { return std::pair(p.x, p.y); });
  const auto same_size = [](Vec2 a, Vec2 b) { return a.x == b.x; };
  tried.points.erase(std::unique(tried.points.begin(), tried.points.end(), same_size), tried.points.end());
  Plot plot{.title = "Largest maze solved within the budget",
            .x_label = "cells",
            .y_label = "seconds, from walls in memory to path verified",
            .log_x = true,
            .log_y = true,
            .level = options.budget_s,
            .level_name = fmt::format("budget {}", human_seconds(options.budget_s))};
  if (!result.best.empty()) {
    const MazeTrial& best = median_trial(result);
    plot.title =
        fmt::format("{} x {} in {}: {}", best.rows, best.cols, human_seconds(best.solve_s), planner_text(best));
  }
  for (const PlotSeries& series : {tried, cut, largest}) {
    if (!series.points.empty()) plot.series.push_back(series);
  }
  return sheet_of(plot);
}

}  // namespace warren::studies
