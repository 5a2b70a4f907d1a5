// SPDX-License-Identifier: BSD-3-Clause
// The words of how a picture looks; for every verb that draws.
#pragma once

#include <span>

#include "pictures/model/picture_options.hpp"
#include "solve/paths/path_file_io.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// --show --heading --size --dpi --title
std::span<const OptionSpec> picture_option_specs();

/// Throws UsageError, also for any of them where nothing is drawn, `draws` names what would, such as "--picture FILE";
/// and for those that mean nothing to the picture's `file`.
PictureOptions picture_words(const Arguments& arguments, bool is_drawn, std::string_view draws,
                             std::string_view file = {});

// The words of how a path is written as a file of its own, and how fast it is driven.

/// --path and what goes with it.
std::span<const OptionSpec> path_option_specs();
/// Throws UsageError, also for what goes with --path where that is not given.
PathFileOptions path_words(const Arguments& arguments);

}  // namespace warren::tools
