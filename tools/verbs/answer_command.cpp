// SPDX-License-Identifier: BSD-3-Clause
#include "tools/verbs/answer_command.hpp"

#include <fmt/format.h>

#include "pictures/answer_summary.hpp"
#include "pictures/draw_answer.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/layers/draw_bodies.hpp"
#include "scenes/files/npy_io.hpp"
#include "solve/answer/explanation_text.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/explain_answer.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/words/question_words.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec output_specs[] = {
    {"--json", "FILE", "write the answer as JSON; - is standard output"},
    {"--no-path", "", "leave the points of the path out of the JSON, which then has their number and a hash of them"},
    {"--explain", "", "also say what became of samples and motions, where it is narrow, and what would likely help"},
    {"--picture", "FILE", "draw the world, roadmap, search and path: .svg .png .pdf .html by ending (or --svg FILE)"},
};

}  // namespace

std::vector<OptionSpec> answer_output_specs() { return joined_options({output_specs, picture_option_specs()}); }

AnswerCommand::AnswerCommand(const Arguments& arguments, std::string_view keep)
    : arguments_(arguments),
      json_(output_file(arguments, "--json").value_or("")),
      svg_(output_file(arguments, "--picture").value_or("")),
      roadmap_(output_file(arguments, keep).value_or("")),
      path_(output_file(arguments, "--path").value_or("")),
      certificate_(output_file(arguments, "--certificate").value_or("")),
      path_options_(path_words(arguments)),
      picture_options_(picture_words(arguments, arguments.has("--picture"), "--picture FILE", svg_)) {
  check_picture("--picture", svg_);
}

int AnswerCommand::run() {
  Run run(arguments_, RunScope::whole_command, expected_stages());
  answer(run);
  write_outputs(run);
  run.end();
  say_of_picture(arguments_, svg_, drawn_otherwise_);
  // One that gets better until it is interrupted answers, and says that it was.
  const bool is_told = answer_.outcome == Outcome::stopped || (answer_.stop_reason && is_signal(*answer_.stop_reason));
  const auto stopped = is_told ? std::optional(answer_.stop_reason.value_or(StopReason::time)) : std::nullopt;
  const auto summary = [&] {
    return summary_of(answer_, run.palette(), written_) + notes_text(answer_, run.palette()) +
           explanation_text(answer_, run.palette());
  };
  run.conclude(summary, stopped);
  if (stopped) return exit_code_of(*stopped);
  return answer_.verified ? exit_code::success : exit_code::no_path;
}

/// Only a file that is put into its place when all is verified may be begun before.
bool AnswerCommand::hands_path_on() const {
  if (!arguments_.has("--no-path") || !svg_.empty() || explains() || keeps_roadmap() || !certificate_.empty())
    return false;
  if (path_.empty()) return true;
  return path_format(path_) == PathFormat::npy && !path_options_.every && !is_written_straight(path_);
}

void AnswerCommand::answer(const Run& run) {
  StageTimes before;
  if (hands_path_on()) handed_on_.emplace(path_, run.execution());
  const auto stopped = stopped_by([&] {
    by_products_.wants_certificate = !certificate_.empty();
    const bool keeps = !svg_.empty() || explains() || by_products_.wants_certificate;
    answer_ = find(run, before, keeps ? &by_products_ : nullptr);
  });
  if (stopped) answer_.stop_reason = stopped;
  if (answer_.world.source.empty()) answer_.world.source = arguments_.operand(0);
  answer_.seconds.read = before.read;
  answer_.seconds.generate += before.generate;
  answer_.tells_path = !arguments_.has("--no-path");
  tell_process(answer_, run.execution());
}

