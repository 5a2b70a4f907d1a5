// SPDX-License-Identifier: BSD-3-Clause
// warren profile: what each stage of a solve costs. The same question is asked several times on one thread and on all,
// in turns, so that whatever else the machine does meets both alike. Medians are told.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

#include "apps/studies/machine.hpp"
#include "apps/studies/statistics.hpp"
#include "apps/studies/study_report.hpp"
#include "pictures/model/axis.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/explanation_text.hpp"
#include "solve/solve.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

/// One stage, on all threads.
struct ProfiledStage {
  StageLine line;                      ///< medians
  std::optional<double> one_thread_s;  ///< wall-clock; none where there is one thread alone
  std::optional<double> speed_up() const {
    constexpr double least_s = 20e-6;  // below it the clock and the start of threads are measured
    if (!one_thread_s || line.wall_s < least_s) return std::nullopt;
    return *one_thread_s / line.wall_s;
  }
};

struct StageProfile {
  Answer answer;                      ///< of the last run
  std::size_t runs = 0;               ///< that ended, on all threads
  std::vector<ProfiledStage> stages;  ///< in the order of the work, and last "rest": what is in none of them
  ProfiledStage whole;                ///< solve_s
};

using Json = nlohmann::ordered_json;

/// The runs of one number of threads: of each stage all times, by its key.
struct Timed {
  std::vector<StageLine> lines;  // of the last run
  std::map<std::string, std::vector<double>> wall_s;
  std::map<std::string, std::vector<double>> cpu_s;

  void take(const Answer& answer, double solve_cpu_s) {
    lines = stage_lines(answer);
    StageLine whole{.key = "solve", .label = "in all", .counted = {}};
    const auto add = [&whole](const StageLine& line) {
      whole.wall_s += line.wall_s;
      whole.cpu_s += line.cpu_s;
    };
    std::ranges::for_each(lines, add);
    StageLine rest{.key = "rest", .label = "the rest", .counted = {}};
    rest.wall_s = std::max(0.0, answer.solve_s - whole.wall_s);
    rest.cpu_s = std::max(0.0, solve_cpu_s - whole.cpu_s);
    add(rest);
    lines.insert(lines.end(), {rest, whole});
    for (const StageLine& line : lines) {
      wall_s[line.key].push_back(line.wall_s);
      cpu_s[line.key].push_back(line.cpu_s);
    }
  }
};

std::vector<std::string> row_of(const ProfiledStage& stage, double whole_s) {
  const StageLine& line = stage.line;
  const auto speed_up = stage.speed_up();
  return {line.label,
          human_seconds(line.wall_s),
          whole_s > 0.0 ? fmt::format("{:.0f} %", 100.0 * line.wall_s / whole_s) : "",
          human_seconds(line.cpu_s),
          line.count > 0 ? fmt::format("{:.0f}", line.ns_each()) : "",
          stage.one_thread_s ? human_seconds(*stage.one_thread_s) : "",
          speed_up ? fmt::format("{:.2f}", *speed_up) : "",
          line.count > 0 ? fmt::format("{} {}", grouped(line.count), line.counted) : ""};
}

Json json_of(const ProfiledStage& stage) {
  const StageLine& line = stage.line;
  Json json{{"name", line.key}, {"wall_s", line.wall_s}, {"cpu_s", line.cpu_s}, {"count", line.count}};
  json["ns_each"] = line.count > 0 ? Json(line.ns_each()) : Json(nullptr);
  json["one_thread_s"] = stage.one_thread_s ? Json(*stage.one_thread_s) : Json(nullptr);
  json["speed_up"] = stage.speed_up() ? Json(*stage.speed_up()) : Json(nullptr);
  return json;
}

