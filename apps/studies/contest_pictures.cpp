// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/contest_pictures.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <system_error>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "pictures/draw_answer.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "pictures/model/picture.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/answer/world_account.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren::studies {
namespace {

using Leg = std::array<double, 4>;               // of its ends, the lesser first
using PathNumbers = std::vector<std::uint32_t>;  // ascending, each once

constexpr std::size_t legs_per_poll = 1 << 12;

/// The longer side of the box of all of them.
double extent_of(std::span<const std::vector<Vec2>> paths) {
  Box box;
  for (const std::vector<Vec2>& path : paths) box.include(box_around(path));
  return box.empty() ? 0.0 : std::max(box.width(), box.height());
}

/// Paths with a corner wherever one of them has one on a leg of another (or of its own), so that legs which overlap
/// become legs that are the same. Corners lie on a raster below what is seen: paths that are pulled taut by different
/// ways differ by a millionth.
class PathsCut {
 public:
  PathsCut(std::span<const std::vector<Vec2>> paths, const Execution& execution) : execution_(execution) {
    const double extent = extent_of(paths);
    constexpr int bits = 14;
    if (extent > 0.0) step_ = std::ldexp(1.0, std::ilogb(extent) - bits);
    for (const std::vector<Vec2>& path : paths) {
      std::vector<Vec2>& on_raster = paths_.emplace_back();
      for (const Vec2 p : path) on_raster.push_back(rounded(p));
      by_x_.insert(by_x_.end(), on_raster.begin(), on_raster.end());
    }
    by_y_ = by_x_;
    sort(by_x_, x_first);
    sort(by_y_, y_first);
  }

  std::vector<std::vector<Vec2>> take() {
    std::vector<std::vector<Vec2>> all;
    for (const std::vector<Vec2>& path : paths_) {
      std::vector<Vec2>& cut = all.emplace_back();
      for (std::size_t k = 0; k < path.size(); ++k) {
        if (k > 0 && !(path[k - 1] == path[k])) add_corners_between(path[k - 1], path[k], cut);
        cut.push_back(path[k]);
      }
    }
    return all;
  }