/// A stop before, after the answer was found, does not make it a stopped answer.
void AnswerCommand::write_outputs(Run& run) {
  if (explains()) {
    explain_in_time(answer_, [&] {
      if (!answer_.world.kind.empty()) return explain(run.execution(), answer_, by_products_);
      answer_.explained.emplace().hints = hints_for(Scene(), {.options = SolveOptions()}, answer_);  // nobody read it
    });
  }
  if (answer_.outcome != Outcome::stopped) {
    const bool got_better = answer_.iterations.has_value();  // until its time was over
    const auto stopped = stopped_by([&] { write_finished(run.execution_for_what_is_left(got_better)); });
    if (!stopped) return;
    make_stopped(answer_, *stopped);
  }
  if (json_.empty() || json_said_) return;
  Execution unhurried = run.execution();
  unhurried.deadline = nullptr;  // what is left to say is short, and must be said
  std::optional<OutputFile> json;
  write_json(json, unhurried);
  json->commit();
  written_.push_back(json_);
}

/// All files are complete before the picture is drawn, and none is in its place before the picture is in its own: from
/// there on no file asks for the time. A JSON file comes last. What is written straight can't be complete before: it
/// follows the picture.
void AnswerCommand::write_finished(const Execution& execution) {
  const bool has_path = !path_.empty() && answer_.verified;
  if (by_products_.certificate) {
    write_npy(*by_products_.certificate, certificate_, execution);
    written_.push_back(certificate_);
  } else if (!certificate_.empty() && !arguments_.has("--quiet")) {
    say_on_standard_error(
        "warren: note: --certificate: there is no bound of all paths to prove, so it is not written\n");
  }
  std::optional<OutputFile> kept;
  std::optional<OutputFile> json;
  const bool kept_follows = keeps_roadmap() && is_written_straight(roadmap_);
  if (keeps_roadmap() && !kept_follows) write_kept(kept, execution);
  const bool json_follows = !json_.empty() && is_written_straight(json_);
  if (!json_.empty() && !json_follows) {
    write_json(json, execution);
    json->complete();
  }
  std::optional<OutputFile> path;
  const bool path_is_written = has_path && !answer_.handed;
  if (path_is_written && !is_written_straight(path_)) {
    path.emplace(path_, execution);
    write_path(answer_, path_, path_options_, execution, *path);
    path->complete();
  }
  if (!svg_.empty()) draw(execution);
  FirstOfTwoFiles path_first(has_path ? path_ : "-");
  if (has_path && answer_.handed) handed_on_->commit();
  if (path) path->commit();
  if (path_is_written && !path) write_path_file(answer_, path_, path_options_, execution);
  json_said_ = json_follows;
  if (json_follows) write_json(json, execution);
  if (kept_follows) write_kept(kept, execution);
  FirstOfTwoFiles first(kept && json ? roadmap_ : "-");
  if (kept) kept->commit();
  if (json) json->commit();
  first.keep();
  path_first.keep();
  for (const std::string& file : {json_, svg_, roadmap_}) {
    if (!file.empty()) written_.push_back(file);
  }
  if (has_path) written_.push_back(path_);
}

void AnswerCommand::check_outputs_of(const RobotSpec& robot) const {
  if (picture_options_.heading) check_has_headings(robot);
  if (!path_.empty()) check_path_file(robot, path_, path_options_);
}

void AnswerCommand::write_kept(std::optional<OutputFile>& file, const Execution& execution) const {
  file.emplace(roadmap_, execution);
  write_roadmap(made_roadmap_, *file, execution);
  file->complete();
}

/// Opens the file with the first word: nlohmann ends the program where memory is out.
void AnswerCommand::write_json(std::optional<OutputFile>& file, const Execution& execution) const {
  if (execution.progress != nullptr) execution.progress->begin("write", 0);
  write_answer_json(answer_, execution, [&](std::string_view text) {
    if (!file) file.emplace(json_, execution);
    file->write(text);
    execution.advance(text.size());
  });
}

void AnswerCommand::draw(const Execution& execution) {
  const StageTimer timer(execution, "draw", nullptr);
  Scene scene = scene_drawn(execution, by_products_);
  add_map_walls(scene, execution);
  Picture picture = drawing_of(scene, answer_, std::move(by_products_), execution, picture_options_.heading);
  picture.description = fmt::format("{}\n{}", picture.subtitle, arguments_.command_line());
  drawn_otherwise_ = write_picture(svg_, picture, picture_options_, execution);
}

}  // namespace warren::tools
