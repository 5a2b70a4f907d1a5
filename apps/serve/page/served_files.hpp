// SPDX-License-Identifier: BSD-3-Clause
// The files of the page, which the build has put into the program: nothing is read from a disk.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/base/embedded_file.hpp"

namespace warren::serve {

struct ServedFile {
  std::string_view type;  ///< as Content-Type says it
  std::string_view bytes;
  std::string_view tag;  ///< another one for other bytes
};

/// Nothing where there is none of that name. Without Leaflet, index.html says so.
std::optional<ServedFile> served_file(std::string_view name);

// What the build makes of folders (cmake/embed_files.cmake).
std::span<const EmbeddedFile> service_page_files();
std::span<const EmbeddedFile> leaflet_files();

}  // namespace warren::serve
