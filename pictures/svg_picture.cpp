// SPDX-License-Identifier: BSD-3-Clause
// SVG 1.1, one merged path a layer (and a component's colour), so that files stay small: "M1 1h1" is a wall. Numbers
// have at most three decimals; worlds that are tiny, huge or far from the origin are moved into a frame where that is
// enough. Written in pieces: memory stays small whatever the world.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>

#include "pictures/picture.hpp"
#include "pictures/plot_svg.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren {
namespace {

constexpr std::size_t vertices_per_poll = 1 << 16;

std::string hex(Rgb c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

/// World to picture coordinates: moved and scaled only where three decimals would not do.
class Frame {
 public:
  explicit Frame(const Box& box) {
    const double extent = std::max(box.width(), box.height());
    if (extent > 0.0 && (extent < 5.0 || extent > 1e5)) scale_ = std::pow(10.0, 2.0 - std::floor(std::log10(extent)));
    const double far = std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
    if (scale_ != 1.0 || far > 1e5) origin_ = box.min;
  }
  Vec2 at(Vec2 p) const { return scale_ * (p - origin_); }
  double length(double l) const { return scale_ * l; }

 private:
  Vec2 origin_;
  double scale_ = 1.0;
};

/// Appends a number with at most three decimals, without trailing zeros.
void append_number(std::string& to, double value) {
  const auto thousandths = static_cast<std::int64_t>(std::llround(value * 1000.0));
  const std::int64_t size = thousandths < 0 ? -thousandths : thousandths;
  char digits[24];
  if (thousandths < 0) to += '-';
  to.append(digits, std::to_chars(digits, digits + sizeof digits, size / 1000).ptr);
  const auto fraction = static_cast<int>(size % 1000);
  if (fraction == 0) return;
  const char tail[] = {'.', static_cast<char>('0' + fraction / 100), static_cast<char>('0' + fraction / 10 % 10),
                       static_cast<char>('0' + fraction % 10)};
  to.append(tail, fraction % 10 != 0 ? 4 : fraction % 100 != 0 ? 3 : 2);
}

/// Writes one document.
class SvgWriter {
 public:
  SvgWriter(const Picture& picture, const Execution& execution, const Write& write)
      : picture_(picture),
        execution_(execution),
        write_(write),
        canvas_(canvas_of(picture, execution)),
        frame_(canvas_.box) {}

  void document() {
    open();
    polygons();
    for (const PictureLayer& layer : picture_.layers) lines(layer);
    if (picture_.roadmap != nullptr) roadmap();
    walls();
    path();
    mark("start", picture_.start, colors::start);
    mark("goal", picture_.goal, colors::goal);
    if (picture_.moving != nullptr && !picture_.path.empty()) {
      text_ += svg_moving_body(*picture_.moving, "way", frame_.length(1.0), width(widths::search_tree));
    }
    text_ += "</g>\n</svg>\n";
    flush();
  }

 private:
  void open();
  void polygons();
  void lines(const PictureLayer& layer);
  void walls();
  void roadmap();
  void edges(const std::vector<std::uint8_t>& color);
  void milestones(const std::vector<std::uint8_t>& color);
  void search_tree();
  void path();
  void mark(const char* id, std::optional<Vec2> at, Rgb color);

  double width(double units) const { return frame_.length(units * canvas_.unit); }
  void open_layer(const char* id, Rgb color, double units) {
    fmt::format_to(std::back_inserter(text_),
                   "<g id=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3f}\" stroke-linecap=\"round\" "
                   "stroke-linejoin=\"round\">",
                   id, hex(color), width(units));
  }
  void move_to(Vec2 p) { command('M', frame_.at(p)); }
  void line_to(Vec2 p) { command('L', frame_.at(p)); }
  void command(char letter, Vec2 p) {
    text_ += letter;
    append_number(text_, p.x);
    text_ += ' ';
    append_number(text_, p.y);
  }
  void leg_to(Vec2 from, Vec2 to, double turn);
  void segment(Vec2 a, Vec2 b);
  void piece_ended() {
    constexpr std::size_t piece = 1 << 18;
    if (text_.size() < piece) return;
    execution_.check();
    flush();
  }
  void flush() {
    write_(text_);
    text_.clear();
  }

  const Picture& picture_;
  const Execution& execution_;
  const Write& write_;
  Canvas canvas_;
  Frame frame_;
  std::string text_;
};

void SvgWriter::open() {
  const Vec2 low = frame_.at(canvas_.box.min);
  const Vec2 high = frame_.at(canvas_.box.max);
  const double w = high.x - low.x;
  const double h = high.y - low.y;
  constexpr double pixels = 1000.0;
  const double zoom = pixels / std::max(w, h);
  std::string view;
  for (const double number : {low.x, -high.y, w, h}) {
    if (!view.empty()) view += ' ';
    append_number(view, number);
  }
  fmt::format_to(std::back_inserter(text_),
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{}\" width=\"{:.0f}\" height=\"{:.0f}\" "
                 "role=\"img\">\n<title>{}</title>\n<desc>{}</desc>\n",
                 view, std::ceil(w * zoom), std::ceil(h * zoom), xml_text(picture_.title),
                 xml_text(picture_.description));
  fmt::format_to(std::back_inserter(text_),
                 "<rect x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" fill=\"{}\"/>\n"
                 "<g transform=\"scale(1,-1)\">\n",
                 low.x, -high.y, w, h, hex(colors::paper));
}

/// A straight, or a circular arc.
void SvgWriter::leg_to(Vec2 from, Vec2 to, double turn) {
  constexpr double no_turn = 1e-9;
  if (std::abs(turn) < no_turn) return line_to(to);
  const double radius = frame_.length(arc_radius(from, to, turn));
  text_ += 'A';
  append_number(text_, radius);
  text_ += ' ';
  append_number(text_, radius);
  text_ += turn > 0.0 ? " 0 0 1 " : " 0 0 0 ";
  const Vec2 p = frame_.at(to);
  append_number(text_, p.x);
  text_ += ' ';
  append_number(text_, p.y);
}

/// Axis-parallel segments, most of a maze, take the short commands.
void SvgWriter::segment(Vec2 a, Vec2 b) {
  const Vec2 from = frame_.at(a);
  const Vec2 to = frame_.at(b);
  command('M', from);
  if (from.y == to.y) {
    text_ += 'h';
    append_number(text_, to.x - from.x);
  } else if (from.x == to.x) {
    text_ += 'v';
    append_number(text_, to.y - from.y);
  } else {
    command('L', to);
  }
  piece_ended();
}

void SvgWriter::polygons() {
  if (picture_.scene.polygons.empty()) return;
  // One path, filled where any polygon is: so all have to run the same way round.
  fmt::format_to(std::back_inserter(text_),
                 "<path id=\"polygons\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.3f}\" "
                 "stroke-linejoin=\"round\" d=\"",
                 hex(colors::polygon), hex(colors::outline), width(widths::outline));
  for (const ScenePolygon& polygon : picture_.scene.polygons) {
    const std::vector<Vec2> corners = anticlockwise(polygon.corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      command(i == 0 ? 'M' : 'L', frame_.at(corners[i]));
      piece_ended();
    }
    text_ += 'Z';
  }
  text_ += "\"/>\n";
}

void SvgWriter::lines(const PictureLayer& layer) {
  if (layer.filled) {
    fmt::format_to(std::back_inserter(text_), "<g id=\"{}\" fill=\"{}\" shape-rendering=\"crispEdges\">", layer.id,
                   hex(layer.color));
  } else {
    open_layer(layer.id.c_str(), layer.color, layer.width);
  }
  text_ += "<path d=\"";
  for (std::size_t i = 0; i < layer.lines.size(); ++i) {
    const std::span<const Vec2> line = layer.lines[i];
    const std::span<const double> turns = layer.turns_of(i);
    move_to(line[0]);
    for (std::size_t k = 1; k < line.size(); ++k) {
      leg_to(line[k - 1], line[k], turns.empty() ? 0.0 : turns[k]);
      piece_ended();
    }
    if (layer.closed || layer.filled) text_ += 'Z';
  }
  text_ += "\"/></g>\n";
}

void SvgWriter::walls() {
  open_layer("walls", colors::wall, widths::wall);
  text_ += "<path d=\"";
  picture_.scene.walls.visit([&](auto all) {
    for (const auto& wall : all) {
      const Segment s = wall.segment();
      segment(s.a, s.b);
    }
  });
  if (picture_.scene.bounds) {
    const auto [low, high] = *picture_.scene.bounds;
    move_to(low);
    line_to({high.x, low.y});
    line_to(high);
    line_to({low.x, high.y});
    text_ += 'Z';
  }
  text_ += "\"/></g>\n";
}

void SvgWriter::roadmap() {
  const std::vector<std::uint8_t> color = component_colors(picture_.roadmap->graph, execution_);
  if (color.size() != picture_.roadmap->states.size()) return;  // stopped before the graph was made
  edges(color);
  search_tree();
  milestones(color);
}

void SvgWriter::edges(const std::vector<std::uint8_t>& color) {
  const PlannedRoadmap<Vec2>& roadmap = *picture_.roadmap;
  open_layer("edges", colors::components[0], widths::edge);
  for (std::size_t c = 0; c < colors::components.size(); ++c) {
    const std::string head = fmt::format("\n<path stroke=\"{}\" d=\"", hex(colors::components[c]));
    bool any = false;
    for (VertexId v = 0; v < roadmap.graph.vertex_count(); ++v) {
      if (v % vertices_per_poll == 0) execution_.check();
      if (color[v] != c) continue;
      for (const VertexId w : roadmap.graph.neighbours(v)) {
        if (w < v) continue;
        if (!any) text_ += head;
        any = true;
        segment(roadmap.states[v], roadmap.states[w]);
      }
    }
    if (any) text_ += "\"/>";
  }
  text_ += "</g>\n";
}

/// A subpath of length zero with round caps is a dot.
void SvgWriter::milestones(const std::vector<std::uint8_t>& color) {
  const PlannedRoadmap<Vec2>& roadmap = *picture_.roadmap;
  open_layer("milestones", colors::components[0], widths::milestone);
  for (std::size_t c = 0; c < colors::components.size(); ++c) {
    const std::string head = fmt::format("\n<path stroke=\"{}\" d=\"", hex(colors::components[c]));
    bool any = false;
    for (std::size_t v = 0; v < color.size(); ++v) {
      if (color[v] != c) continue;
      if (!any) text_ += head;
      any = true;
      segment(roadmap.states[v], roadmap.states[v]);
    }
    if (any) text_ += "\"/>";
  }
  text_ += "</g>\n";
}

void SvgWriter::search_tree() {
  const PlannedRoadmap<Vec2>& roadmap = *picture_.roadmap;
  open_layer("search_tree", colors::search_tree, widths::search_tree);
  text_ += "<path d=\"";
  for (const Edge& edge : roadmap.search_tree) {
    if (edge.to != no_vertex) segment(roadmap.states[edge.from], roadmap.states[edge.to]);
  }
  text_ += "\"/></g>\n";
}

void SvgWriter::path() {
  if (picture_.path.empty()) return;
  open_layer("path", colors::path, widths::path);
  fmt::format_to(std::back_inserter(text_), "<path stroke=\"{}\" stroke-width=\"{:.3f}\" d=\"", hex(colors::paper),
                 width(widths::halo));
  for (int layer = 0; layer < 2; ++layer) {  // a light halo, then the line
    if (layer == 1) text_ += "\"/>\n<path id=\"way\" d=\"";
    move_to(picture_.path.front());
    for (std::size_t i = 1; i < picture_.path.size(); ++i) {
      leg_to(picture_.path[i - 1], picture_.path[i], picture_.path_turns.empty() ? 0.0 : picture_.path_turns[i]);
      piece_ended();
    }
  }
  text_ += "\"/></g>\n";
}

void SvgWriter::mark(const char* id, std::optional<Vec2> at, Rgb color) {
  if (!at) return;
  const Vec2 p = frame_.at(*at);
  fmt::format_to(std::back_inserter(text_),
                 "<g id=\"{}\"><circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.3f}\" fill=\"{}\" stroke=\"{}\" "
                 "stroke-width=\"{:.3f}\"/></g>\n",
                 id, p.x, p.y, width(widths::mark), hex(color), hex(colors::paper), width(0.09));
}

constexpr std::string_view page_head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
html,body{margin:0;height:100%;background:#f1f5f9;font:14px/1.4 system-ui,sans-serif;color:#1e293b}
svg{display:block;width:100vw;height:100vh;cursor:grab;touch-action:none}
#hint{position:fixed;left:12px;bottom:10px;background:#ffffffd9;padding:4px 10px;border-radius:6px}
</style>
)";

constexpr std::string_view page_tail = R"(<div id="hint">drag to move, wheel to zoom, double click to reset</div>
<script>
const svg = document.querySelector("svg"), whole = svg.viewBox.baseVal;
const home = [whole.x, whole.y, whole.width, whole.height];
let view = home.slice(), held = null;
const show = () => svg.setAttribute("viewBox", view.join(" "));
const at = e => { const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse()); return [p.x, p.y]; };
svg.addEventListener("wheel", e => {
  e.preventDefault();
  const k = Math.exp(e.deltaY * 0.0015), [x, y] = at(e);
  view = [x - (x - view[0]) * k, y - (y - view[1]) * k, view[2] * k, view[3] * k];
  show();
}, {passive: false});
svg.addEventListener("pointerdown", e => { held = at(e); svg.setPointerCapture(e.pointerId); });
svg.addEventListener("pointerup", () => { held = null; });
svg.addEventListener("pointermove", e => {
  if (!held) return;
  const [x, y] = at(e);
  view[0] += held[0] - x; view[1] += held[1] - y;
  show();
});
svg.addEventListener("dblclick", () => { view = home.slice(); show(); });
</script></body></html>
)";

}  // namespace

void write_svg(const Picture& picture, const Execution& execution, const Write& write) {
  SvgWriter(picture, execution, write).document();
}

void write_html(const Picture& picture, const Execution& execution, const Write& write) {
  write(page_head);
  write("<title>" + xml_text(picture.title) + "</title></head><body>\n");
  write_svg(picture, execution, write);
  write(page_tail);
}

}  // namespace warren
