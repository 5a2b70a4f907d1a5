// SPDX-License-Identifier: BSD-3-Clause
// What stands under a picture's title: the world, the body, how it was solved and what came of it. A line each.
#pragma once

#include <string>

#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/read_answer_io.hpp"

namespace warren {

/// The world's name, without its folder.
std::string title_of(const Scene& scene);

std::string subtitle_of(const Scene& scene, const Answer& answer);
std::string subtitle_of(const Scene& scene, const RecordedAnswer& answer);

/// The world and the body in it.
std::string subtitle_of(const Scene& scene, const RobotSpec& robot);

}  // namespace warren
