// SPDX-License-Identifier: BSD-3-Clause
// What `warren scale` says: a table, warren.scale/1, CSV with a run a line, and a page with plots.
#pragma once

#include <span>
#include <string>

#include "apps/studies/scaling_study.hpp"
#include "apps/studies/study_report.hpp"
#include "scenes/files/human_units.hpp"

namespace warren::studies {

std::string scaling_summary(const ScalingResult& result, const Palette& palette);
std::string scaling_json(const ScalingOptions& options, const ScalingResult& result);
std::string scaling_csv(const ScalingResult& result);

/// "repeats of one maze differ by 3 % in the median, by 12 % at most"
std::string noise_text(std::span<const ScalingRow> rows);

/// A line a contender and number of threads, a column a stage: exponents of its least times against cells.
TextTable exponent_table(std::span<const ScalingRow> rows);

/// A self-contained HTML page (scaling_report.cpp): plots drawn in it, no script, nothing loaded from anywhere.
std::string scaling_page(const ScalingResult& result, const std::string& command_line);

}  // namespace warren::studies