 private:
  static bool x_first(Vec2 a, Vec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); }
  static bool y_first(Vec2 a, Vec2 b) { return std::pair(a.y, a.x) < std::pair(b.y, b.x); }
  template <class Less>
  static void sort(std::vector<Vec2>& points, const Less& less) {
    std::sort(points.begin(), points.end(), less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  Vec2 rounded(Vec2 p) const {
    if (step_ == 0.0) return p;
    return {std::nearbyint(p.x / step_) * step_, std::nearbyint(p.y / step_) * step_};
  }
  template <class Less>
  static std::span<const Vec2> range(const std::vector<Vec2>& points, Vec2 low, Vec2 high, const Less& less) {
    const auto first = std::lower_bound(points.begin(), points.end(), low, less);
    return std::span(first, std::upper_bound(first, points.end(), high, less));
  }
  /// All corners that may lie on the leg: the fewer of those in its columns and in its rows.
  std::span<const Vec2> near(Vec2 a, Vec2 b) const {
    const Vec2 low{std::min(a.x, b.x), std::min(a.y, b.y)};
    const Vec2 high{std::max(a.x, b.x), std::max(a.y, b.y)};
    if (a.x == b.x) return range(by_x_, low, high, x_first);
    if (a.y == b.y) return range(by_y_, low, high, y_first);
    constexpr double endless = std::numeric_limits<double>::infinity();
    const auto columns = range(by_x_, {low.x, -endless}, {high.x, endless}, x_first);
    const auto rows = range(by_y_, {-endless, low.y}, {endless, high.y}, y_first);
    return columns.size() < rows.size() ? columns : rows;
  }
  void add_corners_between(Vec2 a, Vec2 b, std::vector<Vec2>& cut) {
    const Vec2 leg = b - a;
    const double reach = 2.0 * step_ * norm(leg);
    std::vector<std::pair<double, Vec2>> on_leg;
    for (const Vec2 p : near(a, b)) {
      if (++polled_ % legs_per_poll == 0) execution_.check();
      const double along = dot(p - a, leg);
      if (!(p == a) && !(p == b) && along > 0.0 && along < dot(leg, leg) && std::abs(cross(leg, p - a)) <= reach) {
        on_leg.emplace_back(along, p);
      }
    }
    std::sort(on_leg.begin(), on_leg.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [along, p] : on_leg) cut.push_back(p);
  }

  const Execution& execution_;
  double step_ = 0.0;
  std::vector<std::vector<Vec2>> paths_;
  std::vector<Vec2> by_x_;
  std::vector<Vec2> by_y_;
  std::size_t polled_ = 0;
};

class SharedLegs {
 public:
  SharedLegs(std::span<const std::vector<Vec2>> paths, double dash, const Execution& execution)
      : paths_(paths), dash_(dash), execution_(execution), shown_(paths.size()) {
    for (std::uint32_t i = 0; i < paths.size(); ++i) {
      for_each_leg(i, [&](Vec2 a, Vec2 b) {
        PathNumbers& users = users_[ordered_ends(a, b)];
        if (users.empty() || users.back() != i) users.push_back(i);
      });
    }
  }

  /// The first path along a run of legs with the same users draws it for all of them.
  std::vector<PolygonSet> take() {
    for (std::uint32_t i = 0; i < paths_.size(); ++i) {
      std::vector<Vec2> run;
      const PathNumbers* along = nullptr;
      for_each_leg(i, [&](Vec2 a, Vec2 b) {
        const PathNumbers& users = users_.at(ordered_ends(a, b));
        if (along == nullptr || *along != users) {
          end_run(i, along, run);
          run = {a};
          along = &users;
        }
        run.push_back(b);
      });
      end_run(i, along, run);
    }
    return std::move(shown_);
  }

 private:
  template <class Visit>
  void for_each_leg(std::uint32_t i, const Visit& visit) const {
    const std::vector<Vec2>& path = paths_[i];
    for (std::size_t k = 1; k < path.size(); ++k) {
      if (k % legs_per_poll == 0) execution_.check();
      if (!(path[k - 1] == path[k])) visit(path[k - 1], path[k]);
    }
  }
  void end_run(std::uint32_t path, const PathNumbers* users, const std::vector<Vec2>& run) {
    if (users == nullptr || users->front() != path) return;
    if (users->size() == 1) return shown_[path].add(run);
    take_turns(*users, run);
  }
  /// Dashes of equal length, as many for each.
  void take_turns(const PathNumbers& users, const std::vector<Vec2>& run) {
    const double length = path_length(run, [](Vec2 a, Vec2 b) { return distance(a, b); });
    const auto rounds = std::max(std::round(length / dash_ / static_cast<double>(users.size())), 1.0);
    const auto dashes = static_cast<std::size_t>(rounds) * users.size();
    const double each = length / static_cast<double>(dashes);
    std::vector<Vec2> dash{run.front()};
    std::size_t drawn = 0;
    double walked = 0.0;
    for (std::size_t k = 1; k < run.size(); ++k) {
      const double leg = distance(run[k - 1], run[k]);
      for (; drawn + 1 < dashes && each * static_cast<double>(drawn + 1) < walked + leg; ++drawn) {
        const double share = (each * static_cast<double>(drawn + 1) - walked) / leg;
        const Vec2 end = run[k - 1] + share * (run[k] - run[k - 1]);
        dash.push_back(end);
        shown_[users[drawn % users.size()]].add(dash);
        dash = {end};
      }
      walked += leg;
      dash.push_back(run[k]);
    }
    shown_[users[drawn % users.size()]].add(dash);
  }

  std::span<const std::vector<Vec2>> paths_;
  double dash_;
  const Execution& execution_;
  std::map<Leg, PathNumbers> users_;
  std::vector<PolygonSet> shown_;
};

/// Returns what is drawn otherwise than usual, a line each that begins with the name.
std::vector<std::string> write_named(const std::string& folder, const std::string& name, const Picture& picture,
                                     const PictureOptions& look, const Execution& execution) {
  std::vector<std::string> notes = write_picture(folder + "/" + name, picture, look, execution);
  for (std::string& note : notes) note = fmt::format("{}: drawn {}", name, note);
  return notes;
}

/// The same of one figure of several paths, each in a colour of its own with its label in the legend, arcs as chords. A
/// map's scene has its border walls.
std::vector<std::string> draw_paths(const std::string& folder, const std::string& name, Picture picture,
                                    const std::vector<std::string>& labels, std::span<const std::vector<Vec2>> paths,
                                    const PictureOptions& look, const Execution& execution) {
  if (picture.scene.map) picture.layers = cells_of_map(*picture.scene.map, execution);
  const double extent = extent_of(paths);
  const double dash = extent > 0.0 ? extent / 60.0 : 1.0;  // some sixty across all that is drawn
  std::vector<PolygonSet> lines = lines_side_by_side(paths, dash, execution);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    picture.layers.push_back({.id = fmt::format("path_{}", i + 1),
                              .label = labels[i],
                              .part = Part::path,
                              .color = colors::series[i % colors::series.size()],
                              .width = 0.8 * widths::path,
                              .lines = std::move(lines[i])});
  }
  picture.title = title_of(picture.scene);
  picture.description = description_of(picture.scene);
  return write_named(folder, name, picture, look, execution);
}

/// Of the runs that were solved, the one whose path is of median length; nullptr where none was.
const ComparedRun* median_run(const Contender& contender) {
  std::vector<const ComparedRun*> solved;
  for (const ComparedRun& run : contender.runs) {
    if (run.solved()) solved.push_back(&run);
  }
  if (solved.empty()) return nullptr;
  const auto middle = solved.begin() + static_cast<std::ptrdiff_t>((solved.size() - 1) / 2);
  std::ranges::nth_element(solved, middle, {},
                           [](const ComparedRun* run) { return std::pair(run->length, run->seed); });
  return *middle;
}

struct FoundPath {
  SearchVariant first;
  std::size_t variants = 1;
  std::uint64_t expanded = 0;
  RawVector<VertexId> path = {};
};

std::vector<FoundPath> found_paths(const SearchGraph& graph, const SearchContestOptions& options,
                                   const Execution& execution) {
  std::vector<FoundPath> all;
  for (const SearchVariant& variant : options.variants) {
    execution.check();
    const Deadline deadline(execution.deadline, options.budget_s);
    Execution within = execution;
    within.deadline = &deadline;
    SearchResult result = graph_search(graph, variant)(within);
    if (result.status != SearchStatus::found) continue;
    const auto same = std::find_if(all.begin(), all.end(), [&](const FoundPath& f) {
      return f.first.search == variant.search && f.expanded == result.expanded && f.path == result.path;
    });
    if (same != all.end()) {
      ++same->variants;
    } else {
      all.push_back({.first = variant, .expanded = result.expanded, .path = std::move(result.path)});
    }
  }
  return all;
}

/// A search's name alone where all its variants found the same.
std::string label_of(const FoundPath& found, const std::vector<FoundPath>& all, const SearchGraph& graph) {
  std::string name{name_of(found.first.search)};
  const auto alike =
      std::count_if(all.begin(), all.end(), [&](const FoundPath& f) { return f.first.search == found.first.search; });
  if (alike > 1) {
    if (found.first.queue) name.append(", ").append(name_of(*found.first.queue));
    if (found.first.library != SearchLibrary::warren) name.append(", ").append(name_of(found.first.library));
    if (found.variants > 1) name += fmt::format(" and {} more", found.variants - 1);
  }
  return fmt::format("{}: length {}, {} settled", name, human_number(path_length(graph, found.path)),
                     grouped(found.expanded));
}

}  // namespace

