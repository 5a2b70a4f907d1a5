// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/exports/export_roadmap.hpp"

#include <array>
#include <string_view>

#include "core/base/error.hpp"
#include "roadmaps/exports/roadmap_formats_io.hpp"

namespace warren {
namespace {

using Files = std::vector<std::string>;

struct ExportFormat {
  std::string_view ending;
  std::string_view second_ending;  ///< of the file beside it, if there is one
  ExportAccount (*write)(const ExportedRoadmapView&, const Files&, const Execution&);
};

template <ExportAccount (*write)(const ExportedRoadmapView&, const std::string&, const Execution&)>
ExportAccount write_one(const ExportedRoadmapView& roadmap, const Files& files, const Execution& execution) {
  return write(roadmap, files.front(), execution);
}
template <ExportAccount (*write)(const ExportedRoadmapView&, const std::string&, const std::string&, const Execution&)>
ExportAccount write_two(const ExportedRoadmapView& roadmap, const Files& files, const Execution& execution) {
  return write(roadmap, files.front(), files.back(), execution);
}

constexpr std::array<ExportFormat, 6> formats{{{".geojson", "", write_one<write_roadmap_geojson>},
                                               {".graphml", "", write_one<write_roadmap_graphml>},
                                               {".gr", ".co", write_two<write_roadmap_dimacs>},
                                               {".csv", ".edges.csv", write_two<write_roadmap_csv>},
                                               {".npz", "", write_one<write_roadmap_npz>},
                                               {".dot", "", write_one<write_roadmap_dot>}}};

const ExportFormat& format_of(const std::string& path) {
  std::string endings;
  for (const ExportFormat& format : formats) {
    if (path.ends_with(format.ending)) return format;
    endings.append(" ").append(format.ending);
  }
  throw UsageError(path + ": a roadmap is exported to a file that ends in one of" + endings +
                   ", and drawn by .svg .png .pdf .html");
}

}  // namespace

std::vector<std::string> files_of_export(const std::string& path) {
  const ExportFormat& format = format_of(path);
  Files files{path};
  if (!format.second_ending.empty()) {
    files.push_back(path.substr(0, path.size() - format.ending.size()).append(format.second_ending));
  }
  return files;
}

ExportAccount export_roadmap(const std::string& path, const RoadmapParts& parts, const VertexDistance& length,
                             const ExportOptions& options, const Execution& execution) {
  const Files files = files_of_export(path);
  if (execution.progress != nullptr) execution.progress->begin("export", parts.vertex_count() + 2 * parts.to.size());
  return format_of(path).write({parts, length, options}, files, execution);
}

}  // namespace warren
