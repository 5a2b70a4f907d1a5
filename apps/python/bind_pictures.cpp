// SPDX-License-Identifier: BSD-3-Clause
// Worlds, answers and roadmaps as SVG, HTML, PNG and PDF, and what a planner made as arrays, for plots.
#include <pybind11/stl.h>

#include "apps/python/bind.hpp"
#include "pictures/draw_answer.hpp"
#include "pictures/formats/write_picture.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/answer/world_account.hpp"
#include "tools/words/question_words.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

tools::Command drawing() { return command_of("picture", {tools::picture_option_specs()}); }

PictureOptions options_of(const std::string& format, const py::dict& keywords) {
  return tools::picture_words(arguments_of(made_once<drawing>(), keywords), true, "", "picture." + format);
}

std::string drawn(const Picture& picture, const std::string& format, const PictureOptions& options,
                  const Execution& execution) {
  std::string text;
  const Write write = [&](std::string_view piece) { text += piece; };
  const auto writer = format == "png"    ? write_png
                      : format == "pdf"  ? write_pdf
                      : format == "html" ? write_html
                                         : write_svg;
  writer(picture, options, execution, write);
  return text;
}

py::bytes picture_of_world(const Scene& scene, const std::string& format, const py::dict& keywords) {
  const PictureOptions options = options_of(format, keywords);
  return CallLimits().run([&](const Execution& execution) {
    std::optional<Scene> copy;
    const Scene& shown = with_map_walls(scene, copy, execution);
    Picture picture{.scene = shown, .start = plane_point(scene.start), .goal = plane_point(scene.goal)};
    picture.title = description_of(scene);
    if (options.heading) add_heading_of_world(picture, shown, *options.heading, execution);
    return drawn(picture, format, options, execution);
  });
}

py::bytes picture_of_answer(const KeptAnswer& kept, const Scene& scene, const std::string& format, bool moving,
                            const py::dict& keywords) {
  const PictureOptions options = options_of(format, keywords);
  return CallLimits().run([&](const Execution& execution) {
    std::optional<Scene> copy;
    const Scene& shown = with_map_walls(scene, copy, execution);
    Picture picture = drawing_of(shown, kept.answer, kept.made, execution, options.heading);
    if (kept.made.roadmap.states.empty()) picture.roadmap.reset();  // nothing was kept: no empty layers
    if (moving && !kept.answer.path.empty()) animate(picture);
    return drawn(picture, format, options, execution);
  });
}

py::bytes picture_of_roadmap(KeptRoadmap& kept, const std::string& format, const py::dict& keywords) {
  const PictureOptions options = options_of(format, keywords);
  const Asking asking(kept);
  return CallLimits().run([&](const Execution& execution) {
    std::string text;
    draw_roadmap(kept.roadmap(), "", options.heading, execution,
                 [&](const Picture& picture) { text = drawn(picture, format, options, execution); });
    return text;
  });
}

/// (n, 2, 2): where each edge of the graph, or of the search, begins and ends.
template <class State>
void add_segments(const PlannedRoadmap<State>& made, bool tree, RawVector<double>& segments) {
  const auto add = [&](VertexId from, VertexId to) {
    for (const VertexId v : {from, to}) segments.insert(segments.end(), {made.states[v].x, made.states[v].y});
  };
  if (tree) {
    for (const Edge& edge : made.search_tree) add(edge.from, edge.to);
    return;
  }
  for (const Edge& edge : made.motions) add(edge.from, edge.to);
  if (made.motions.empty()) made.graph.for_each_edge(add);
}

py::array segments_of(const KeptAnswer& kept, bool tree) {
  RawVector<double> segments;
  add_segments(kept.made.roadmap, tree, segments);
  for (const auto& made : kept.made.trees) add_segments(made, tree, segments);
  for (const auto& made : kept.made.pose_roadmaps) add_segments(made, tree, segments);
  return array_of<double>(std::move(segments), {2, 2});
}

/// name: chains of points.
py::dict lines_of(const KeptAnswer& kept) {
  py::dict all;
  for (const NamedLines& named : kept.made.lines) {
    py::list chains;
    for (std::size_t i = 0; i < named.lines.size(); ++i) {
      const std::span<const Vec2> chain = named.lines[i];
      std::vector<Vec2> points(chain.begin(), chain.end());
      if (named.closed && !points.empty()) points.push_back(points.front());
      chains.append(array_of<double>(std::move(points), {2}));
    }
    all[py::str(named.name)] = chains;
  }
  return all;
}

/// The body's outline around its reference point, (n, 2), and its radius.
py::tuple body_of(const Answer& answer) {
  const RobotSpec& robot = answer.problem.robot;
  return py::make_tuple(array_of<double>(robot.outline, {2}), robot.radius);
}

}  // namespace

void bind_pictures(py::module_& module) {
  module.def("picture_of_world", &picture_of_world);
  module.def("picture_of_answer", &picture_of_answer);
  module.def("picture_of_roadmap", &picture_of_roadmap);
  module.def("write_file", [](const std::string& file, const py::bytes& bytes) {
    CallLimits().run(
        [&, text = std::string_view(bytes)](const Execution& execution) { write_file(file, text, execution); });
  });
  module.def("picture_keywords", [] { return keyword_table(made_once<drawing>()); });
  module.def("segments_of", &segments_of);
  module.def("lines_of", &lines_of);
  module.def("body_of", [](const KeptAnswer& kept) { return body_of(kept.answer); });
}

}  // namespace warren::python