std::vector<PolygonSet> lines_side_by_side(std::span<const std::vector<Vec2>> paths, double dash,
                                           const Execution& execution) {
  const std::vector<std::vector<Vec2>> cut = PathsCut(paths, execution).take();
  return SharedLegs(cut, dash, execution).take();
}

std::vector<std::string> draw_contest(const Scene& scene, const PlannerContestOptions& options,
                                      const Comparison& comparison, const std::string& folder,
                                      const PictureOptions& look, const Execution& execution) {
  std::set<std::string> names;
  const auto unused = [&](const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !names.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
    return name;
  };
  std::vector<std::string> notes;
  const auto keep = [&](std::vector<std::string> more) { std::ranges::move(more, std::back_inserter(notes)); };
  const auto write = [&](const std::string& name, const std::string& title, Picture& picture) {
    picture.title = title;
    picture.description = description_of(scene);
    keep(write_named(folder, name + ".svg", picture, look, execution));
  };
  std::vector<std::string> labels;
  std::vector<std::vector<Vec2>> paths;
  Picture overview{.scene = scene};
  for (std::size_t i = 0; i < options.contenders.size(); ++i) {
    execution.check();
    const Contender& contender = comparison.contenders[i];
    const ComparedRun* run = median_run(contender);
    const std::uint64_t seed = run != nullptr ? run->seed : options.first_seed;
    ByProducts made;
    const Answer answer = solve_contender(scene, options.contenders[i], seed, execution, &made);
    Picture picture = drawing_of(scene, answer, std::move(made), execution, look.heading);
    const std::string said = options_text(contender);
    const std::string title = fmt::format("{}, {}{}seed {}: {}", title_of(scene), contender.planner,
                                          said.empty() ? ", " : ", " + said + ", ", seed, name_of(answer.outcome));
    write(unused(file_name(contender.planner + " " + said)), title, picture);
    if (picture.path.size() > 1) {  // an arm's is in joint space
      const std::string label = said.empty() ? contender.planner : contender.planner + ", " + said;
      labels.push_back(fmt::format("{}: length {}", label, human_number(run != nullptr ? run->length : 0.0)));
      paths.push_back(without_arcs(picture.path, picture.path_turns));
      overview.start = picture.start;
      overview.goal = picture.goal;
    }
    for (PicturePage& page : picture.pages) {
      const std::string name = file_name(contender.planner) + "_" + page.id;
      if (!names.insert(name).second) continue;
      Picture other{.scene = scene,
                    .layers = std::move(page.layers),
                    .start = picture.start,
                    .goal = picture.goal,
                    .subtitle = picture.subtitle};
      write(name, title_of(scene) + ": " + page.id, other);
    }
  }
  if (paths.size() > 1) {
    overview.subtitle = fmt::format("{}\nof each planner the path of median length", description_of(scene));
    keep(draw_paths(folder, unused("paths") + ".svg", std::move(overview), labels, paths, look, execution));
  }
  return notes;
}

