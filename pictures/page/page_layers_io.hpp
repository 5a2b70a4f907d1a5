// SPDX-License-Identifier: BSD-3-Clause
// What a page shows of a picture's world and layers, as the member "layers" of its JSON. Of walls by the million, which
// no browser would draw at once, there is an image.
#pragma once

#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/picture.hpp"

namespace warren {

/// "#1e293b"
std::string css_color(Rgb color);

/// JSON as it may stand in a <script>.
std::string in_script(std::string_view json);

/// `canvas`: the picture's. Numbers are relative to `origin`. Returns what is drawn otherwise than usual, as
/// write_html() does. Throws Stopped, and what `write` throws.
std::vector<std::string> write_page_layers(const Picture& picture, Parts parts, const Canvas& canvas, Vec2 origin,
                                           const Execution& execution, const Write& write);

}  // namespace warren
