// SPDX-License-Identifier: BSD-3-Clause
// The files that a verb writes. What their endings say, whether they can be written, and that none is a file which is
// read or written otherwise, is asked before a long computation; reports and plots are written where they are asked
// for.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "pictures/plots/plot.hpp"
#include "scenes/scene/scene.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// Throws WriteError if `path` can't be written as things stand. Creates and changes nothing.
void check_writable(const std::string& path);

/// Throws UsageError where the file's ending promises a picture that this build does not write; no ending promises
/// nothing.
void check_picture(std::string_view option, const std::string& file);

/// The file that an option names, if it is given; check_writable has been asked.
std::optional<std::string> output_file(const Arguments& arguments, std::string_view option);

/// Throws WriteError unless each file that these options name can be written.
void check_reports(const Arguments& arguments, std::initializer_list<std::string_view> options);

/// Writes what `text` makes to the file that an option names, if it is given; whatever has stopped meanwhile.
void write_report(const Arguments& arguments, std::string_view option, const std::function<std::string()>& text);

/// Throws UsageError unless --picture, --figures and --curves, where they are given, name files that plots can be
/// written to.
void check_plots(const Arguments& arguments);
/// Writes plots to the file that the option names, if it is given, and with --picture each to one of its own by
/// --figures: "k.pdf" becomes "k-length.pdf", by its title; of a run that was stopped, too: within its memory alone.
void write_plots(const Arguments& arguments, const Execution& execution, bool was_stopped,
                 const std::function<PlotsPage()>& plots, std::string_view option = "--picture");

/// Says on standard error what is drawn otherwise than usual, if anything is and --quiet is not given.
void say_of_picture(const Arguments& arguments, const std::string& file, const std::vector<std::string>& notes);

// No verb writes a file that it reads, or the same file twice. Files are compared as files (device and inode, links
// followed), what is not there yet as the name in its folder: "m.scene" is "./m.scene" and every link to it.

/// Throws UsageError where an output that the command line names is one of its inputs or another of its outputs, or
/// where standard output is to take two or standard input to give two.
void check_outputs(const Arguments& arguments);

/// The same for a file that the command line does not name such as a map's image. Empty: no file.
void check_not_written(const Arguments& arguments, const std::string& input);
/// The same for an arm's table, or its URDF and SRDF, and for masks and the images of those that have been read.
void check_not_written(const Arguments& arguments, const std::optional<RobotSpec>& robot, const Prices& prices = {});

/// Is one of the outputs that the command line names standard output, by whatever name?
bool takes_standard_output(const Arguments& arguments);

}  // namespace warren::tools
