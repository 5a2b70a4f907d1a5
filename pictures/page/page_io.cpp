// SPDX-License-Identifier: BSD-3-Clause
// A picture as a page of its own: what it shows as arrays of numbers in base64, and a script that draws them. Written
// in pieces: memory stays small whatever the world.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/printable.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "pictures/formats/markup.hpp"
#include "pictures/formats/raster.hpp"
#include "pictures/formats/surface.hpp"
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string encoded(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const unsigned three = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    text += digits[three >> 18U];
    text += digits[three >> 12U & 63U];
    text += i + 1 < bytes.size() ? digits[three >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? digits[three & 63U] : '=';
  }
  return text;
}

const EmbeddedFile& file_named(std::string_view name) {
  const auto files = page_files();
  return *std::find_if(files.begin(), files.end(), [&](const EmbeddedFile& file) { return file.name == name; });
}

/// "'sha256-…'": what a policy names a script by.
std::string source_of(std::string_view script) {
  const std::string_view hex = file_named(script).sha256;
  std::string bytes;
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes += static_cast<char>(16 * digit(hex[i]) + digit(hex[i + 1]));
  }
  return "'sha256-" + encoded(bytes) + "'";
}

// Numbers as pages hold them: {"type": "f32", "data": base64}, little-endian, written in pieces.

static_assert(std::endian::native == std::endian::little, "the arrays of pages are little-endian");

/// A member of a JSON object that has one before it: begun by the constructor, ended by end(). add() throws Stopped.
template <class T>
class NumberArray {
 public:
  NumberArray(std::string_view name, const Execution& execution, const Write& write)
      : execution_(execution), write_(write), base64_(write) {
    constexpr char kind = std::is_floating_point_v<T> ? 'f' : std::is_unsigned_v<T> ? 'u' : 'i';
    write_(fmt::format(",\"{}\":{{\"type\":\"{}{}\",\"data\":\"", name, kind, 8 * sizeof(T)));
  }
  /// Numbers and points, in this order.
  template <class... Some>
  void add(const Some&... some) {
    (add_one(some), ...);
  }
  void end() {
    flush();
    base64_.end();
    write_("\"}");
  }

 private:
  template <class Number>
  void add_one(Number number) {
    constexpr std::size_t piece = 1U << 16U;
    const auto value = static_cast<T>(number);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    if (bytes_.size() >= piece) flush();
  }
  void add_one(Vec2 p) { add(p.x, p.y); }
  void add_one(const Vec3& p) { add(p.x(), p.y(), p.z()); }
  void flush() {
    execution_.check();
    base64_.write(bytes_);
    bytes_.clear();
  }

  const Execution& execution_;
  const Write& write_;
  Base64 base64_;
  std::string bytes_;
};

/// Does the page's script draw an arm in perspective, where it is on its way? Else its perspective is an image.
bool moves_arm(const Picture& picture, Parts parts) {
  return picture.solids && picture.arm && !picture.arm->spines.empty() && parts.has(Part::body);
}

