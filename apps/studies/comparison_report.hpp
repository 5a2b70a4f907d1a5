// SPDX-License-Identifier: BSD-3-Clause
// What `warren compare` says: tables, warren.compare/1, CSV with a contender a line, plots, and a log as OMPL writes
// it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/studies/comparison.hpp"
#include "apps/studies/study_report.hpp"
#include "pictures/plots/plot.hpp"

namespace warren::studies {

/// A table a problem (random graphs: one for all sizes), the crossings, notes, the machine.
std::string comparison_summary(const Comparison& comparison, const Palette& palette);
/// Its tables for a document, with their titles: .tex by the file's ending, else Markdown.
std::string comparison_document(const Comparison& comparison, std::string_view ending);
/// All of it as a page: tables and the plots of comparison_plots().
std::string comparison_page(const Comparison& comparison, const std::string& command_line);
std::string comparison_json(const Comparison& comparison);
std::string comparison_csv(const Comparison& comparison);
/// A line a run, with each option in a column of its own.
std::string comparison_runs(const Comparison& comparison);

/// A line a path that was the best so far in its run, and one without cost for each run that found none.
std::string comparison_curves(const Comparison& comparison);

/// What a planner's runs had at moments, ascending, from the first path of all contenders to the end of the longest
/// run. A run without a path yet costs infinitely much. Most moments where something changed, and all figures at those
/// are exact.
struct CostCurve {
  std::vector<Vec2> median = {};     ///< seconds, cost of the best path until then
  std::vector<Vec2> quartiles = {};  ///< of that cost, at the same moments
  std::vector<Vec2> solved = {};     ///< seconds, per cent of the runs that have a path; from 0 at begin_s on
};
/// 0 < begin_s <= end_s.
CostCurve cost_curve(const Contender& contender, double begin_s, double end_s);
/// Of each problem what the runs of each planner cost and how many of them were solved, against time.
std::vector<PlotSheet> curve_panels(const Comparison& comparison);

/// Plots (comparison_plots.cpp): of random graphs times and ratios against size; else what options that were dealt out
/// do, and the share of runs that had found a path, against time.
std::vector<PlotSheet> comparison_panels(const Comparison& comparison);
/// The same plots on one page.
PlotsPage comparison_plots(const Comparison& comparison);

/// Success, lengths and times against the options that were dealt out, as lines or heat maps; none where none was. At
/// most 60.
std::vector<PlotSheet> list_panels(const Comparison& comparison);
/// How many heat maps list_panels() leaves out; empty: none.
std::string note_on_heat_maps(const Comparison& comparison);

/// Lengths, times and clearances of each problem's contenders as box plots, those that differ
/// from run to run. None of a problem with more than most_boxes contenders.
std::vector<PlotSheet> box_panels(const Comparison& comparison);
/// Whiskers end at the last values within 1.5 times the quartiles' distance from the quartiles, the others are outliers
/// (Tukey 1977). Nothing of no values.
std::optional<BoxFigures> box_figures_of(std::vector<double> values);
/// What box_panels() leaves out; empty: nothing.
std::string note_on_box_plots(const Comparison& comparison);

/// How planners are called in the log of OMPL's benchmarks, and what all runs had in common.
struct OmplExperiment {
  std::string name;      ///< no blanks
  std::string hostname;  ///< of the machine
  std::string date;      ///< when it began
  std::string setup;     ///< any text
  std::uint64_t seed = 1;
  double budget_s = 0.0;        ///< of a run; 0: none
  std::uint64_t memory_mb = 0;  ///< of a run
  double total_s = 0.0;         ///< all of it
};

/// The text format of OMPL's benchmarks (ompl_benchmark_statistics.py and Planner Arena read it), with OMPL's names of
/// properties.
std::string ompl_log(const Comparison& comparison, const OmplExperiment& experiment);

}  // namespace warren::studies
