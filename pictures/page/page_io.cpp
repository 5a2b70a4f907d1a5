// SPDX-License-Identifier: BSD-3-Clause
// A picture as a page of its own: what it shows as arrays of numbers in base64, and a script that draws them. Written
// in pieces: memory stays small whatever the world.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "pictures/formats/svg_animation.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/picture.hpp"
#include "pictures/model/xml_text.hpp"
#include "pictures/page/number_array.hpp"
#include "pictures/page/page_arm_io.hpp"
#include "pictures/page/page_files.hpp"
#include "pictures/page/page_layers_io.hpp"
#include "scenes/scene/unit_of.hpp"

namespace warren {
namespace {

using Json = nlohmann::ordered_json;

/// Near the box's lower left corner, and a whole number of units from the walls where they are so from each other.
Vec2 origin_of(const WallSet& walls, const Box& box) {
  const Vec2 some = walls.size() > 0 ? walls.segment(0).a : Vec2{};
  return some + Vec2{std::floor(box.min.x - some.x), std::floor(box.min.y - some.y)};
}

class PageWriter {
 public:
  PageWriter(const Picture& picture, Parts parts, const Execution& execution, const Write& write)
      : picture_(picture),
        parts_(parts),
        execution_(execution),
        write_(write),
        canvas_(canvas_of(picture, execution)),
        origin_(origin_of(picture.scene.walls, canvas_.box)) {}

  std::vector<std::string> document(const std::string& title) {
    static constexpr std::string_view scripts[] = {"data.js", "view.js",    "marks.js",
                                                   "arm.js",  "pointer.js", "controls.js"};
    write_(head_of_page(title, page_file("page.css"), scripts));
    write_(page_file("page.html"));
    write_("<script id=\"picture\" type=\"application/json\">{");
    words(title);
    std::vector<std::string> notes = write_page_layers(picture_, parts_, canvas_, origin_, execution_, write_);
    if (picture_.roadmap != nullptr && picture_.panels.empty()) graph(*picture_.roadmap);
    if (parts_.has(Part::path)) path();
    if (moves_arm(picture_, parts_)) write_page_arm(picture_, parts_, origin_, execution_, write_);
    write_("}</script>\n");
    for (const std::string_view script : scripts) write_(script_element(script));
    write_("</body>\n</html>\n");
    return notes;
  }

 private:
  void words(const std::string& title);
  void graph(const PlannedRoadmap<Vec2>& roadmap);
  void path();
  void poses(const MovingBody& body);

  template <class T>
  NumberArray<T> numbers(std::string_view name) const {
    return {name, execution_, write_};
  }
  Vec2 moved(Vec2 p) const { return p - origin_; }