constexpr std::size_t most_drawn_walls = 4'000'000;

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
    write_("<script id=\"picture\" type=\"application/json\">");
    words(title);
    layers();
    if (picture_.roadmap && picture_.panels.empty()) graph(*picture_.roadmap);
    if (parts_.has(Part::path)) path();
    if (moves_arm(picture_, parts_)) arm();
    write_("}</script>\n");
    for (const std::string_view script : scripts) write_(script_element(script));
    write_("</body>\n</html>\n");
    if (!parts_.has(Part::world) || picture_.scene.walls.size() <= most_drawn_walls) return {};
    return {"as pixels, being so many: walls"};
  }

 private:
  void words(const std::string& title) {
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
    begin("", words);
  }

  void graph(const PlannedRoadmap<Vec2>& roadmap) {
    const std::vector<std::uint8_t> component = component_colors(roadmap.graph, execution_);
    if (component.size() != roadmap.states.size()) return;  // stopped before the graph was made
    Json about{
        {"colors", Json::array()},
        {"treeColor", css_color(colors::search_tree)},
        {"hasRoadmap", parts_.has(Part::roadmap)},
        {"widths", {{"edges", widths::edge}, {"milestones", widths::milestone}, {"search_tree", widths::search_tree}}}};
    for (const Rgb color : colors::components) about["colors"].push_back(css_color(color));
    begin(",\"graph\":", about);
    numbers<float>("states", roadmap.states, [this](Vec2 p) { return moved(p); });
    numbers<std::uint8_t>("component", component);
    auto edges = numbers<std::uint32_t>("edges");
    roadmap.graph.for_each_edge([&](VertexId v, VertexId w) { edges.add(v, w); });
    edges.end();
    if (parts_.has(Part::search) && !roadmap.search_tree.empty()) {
      execution_.reserve(roadmap.states.size() * sizeof(std::int32_t));
      std::vector<std::int32_t> parent(roadmap.states.size(), -1);
      for (const Edge& edge : roadmap.search_tree) {
        parent[edge.from] = static_cast<std::int32_t>(edge.to == no_vertex ? edge.from : edge.to);
      }
      numbers<std::int32_t>("parent", parent);
    }
    write_("}");
  }

  void path() {
    if (picture_.path.empty()) return;
    numbers<double>("path", without_arcs(picture_.path, picture_.path_turns), [this](Vec2 p) { return moved(p); });
    const MovingBody point;
    const MovingBody& body = parts_.has(Part::body) ? picture_.body : point;
    Json outline = Json::array();
    for (const Vec2 p : body.outline) outline.push_back({p.x, p.y});
    write_(",\"body\":" + Json{{"outline", outline}, {"radius", body.radius}, {"heads", body.heads}}.dump());
    if (!body.poses.empty()) poses(body);
  }
  /// x, y, heading and moment of as many places as arcs have chords, or turns on the spot few degrees.
  void poses(const MovingBody& body) {
    constexpr double step_rad = 0.05;
    const Timetable table = timetable_of(body);
    auto out = numbers<double>("poses");
    out.add(moved(body.poses.front().position()), body.poses.front().theta, 0.0);
    for (std::size_t i = 1; i < body.poses.size(); ++i) {
      const Se2& from = body.poses[i - 1];
      const Se2& to = body.poses[i];
      const double turn = turn_between(from.theta, to.theta);
      const double arc = picture_.path_turns.empty() ? 0.0 : picture_.path_turns[i];
      std::vector<Vec2> way = without_arcs(std::array{from.position(), to.position()}, std::array{0.0, arc});
      if (way.size() == 2) {
        const double parts = std::max(1.0, std::ceil(std::abs(turn) / step_rad));
        way = {from.position()};
        for (double part = 1.0; part <= parts; part += 1.0) {
          way.push_back(from.position() + part / parts * (to.position() - from.position()));
        }
      }
      for (std::size_t k = 1; k < way.size(); ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(way.size() - 1);
        out.add(moved(way[k]), from.theta + share * turn,
                table.moments[i - 1] + share * (table.moments[i] - table.moments[i - 1]));
      }
    }
    out.end();
  }

  void layers() {
    const auto add_layers = [&](bool of_world) {
      for (const PictureLayer& one : picture_.layers) {
        if ((one.part == Part::world) == of_world && parts_.has(one.part) && !one.lines.empty()) layer(one);
      }
    };
    write_(",\"layers\":[");
    add_layers(true);
    if (parts_.has(Part::world) && !picture_.scene.polygons.empty()) polygons();
    add_layers(false);
    if (parts_.has(Part::world)) walls();
    if (picture_.solids && !moves_arm(picture_, parts_)) perspective(*picture_.solids);
    write_("]");
  }
  void polygons() {
    const std::vector<ScenePolygon>& all = picture_.scene.polygons;
    begin_layer({{"id", "polygons"},
                 {"label", "obstacles"},
                 {"kind", "areas"},
                 {"obstacle", true},
                 {"color", css_color(colors::polygon)},
                 {"outline", css_color(colors::outline)},
                 {"width", widths::outline}});
    auto first = numbers<std::uint32_t>("first");
    std::size_t corners = 0;
    first.add(corners);
    for (const ScenePolygon& polygon : all) first.add(corners += anticlockwise(polygon.corners).size());
    first.end();
    auto xy = numbers<float>("xy");
    for (const ScenePolygon& polygon : all) {
      for (const Vec2 p : anticlockwise(polygon.corners)) xy.add(moved(p));
    }
    xy.end();
    write_("}");
  }

  void layer(const PictureLayer& layer) {
    std::string label = layer.label;
    if (label.empty()) {
      label = layer.id;
      std::replace(label.begin(), label.end(), '_', ' ');
    }
    Json about{{"id", layer.id},
               {"label", std::move(label)},
               {"kind", layer.fill ? "areas" : "chains"},
               {"obstacle", layer.part == Part::world && layer.fill && layer.blocks},
               {"color", css_color(layer.fill.value_or(layer.color))},
               {"width", layer.width},
               {"closed", layer.closed || layer.fill},
               {"opacity", layer.opacity}};
    if (layer.fill && layer.width > 0.0) about["outline"] = css_color(layer.color);
    if (!layer.opacities.empty()) about["opacities"] = layer.opacities;
    begin_layer(about);
    std::vector<std::uint32_t> first{0};
    auto xy = numbers<float>("xy");
    for (std::size_t i = 0; i < layer.lines.size(); ++i) {
      const std::vector<Vec2> chain = without_arcs(layer.lines[i], layer.turns_of(i));
      for (const Vec2 p : chain) xy.add(moved(p));
      first.push_back(first.back() + static_cast<std::uint32_t>(chain.size()));
    }
    xy.end();
    numbers<std::uint32_t>("first", first);
    write_("}");
  }

  void walls() {
    const std::size_t count = picture_.scene.walls.size();
    if (count == 0 && !picture_.scene.bounds) return;
    Json about{{"id", "walls"},
               {"label", picture_.scene.map         ? "borders of blocked cells"
                         : count == 0               ? "bounds"
                         : count > most_drawn_walls ? "walls, as pixels"
                                                    : "walls"},
               {"obstacle", picture_.panels.empty()},
               {"color", css_color(colors::wall)},
               {"width", widths::wall}};
    if (count > most_drawn_walls) {
      about["count"] = count;
      begin_layer(about);
      return wall_image();
    }
    about["kind"] = "segments";
    begin_layer(about);
    has_small_whole_walls() ? wall_ends<std::uint16_t>() : wall_ends<float>();
    write_("}");
  }

  template <class T>
  void wall_ends() {
    auto xy = numbers<T>("xy");
    const auto add = [&](const Segment& s) { xy.add(moved(s.a), moved(s.b)); };
    picture_.scene.walls.visit([&](auto all) {
      for (const auto& wall : all) add(wall.segment());
    });
    for (const Segment& side : bounds_walls(picture_.scene)) add(side);
    xy.end();
  }

  void wall_image() {
    constexpr double most_pixels = 4096.0;
    constexpr double least_width = 0.2;
    const Box& box = canvas_.box;
    const double scale = most_pixels / std::max(box.width(), box.height());
    Mask mask(static_cast<std::size_t>(std::ceil(scale * box.width())),
              static_cast<std::size_t>(std::ceil(scale * box.height())), execution_);
    const auto at = [&](Vec2 p) { return Vec2{scale * (p.x - box.min.x), scale * (box.max.y - p.y)}; };
    const double width = std::max(widths::wall / 20.0 * scale * canvas_.unit, least_width);
    picture_.scene.walls.visit([&](auto all) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        execution_.poll(i);
        mask.draw_line(at(all[i].segment().a), at(all[i].segment().b), width);
      }
    });
    const Vec2 top_left = moved({box.min.x, box.max.y});
    const double width_seen = static_cast<double>(mask.width()) / scale;
    const double height_seen = static_cast<double>(mask.height()) / scale;
    image_in({{top_left.x, top_left.y - height_seen}, {top_left.x + width_seen, top_left.y}},
             [&](const Write& write) { write_png_file(mask, colors::wall, execution_, write); });
  }

  /// Of an arm that doesn't move there; the page's script draws the others.
  void perspective(const SolidView& view) {
    constexpr std::size_t pixels = 1024;
    begin_layer({{"id", "perspective"}, {"label", "perspective"}, {"isOpaque", true}});
    const double scale = static_cast<double>(pixels) / std::max(view.box.width(), view.box.height());
    const Image image = draw_solids(view, parts_, static_cast<std::size_t>(std::ceil(scale * view.box.width())),
                                    static_cast<std::size_t>(std::ceil(scale * view.box.height())), execution_);
    constexpr double dots_an_inch = 96.0;
    image_in({moved(view.box.min), moved(view.box.max)},
             [&](const Write& write) { write_png_file(image, dots_an_inch, execution_, write); });
  }
  /// The rest of a layer that has begun: an image, the page's numbers for its place.
  template <class WritePng>
  void image_in(const Box& box, const WritePng& write_png) {
    write_(fmt::format(",\"kind\":\"image\",\"box\":[{},{},{},{}],\"href\":\"data:image/png;base64,", box.min.x,
                       box.min.y, box.max.x, box.max.y));
    Base64 out(write_);
    write_png([&](std::string_view bytes) { out.write(bytes); });
    out.end();
    write_("\"}");
  }
  /// The arm and its solids; places are relative to the view's target.
  void arm() {
    const SolidView& solids = *picture_.solids;
    const MovingArm& arm = *picture_.arm;
    begin(",\"arm\":", arm_facts());
    const auto place = [&](const Vec3& p) -> Vec3 { return p - solids.target; };
    const auto shown = [&](std::string_view name, const auto& add_its_kind) {
      auto out = numbers<float>(name);
      for (const SeenSolid& s : solids.solids) {
        if (parts_.has(s.part)) add_its_kind(out, s);
      }
      out.end();
    };
    shown("spheres", [&](auto& out, const SeenSolid& s) {
      if (s.part == Part::world && s.radius >= 0.0) out.add(place(s.a), s.radius);
    });
    shown("boxes", [&](auto& out, const SeenSolid& s) {
      if (s.radius < 0.0 && !s.c) out.add(place(s.a), place(s.b));
    });
    shown("faces", [&](auto& out, const SeenSolid& s) {
      if (s.part == Part::world && s.c) out.add(place(s.a), place(s.b), place(*s.c));
    });
    auto links = numbers<float>("links");
    for (const MovingArm::Link& link : arm.links) {
      for (const SeenSolid& s : link.shapes) links.add(link.frame, s.radius, s.a, s.b, s.c.value_or(s.a));
    }
    links.end();
    auto frames = numbers<float>("frames");
    for (const std::vector<Eigen::Isometry3d>& posture : arm.frames) {
      for (const Eigen::Isometry3d& frame : posture) {
        for (int axis = 0; axis < 3; ++axis) frames.add(Vec3(frame.linear().col(axis)));
        frames.add(place(frame.translation()));
      }
    }
    frames.end();
    numbers<float>("tools", parts_.has(Part::path) ? arm.tools : std::vector<Vec3>{}, place);
    auto spines = numbers<float>("spines");
    for (const std::vector<Vec3>& spine : arm.spines) {
      for (const Vec3& end : spine) spines.add(place(end));
    }
    spines.end();
    numbers<double>("moments", arm.moments);
    write_("}");
  }

  Json arm_facts() const {
    const SolidView& solids = *picture_.solids;
    const MovingArm& arm = *picture_.arm;
    const Vec3 floor = solids.floor - solids.target;
    Json about{{"box", box_json(solids.box)},
               {"reach", solids.reach},
               {"azimuth", solids.azimuth_rad},
               {"rise", solids.rise_rad},
               {"floor", {floor.x(), floor.y(), floor.z()}},
               {"floorSide", solids.floor_side},
               {"square", solids.square},
               {"radius", arm.radius},
               {"least", least_radius * solids.reach},
               {"ends", arm.spines.front().size()},
               {"joints", arm.frames.empty() ? 0 : arm.frames.front().size()},
               {"colors",
                {{"solid", css_color(colors::blocked_cell)},
                 {"start", css_color(colors::start)},
                 {"goal", css_color(colors::goal)},
                 {"moving", css_color(colors::path)}}},
               {"views", Json::array()}};
    for (const Projection& view : arm.views) {
      const Vec2 zero = moved(view.at(solids.target));
      about["views"].push_back({view.axes[0], view.axes[1], zero.x, zero.y});
    }
    return about;
  }

  /// The object as it may stand in a <script>; its end is left open.
  void begin(std::string_view before, const Json& object) {
    std::string text{before};
    for (const char c : object.dump(-1, ' ', true, Json::error_handler_t::replace)) {
      text += c == '<' ? std::string_view("\\u003c") : std::string_view(&c, 1);
    }
    text.pop_back();
    write_(text);
  }
  void begin_layer(const Json& about) { begin(std::exchange(between_, ","), about); }
  template <class T>
  NumberArray<T> numbers(std::string_view name) const {
    return {name, execution_, write_};
  }
  /// of(one): the number, or the point, of each.
  template <class T, class Range, class Of = std::identity>
  void numbers(std::string_view name, const Range& all, const Of& of = {}) const {
    auto array = numbers<T>(name);
    for (const auto& one : all) array.add(of(one));
    array.end();
  }
  Json box_json(const Box& box) const {
    const Vec2 low = moved(box.min);
    const Vec2 high = moved(box.max);
    return Json{low.x, low.y, high.x, high.y};
  }
  bool has_small_whole_walls() const {
    constexpr double most = 65535.0;
    const auto fits = [](double x) { return x >= 0.0 && x <= most && x == std::floor(x); };
    const auto all_fit = [&](Vec2 p) { return fits(moved(p).x) && fits(moved(p).y); };
    if (picture_.scene.bounds && !(all_fit(picture_.scene.bounds->min) && all_fit(picture_.scene.bounds->max)))
      return false;
    return picture_.scene.walls.visit([&](auto all) {
      return std::ranges::all_of(
          all, [&](const auto& wall) { return all_fit(wall.segment().a) && all_fit(wall.segment().b); });
    });
  }
  Vec2 moved(Vec2 p) const { return p - origin_; }

  const Picture& picture_;
  Parts parts_;
  const Execution& execution_;
  const Write& write_;
  Canvas canvas_;
  Vec2 origin_;                    // numbers are relative to it, so that floats are enough
  std::string_view between_ = "";  // layers
};

}  // namespace

