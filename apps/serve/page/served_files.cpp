// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/page/served_files.hpp"

namespace warren::serve {
namespace {

std::string_view type_of(std::string_view name) {
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (name.ends_with(".txt")) return "text/plain; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  return "text/html; charset=utf-8";
}

}  // namespace

std::optional<ServedFile> served_file(std::string_view name) {
#ifdef WARREN_LEAFLET
  for (const std::span<const EmbeddedFile> folder : {service_page_files(), leaflet_files()}) {
    for (const auto& file : folder) {
      if (file.name == name) return ServedFile{type_of(name), file.bytes, file.sha256.substr(0, 16)};
    }
  }
#else
  if (name == "index.html") {
    return ServedFile{type_of(".txt"),
                      "This program was built without Leaflet (Debian: libjs-leaflet), so it shows no page. "
                      "Programs ask /api/world and what docs/service.md says of it.\n",
                      "without-leaflet"};
  }
#endif
  return std::nullopt;
}

}  // namespace warren::serve