/// Ends early, and says so by the answer's outcome, where a run is stopped. Throws UsageError as solve() does.
StageProfile profile_stages(const Scene& scene, const Question& question, const SolveOptions& options, std::size_t runs,
                            const Execution& execution) {
  Execution alone = execution;
  alone.threads = 1;
  const bool both = thread_count(execution.threads) > 1;
  StageProfile profile;
  Timed one;
  Timed all;
  const auto run = [&](const Execution& on, Timed& timed) {
    const double before_s = process_cpu_s();
    profile.answer = solve_within(scene, question, options, on);
    const double cpu_s = process_cpu_s() - before_s;
    profile.answer.threads = thread_count(execution.threads);  // what was asked, also where the one-thread turn is cut
    if (profile.answer.outcome == Outcome::stopped) return false;
    timed.take(profile.answer, cpu_s);
    return true;
  };
  for (; profile.runs < runs; ++profile.runs) {
    if ((both && !run(alone, one)) || !run(execution, all)) break;
  }
  for (const StageLine& line : all.lines) {
    ProfiledStage stage{line, {}};
    if (one.wall_s.contains(line.key)) stage.one_thread_s = studies::median_of(one.wall_s[line.key]);
    stage.line.wall_s = studies::median_of(all.wall_s[line.key]);
    stage.line.cpu_s = studies::median_of(all.cpu_s[line.key]);
    profile.stages.push_back(std::move(stage));
  }
  if (profile.stages.empty()) return profile;
  profile.whole = std::move(profile.stages.back());
  profile.stages.pop_back();
  return profile;
}

std::string profile_summary(const StageProfile& profile, const Palette& palette) {
  const Answer& answer = profile.answer;
  studies::TextTable table{{"stage", "wall", "share", "CPU", "ns each", "1 thread", "speed-up", "of"}, 1};
  for (const ProfiledStage& stage : profile.stages) table.rows.push_back(row_of(stage, profile.whole.line.wall_s));
  if (profile.runs > 0) table.rows.push_back(row_of(profile.whole, 0.0));
  return fmt::format("{}  {}, {}{}; {} on {}, medians\n{}{} {}\n", palette.strong(answer.world.source),
                     name_of(answer.outcome), answer.planner, answer.sampler.empty() ? "" : ", " + answer.sampler,
                     counted(profile.runs, "run", "runs"), counted(answer.threads, "thread", "threads"),
                     table.rows.empty() ? "" : table.text(palette), palette.faint("machine"), studies::machine_text());
}

std::string profile_json(const StageProfile& profile) {
  const Answer& answer = profile.answer;
  Json json{{"schema", "warren.profile/1"}, {"warren_version", WARREN_VERSION},
            {"world", answer.world.source}, {"status", name_of(answer.outcome)},
            {"planner", answer.planner},    {"sampler", answer.sampler},
            {"seed", answer.seed},          {"threads", answer.threads},
            {"runs", profile.runs}};
  json["machine"] = studies::machine_json();
  json["solve"] = profile.runs > 0 ? json_of(profile.whole) : Json(nullptr);
  json["stages"] = Json::array();
  for (const ProfiledStage& stage : profile.stages) json["stages"].push_back(json_of(stage));
  return json.dump(1) + "\n";
}