std::string file_name(std::string_view text, char between) {
  std::string name;
  for (const char c : text) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_plain = is_letter || (c >= '0' && c <= '9') || (c == '-' && between != '-');
    if (is_plain || !(name.empty() || name.ends_with(between))) name += is_plain ? c : between;
  }
  return name.substr(0, name.find_last_not_of(between) + 1);
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (!error && ::access(folder.c_str(), W_OK | X_OK) != 0) error.assign(errno, std::generic_category());
  if (error) throw WriteError(folder, error.message());
}

std::vector<std::string> draw_searches(const Scene& world, const SearchGraph& graph,
                                       const SearchContestOptions& options, const std::string& folder,
                                       const PictureOptions& look, const Execution& execution) {
  Scene scene = world;
  add_map_walls(scene, execution);
  PlannedRoadmap<Vec2> roadmap{.states = {}, .graph = graph.graph, .search_tree = {}};
  for (const Vec2 p : graph.at) roadmap.states.push_back(p);
  Picture picture{.scene = scene,
                  .roadmap = std::move(roadmap),
                  .start = graph.at[graph.start],
                  .goal = graph.at[graph.goal],
                  .subtitle = fmt::format("{}\ngraph of {}: {}, {}", description_of(scene), graph.kind,
                                          counted(graph.graph.vertex_count(), "vertex", "vertices"),
                                          counted(graph.graph.edge_count(), "edge", "edges"))};
  const std::vector<FoundPath> all = found_paths(graph, options, execution);
  std::vector<std::string> labels;
  std::vector<std::vector<Vec2>> paths(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    labels.push_back(label_of(all[i], all, graph));
    for (const VertexId v : all[i].path) paths[i].push_back(graph.at[v]);
  }
  if (all.empty()) picture.subtitle += "; no search found a path";
  return draw_paths(folder, "searches.svg", std::move(picture), labels, paths, look, execution);
}

}  // namespace warren::studies
