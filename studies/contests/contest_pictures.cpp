// SPDX-License-Identifier: BSD-3-Clause
#include "studies/contests/contest_pictures.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "pictures/draw_answer.hpp"
#include "pictures/subtitle.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/answer/world_account.hpp"
#include "studies/contests/paths_figure.hpp"

namespace warren::studies {
namespace {

/// Of the runs that were solved, the one whose path is of median length; nullptr where none was.
const ComparedRun* median_run(const Contender& contender) {
  std::vector<const ComparedRun*> solved;
  for (const ComparedRun& run : contender.runs) {
    if (run.solved()) solved.push_back(&run);
  }
  if (solved.empty()) return nullptr;
  const auto middle = solved.begin() + static_cast<std::ptrdiff_t>((solved.size() - 1) / 2);
  std::nth_element(solved.begin(), middle, solved.end(), [](const ComparedRun* a, const ComparedRun* b) {
    return a->length != b->length ? a->length < b->length : a->seed < b->seed;
  });
  return *middle;
}

/// Letters, digits and dashes as they are, all else as one underscore.
std::string file_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (name.ends_with('_')) name.pop_back();
  return name;
}

class ContestPictures {
 public:
  ContestPictures(const Scene& scene, const PlannerContestOptions& options, const std::string& folder,
                  const Execution& execution)
      : scene_(scene), options_(options), folder_(folder), execution_(execution) {}

  void draw(const Contender& contender, const PlannerContender& asked) {
    const ComparedRun* run = median_run(contender);
    const std::uint64_t seed = run != nullptr ? run->seed : options_.first_seed;
    ByProducts made;
    const Answer answer = solve_contender(scene_, asked, seed, execution_, &made);
    const Drawing drawing = drawing_of(scene_, answer, std::move(made), execution_, options_.look.heading);
    const std::string said = options_text(contender);
    const std::string title = fmt::format("{}, {}{}seed {}: {}", title_of(scene_), contender.planner,
                                          said.empty() ? ", " : ", " + said + ", ", seed, name_of(answer.outcome));
    write(unused(file_name(contender.planner + " " + said)), title, picture_of(scene_, drawing));
    add_path(drawing, said.empty() ? contender.planner : contender.planner + ", " + said,
             run != nullptr ? run->length : 0.0);
    for (const DrawingPage& page : drawing.pages) {
      const std::string name = file_name(contender.planner) + "_" + page.id;
      if (!names_.insert(name).second) continue;
      write(name, title_of(scene_) + ": " + page.id, picture_of(scene_, drawing, page));
    }
  }
  /// The paths of all contenders in one figure.
  void draw_paths() {
    if (paths_.paths.size() < 2) return;
    paths_.subtitle = fmt::format("{}\nof each planner the path of median length", description_of(scene_));
    keep(studies::draw_paths(folder_, unused("paths") + ".svg", scene_, paths_, options_.look, execution_));
  }
  /// What was drawn otherwise than usual.
  std::vector<std::string> take_notes() { return std::move(notes_); }

 private:
  std::string unused(const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !names_.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
    return name;
  }
  /// Keeps what the figure of all paths shows; an arm's are in joint space.
  void add_path(const Drawing& drawing, const std::string& label, double length) {
    if (drawing.path.size() < 2) return;
    paths_.paths.push_back(
        {fmt::format("{}: length {}", label, human_number(length)), without_arcs(drawing.path, drawing.path_turns)});
    paths_.start = drawing.start;
    paths_.goal = drawing.goal;
  }
  void keep(std::vector<std::string> notes) { std::move(notes.begin(), notes.end(), std::back_inserter(notes_)); }
  void write(const std::string& name, const std::string& title, Picture picture) {
    picture.title = title;
    picture.description = description_of(scene_);
    keep(write_named(folder_, name + ".svg", picture, options_.look, execution_));
  }

  const Scene& scene_;
  const PlannerContestOptions& options_;
  const std::string& folder_;
  const Execution& execution_;
  std::set<std::string> names_;
  PathsFigure paths_;
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> draw_contest(const Scene& scene, const PlannerContestOptions& options,
                                      const Comparison& comparison, const std::string& folder,
                                      const Execution& execution) {
  ContestPictures pictures(scene, options, folder, execution);
  for (std::size_t i = 0; i < options.contenders.size(); ++i) {
    execution.check();
    pictures.draw(comparison.contenders[i], options.contenders[i]);
  }
  pictures.draw_paths();
  return pictures.take_notes();
}

void make_folder(const std::string& folder) {
  constexpr mode_t all_that_the_mask_leaves = 0777;
  const bool made = ::mkdir(folder.c_str(), all_that_the_mask_leaves) == 0;
  const int error = errno;
  struct stat status {};
  const bool is_folder = ::stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
  if (!is_folder) throw WriteError(folder, std::generic_category().message(made ? ENOTDIR : error));
  if (::access(folder.c_str(), W_OK | X_OK) != 0) throw WriteError(folder, std::generic_category().message(errno));
}

}  // namespace warren::studies