  const Picture& picture_;
  Parts parts_;
  const Execution& execution_;
  const Write& write_;
  Canvas canvas_;
  Vec2 origin_;  // numbers are relative to it, so that floats are enough
};

void PageWriter::words(const std::string& title) {
  const auto box_json = [&](const Box& box) {
    const Vec2 low = moved(box.min);
    const Vec2 high = moved(box.max);
    return Json{low.x, low.y, high.x, high.y};
  };
  Json words{{"title", seen_text(title)},
             {"about", seen_text(picture_.subtitle)},
             {"origin", {origin_.x, origin_.y}},
             {"box", box_json(canvas_.box)},
             {"unit", canvas_.unit},
             {"lengthUnit", unit_of(picture_.scene)},
             {"pathColor", css_color(colors::path)},
             {"pathWidth", widths::path},
             {"pathLabel", picture_.path_label},
             {"panels", Json::array()},
             {"ends", Json::object()}};
  for (const AxesPanel& panel : picture_.panels) {
    words["panels"].push_back({{"box", box_json(panel.box)},
                               {"x", panel.x_label},
                               {"y", panel.y_label},
                               {"origin", {moved(panel.origin).x, moved(panel.origin).y}},
                               {"hasTicks", panel.has_ticks}});
  }
  const auto end = [&](const char* name, std::optional<Vec2> at, Rgb color) {
    if (!at || !parts_.has(Part::path)) return;
    words["ends"][name] = {{"x", moved(*at).x}, {"y", moved(*at).y}, {"color", css_color(color)}};
  };
  end("start", picture_.start, colors::start);
  end("goal", picture_.goal, colors::goal);
  std::string text = in_script(words.dump(-1, ' ', true, Json::error_handler_t::replace));
  text.pop_back();
  write_(text.substr(1));
}

void PageWriter::graph(const PlannedRoadmap<Vec2>& roadmap) {
  const std::vector<std::uint8_t> component = component_colors(roadmap.graph, execution_);
  if (component.size() != roadmap.states.size()) return;  // stopped before the graph was made
  Json about{
      {"colors", Json::array()},
      {"treeColor", css_color(colors::search_tree)},
      {"hasRoadmap", parts_.has(Part::roadmap)},
      {"widths", {{"edges", widths::edge}, {"milestones", widths::milestone}, {"search_tree", widths::search_tree}}}};
  for (const Rgb color : colors::components) about["colors"].push_back(css_color(color));
  std::string text = about.dump();
  text.pop_back();
  write_(",\"graph\":" + text);
  auto states = numbers<float>("states");
  for (const Vec2 p : roadmap.states) states.add(moved(p));
  states.end();
  auto colors = numbers<std::uint8_t>("component");
  for (const std::uint8_t color : component) colors.add(color);
  colors.end();
  auto edges = numbers<std::uint32_t>("edges");
  for (VertexId v = 0; v < roadmap.graph.vertex_count(); ++v) {
    for (const VertexId w : roadmap.graph.neighbours(v)) {
      if (w < v) continue;
      edges.add(v);
      edges.add(w);
    }
  }
  edges.end();
  if (parts_.has(Part::search) && !roadmap.search_tree.empty()) {
    execution_.reserve(roadmap.states.size() * sizeof(std::int32_t));
    std::vector<std::int32_t> parent(roadmap.states.size(), -1);
    for (const Edge& edge : roadmap.search_tree) {
      parent[edge.from] = static_cast<std::int32_t>(edge.to == no_vertex ? edge.from : edge.to);
    }
    auto parents = numbers<std::int32_t>("parent");
    for (const std::int32_t v : parent) parents.add(v);
    parents.end();
  }
  write_("}");
}

void PageWriter::path() {
  if (picture_.path.empty()) return;
  auto xy = numbers<double>("path");
  for (const Vec2 p : without_arcs(picture_.path, picture_.path_turns)) xy.add(moved(p));
  xy.end();
  const MovingBody point;
  const MovingBody& body = picture_.body != nullptr && parts_.has(Part::body) ? *picture_.body : point;
  Json outline = Json::array();
  for (const Vec2 p : body.outline) outline.push_back({p.x, p.y});
  write_(",\"body\":" + Json{{"outline", outline}, {"radius", body.radius}, {"heads", body.heads}}.dump());
  if (!body.poses.empty()) poses(body);
}

/// x, y, heading and moment of as many places as arcs have chords, or turns on the spot few degrees.
void PageWriter::poses(const MovingBody& body) {
  constexpr double step_rad = 0.05;
  const Timetable table = timetable_of(body);
  auto out = numbers<double>("poses");
  const auto add = [&](Vec2 at, double theta, double moment) {
    out.add(at);
    out.add(theta);
    out.add(moment);
  };
  add(moved(body.poses.front().position()), body.poses.front().theta, 0.0);
  for (std::size_t i = 1; i < body.poses.size(); ++i) {
    const Se2& from = body.poses[i - 1];
    const Se2& to = body.poses[i];
    const double turn = turn_between(from.theta, to.theta);
    const double arc = picture_.path_turns.empty() ? 0.0 : picture_.path_turns[i];
    std::vector<Vec2> way = without_arcs(std::array{from.position(), to.position()}, std::array{0.0, arc});
    if (way.size() == 2) {
      const auto parts = static_cast<std::size_t>(std::ceil(std::abs(turn) / step_rad));
      way = {from.position()};
      for (std::size_t k = 1; k <= std::max<std::size_t>(parts, 1); ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(parts, 1));
        way.push_back(from.position() + share * (to.position() - from.position()));
      }
    }
    for (std::size_t k = 1; k < way.size(); ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(way.size() - 1);
      add(moved(way[k]), from.theta + share * turn,
          table.moments[i - 1] + share * (table.moments[i] - table.moments[i - 1]));
    }
  }
  out.end();
}

}  // namespace

std::vector<std::string> write_html(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                    const Write& write) {
  return PageWriter(picture, options.parts, execution, write).document(options.title.value_or(picture.title));
}

}  // namespace warren