PlotSheet profile_bars(const StageProfile& profile) {
  constexpr Box frame{{150.0, 48.0}, {plot_size.x - 110.0, 366.0}};
  double most_s = 1e-9;
  for (const ProfiledStage& s : profile.stages) {
    most_s = std::max({most_s, s.line.wall_s, s.one_thread_s.value_or(0.0)});
  }
  const PlotAxis axis(0.0, 1e3 * most_s, false, false);
  const auto place = [&](double seconds) { return frame.min.x + axis.at(1e3 * seconds) * frame.width(); };
  PlotSheet sheet;
  sheet.begin(fmt::format("{}: {} on {}", profile.answer.world.source, profile.answer.planner,
                          counted(profile.answer.threads, "thread", "threads")),
              frame, "milliseconds; the pale bars: on one thread", "", 0.0);
  for (const double tick : axis.ticks()) {
    sheet.line({{place(1e-3 * tick), frame.min.y}, {place(1e-3 * tick), frame.max.y}}, faint_line);
    sheet.label({place(1e-3 * tick), frame.max.y + 17.0}, Anchor::middle, short_text(tick));
  }
  sheet.box(frame, frame_line);
  sheet.label({frame.max.x + 10.0, frame.min.y - 8.0}, Anchor::start, "speed-up");
  const double row = (frame.max.y - frame.min.y) / static_cast<double>(std::max<std::size_t>(1, profile.stages.size()));
  for (std::size_t i = 0; i < profile.stages.size(); ++i) {
    const ProfiledStage& stage = profile.stages[i];
    const double y = frame.min.y + (static_cast<double>(i) + 0.5) * row;
    const auto bar = [&](double seconds, double from, double to, Rgb color) {
      sheet.box({{frame.min.x, y + from * row}, {place(seconds), y + to * row}}, {.fill = color},
                fmt::format("{}: {}", stage.line.label, human_seconds(seconds)));
    };
    const Rgb color = series_color(i);
    const auto pale = [](std::uint8_t c) { return static_cast<std::uint8_t>(255 - (255 - c) / 3); };
    if (stage.one_thread_s) bar(*stage.one_thread_s, -0.4, 0.0, {pale(color.red), pale(color.green), pale(color.blue)});
    bar(stage.line.wall_s, stage.one_thread_s ? 0.0 : -0.3, stage.one_thread_s ? 0.4 : 0.3, color);
    sheet.label({frame.min.x - 8.0, y + 4.0}, Anchor::end, stage.line.label);
    if (const auto gain = stage.speed_up()) {
      sheet.label({frame.max.x + 10.0, y + 4.0}, Anchor::start, fmt::format("{:.2f}", *gain));
    }
  }
  return sheet;
}

constexpr OptionSpec profile_specs[] = {
    {"--runs", "N", "how often it runs, by turns on one thread and on all; times are medians (default: 5)"},
    {"--json", "FILE", "write all figures as JSON; - is standard output"},
    {"--picture", "FILE", "draw a bar for each stage, as .svg, .png or .pdf by ending; - is standard output"},
};

int profile(const Arguments& arguments) {
  constexpr std::uint32_t most_runs = 1000;
  constexpr std::uint32_t usual_runs = 5;
  const Question question = question_words(arguments);
  const SolveOptions options = solve_words(arguments);
  check_not_written(arguments, question.robot, question.prices);
  const auto runs = given_count(arguments, "--runs", 1, most_runs).value_or(usual_runs);
  check_reports(arguments, {"--json", "--picture"});
  check_plots(arguments);
  Run run(arguments);
  const Scene scene = load_planned_world(arguments.operand(0), options.roadmap.pipeline, arguments, run.execution());
  const StageProfile profile = profile_stages(scene, question, options, runs, run.execution());
  run.end();
  const bool is_stopped = profile.answer.outcome == Outcome::stopped;
  write_report(arguments, "--json", [&] { return profile_json(profile); });
  write_plots(arguments, run.execution_for_what_is_left(), is_stopped,
              [&] { return PlotsPage{{profile_bars(profile)}}; });
  run.conclude([&] { return profile_summary(profile, run.palette()); },
               is_stopped ? profile.answer.stop_reason : std::nullopt);
  if (is_stopped) return exit_code_of(profile.answer.stop_reason.value_or(StopReason::time));
  return profile.answer.verified ? exit_code::success : exit_code::no_path;
}

}  // namespace

Command profile_command() {
  return {"profile", "WORLD", "measure what each stage of a solve costs",
          joined_options(
              {profile_specs, solve_option_specs(), question_option_specs(), world_option_specs(), run_option_specs()}),
          profile};
}

}  // namespace warren::tools
