// SPDX-License-Identifier: BSD-3-Clause
// The world that most tests of the service ask, and scenes from their text.
#pragma once

#include <string>

#include "scenes/files/read_world_io.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren::serve {

inline constexpr const char* town =
    "bounds 0 0 100 60\nwall 10 10 50 40\npolygon 60 10 90 10 90 50 60 50\nstart 5 30\ngoal 95 30\n";

inline Scene scene_of(const std::string& text) { return read_scene(InputFile::of_bytes("test.scene", text), {}); }

}  // namespace warren::serve