std::string seen_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::string_view character = text.substr(0, std::max<std::size_t>(utf8_bytes(text), 1));
    const bool is_seen = character == "\n" || printable(character) == character;
    out += is_seen ? character : std::string_view("?");
    text.remove_prefix(character.size());
  }
  return out;
}

std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : seen_text(text)) {
    const std::string_view piece(&c, 1);
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : piece;
  }
  return out;
}

std::string css_color(Rgb c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

void Base64::write(std::string_view bytes) {
  left_ += bytes;
  const std::size_t whole = left_.size() / 3 * 3;
  if (whole == 0) return;
  write_(encoded(std::string_view(left_).substr(0, whole)));
  left_.erase(0, whole);
}

void Base64::end() { write_(encoded(left_)); }

std::string_view page_file(std::string_view name) { return file_named(name).bytes; }

std::string script_element(std::string_view name) { return fmt::format("<script>{}</script>\n", page_file(name)); }

std::string head_of_page(const std::string& title, std::string_view style, std::span<const std::string_view> scripts) {
  std::string sources;
  for (const std::string_view script : scripts) sources += " " + source_of(script);
  return fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src{}; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'">
<link rel="icon" href="data:,">
<title>{}</title>
<style>
{}</style>
</head>
)",
                     sources, xml_text(title), style);
}

std::vector<std::string> write_html(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                    const Write& write) {
  return PageWriter(picture, options.parts, execution, write).document(options.title.value_or(picture.title));
}

}  // namespace warren
