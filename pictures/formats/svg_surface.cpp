// SPDX-License-Identifier: BSD-3-Clause
// SVG 1.1, one merged path a layer (and a component's colour), so that files stay small: "M1 1h1" is a wall. In the
// group "world" coordinates are the world's, with at most three decimals; worlds that are tiny, huge or far from the
// origin are moved into a frame where that is enough. No attribute is longer than a megabyte, which some readers ask
// for; more lines than a screen can show are an image inside. Written in pieces: memory stays small whatever the world.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "pictures/formats/markup.hpp"
#include "pictures/formats/surface.hpp"

namespace warren {
namespace {

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

/// Where SVG's coordinates are those of the world, but for a move and a factor.
struct WorldFrame {
  explicit WorldFrame(const Box& box) {
    const double extent = std::max(box.width(), box.height());
    if (extent > 0.0 && (extent < 5.0 || extent > 1e5)) scale = std::pow(10.0, 2.0 - std::floor(std::log10(extent)));
    const double far = std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
    if (scale != 1.0 || far > 1e5) origin = box.min;
  }
  Vec2 at(Vec2 p) const { return scale * (p - origin); }

  Vec2 origin;
  double scale = 1.0;
};

class SvgSurface : public Surface {
 public:
  SvgSurface(const Page& page, const Execution& execution, const Write& write)
      : page_(page), execution_(execution), write_(write), frame_(page.canvas.box) {}

  void open(const Picture& picture, std::string_view title) {
    const auto side = [&](double on_page, double PageSize::*asked) {
      if (!page_.asked) return fmt::format("{:.0f}", std::ceil(on_page));
      const bool in_mm = page_.asked->unit == LengthUnit::mm;
      return in_mm ? fmt::format("{:.6g}mm", (*page_.asked).*asked) : fmt::format("{:.6g}", on_page);
    };
    text_ += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "viewBox=\"0 0 {:.2f} {:.2f}\" width=\"{}\" height=\"{}\" role=\"img\" "
        "xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "font-family=\"Helvetica,Arial,Liberation Sans,DejaVu Sans,sans-serif\">\n"
        "<title>{}</title>\n<desc>{}</desc>\n<rect id=\"paper\" width=\"100%\" height=\"100%\" fill=\"{}\"/>\n",
        page_.width, page_.height, side(page_.width, &PageSize::width), side(page_.height, &PageSize::height),
        xml_text(title), xml_text(picture.description), css_color(colors::paper));
  }

  void close() {
    text_ += "</svg>\n";
    flush();
  }

  /// x right, y up.
  void enter_world() override {
    in_world_ = true;
    const double scale = page_.view.scale / frame_.scale;
    const Vec2 zero = page_.view.at(frame_.origin);
    text_ += fmt::format("<g id=\"world\" transform=\"matrix({0:.9g} 0 0 {1:.9g} {2:.9g} {3:.9g})\">\n", scale, -scale,
                         zero.x, zero.y);
  }
  void leave_world() override {
    text_ += "</g>\n";
    in_world_ = false;
  }
  void begin_group(std::string_view id, std::string_view label, const Pen& pen) override {
    group_pen_ = pen_ = pen;
    is_way_ = id == "path";
    text_ += fmt::format("<g id=\"{}\"{}", xml_text(id), style(pen));
    if (!label.empty()) text_ += fmt::format(" data-label=\"{}\"", xml_text(label));
    text_ += '>';
  }
  void end_group() override {
    close_path();
    text_ += "</g>\n";
    if (text_.size() > 1U << 16U) flush();
  }
  void take_pen(const Pen& pen) override {
    if (pen == pen_) return;
    close_path();
    pen_ = pen;
  }
  /// Axis-parallel segments, most of a maze, take the short commands.
  void segment(Vec2 a, Vec2 b) override {
    open_path();
    const Vec2 from = at(a);
    const Vec2 to = at(b);
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
    split();
  }

  void chain(std::span<const Vec2> points, std::span<const double> turns, bool closed) override {
    open_path();
    command('M', at(points[0]));
    for (std::size_t i = 1; i < points.size(); ++i) {
      leg_to(points[i - 1], points[i], turns.empty() ? 0.0 : turns[i]);
      if (closed) continue;
      split();
      if (!path_is_open_ && i + 1 < points.size()) {  // a long line goes on in the next path
        open_path();
        command('M', at(points[i]));
      }
    }
    if (closed) text_ += 'Z';
    split();
  }

  void text(const PlacedText& text) override {
    std::string more;
    if (text.anchor != Anchor::start) more = fmt::format(" text-anchor=\"{}\"", name_of(text.anchor));
    if (text.bold) more += " font-weight=\"bold\"";
    if (text.upright) more += fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", text.at.x, text.at.y);
    text_ += fmt::format("\n<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.4g}\"{}>{}</text>", text.at.x, text.at.y,
                         text.size, more, xml_text(text.text));
  }
  /// Some readers (librsvg, and so GNOME) open no more than ten megabytes.
  bool takes_as_mask(std::size_t points) const override {
    constexpr std::size_t bytes_a_point = 12;
    constexpr std::size_t most_bytes = 7'000'000;
    return written_ + points * bytes_a_point > most_bytes;
  }
  void mask(const Mask& mask, Rgb color) override {
    close_path();
    // In the world's coordinates, which run upwards: turned back.
    const double size = length(1.0);
    const Vec2 corner = at({(page_.data.min.x - page_.view.origin.x) / page_.view.scale,
                            (page_.view.origin.y - page_.data.min.y) / page_.view.scale});
    text_ +=
        fmt::format("\n<image transform=\"matrix({:.9g} 0 0 {:.9g} {:.9g} {:.9g})\" width=\"{:.9g}\" height=\"{:.9g}\"",
                    size, -size, corner.x, corner.y, page_.data.width(), page_.data.height());
    png([&](const Write& write) { write_png_file(mask, color, execution_, write); });
  }
  double image_density() const override { return density_of_images; }
  void image(const Image& image, const Box& at) override {
    text_ += fmt::format("\n<image x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"", at.min.x, at.min.y,
                         at.width(), at.height());
    constexpr double points_an_inch = 96.0;
    png([&](const Write& write) { write_png_file(image, density_of_images * points_an_inch, execution_, write); });
  }
  void moving(const Picture& picture, Parts parts, double line_width) override {
    const double width = length(line_width);
    if (!picture.path.empty() && parts.has(Part::path)) text_ += svg_moving_body(picture.body, frame_.scale, width);
    if (!picture.arm || !parts.has(Part::body)) return;
    const double arm_width = std::max(2.0 * frame_.scale * picture.arm->radius, width);
    text_ += svg_moving_arm(*picture.arm, arm_width, [&](Vec2 p) { return at(p); });
  }

 private:
  static constexpr double density_of_images = 2.0;  // sharp on most screens, and on paper
  Vec2 at(Vec2 p) const { return in_world_ ? frame_.at(p) : p; }
  /// Of a length on the page.
  double length(double pixels) const { return in_world_ ? pixels * frame_.scale / page_.view.scale : pixels; }
  std::string style(const Pen& pen) const {
    std::string style = fmt::format(" fill=\"{}\"", pen.fill ? css_color(*pen.fill) : "none");
    if (pen.stroke) {
      style += fmt::format(" stroke=\"{}\" stroke-width=\"{:.5g}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"",
                           css_color(*pen.stroke), length(pen.width));
    }
    if (pen.opacity < 1.0) style += fmt::format(" opacity=\"{:.3g}\"", pen.opacity);
    if (pen.crisp) style += " shape-rendering=\"crispEdges\"";
    return style;
  }
  void open_path() {
    if (path_is_open_) return;
    path_is_open_ = true;
    path_bytes_ = 0;
    text_ += "\n<path";
    if (is_way_ && pen_ == group_pen_) text_ += " id=\"way\"";
    if (pen_ != group_pen_) text_ += style(pen_);
    text_ += " d=\"";
  }
  void close_path() {
    if (path_is_open_) text_ += "\"/>";
    path_is_open_ = false;
  }
  void command(char letter, Vec2 p) {
    text_ += letter;
    append_number(text_, p.x);
    text_ += ' ';
    append_number(text_, p.y);
  }
  /// A straight, or a circular arc.
  void leg_to(Vec2 from, Vec2 to, double turn) {
    constexpr double no_turn = 1e-9;
    if (std::abs(turn) < no_turn) return command('L', at(to));
    const double radius = frame_.scale * arc_radius(from, to, turn);
    command('A', {radius, radius});
    text_ += turn > 0.0 ? " 0 0 1" : " 0 0 0";
    command(' ', at(to));
  }

  /// Ends the path before it is too long for a reader.
  void split() {
    constexpr std::size_t piece = 1U << 16U;
    constexpr std::size_t longest_path = 900'000;
    if (text_.size() < piece) return;
    path_bytes_ += text_.size();
    if (path_bytes_ > longest_path) close_path();
    execution_.check();
    flush();
  }
  void flush() {
    write_(text_);
    written_ += text_.size();
    text_.clear();
  }
  /// The end of an <image> that is open: how it fills its place, and its bytes.
  void png(const std::function<void(const Write&)>& write_bytes) {
    text_ += " preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,";
    flush();
    Base64 base64(write_);
    write_bytes([&](std::string_view bytes) {
      written_ += bytes.size() * 4 / 3;
      base64.write(bytes);
    });
    base64.end();
    text_ += "\"/>";
  }

  const Page& page_;
  const Execution& execution_;
  const Write& write_;
  WorldFrame frame_;
  Pen group_pen_;
  Pen pen_;
  bool path_is_open_ = false;
  bool is_way_ = false;  // the group is "path": its last line has the id "way"
  std::size_t path_bytes_ = 0;
  std::size_t written_ = 0;  // bytes
  std::string text_;
};

constexpr std::string_view duration = "dur=\"8s\" repeatCount=\"indefinite\"";

std::string shape_of(const MovingBody& body, double scale, double line_width) {
  const std::string style = fmt::format(
      R"(fill="#e11d48" fill-opacity="0.35" stroke="#9f1239" stroke-width="{:.3f}" stroke-linejoin="round")",
      line_width);
  std::string shape;
  if (body.outline.empty()) {
    shape = fmt::format(R"(<circle r="{:.3f}" {}/>)", scale * body.radius, style);
    if (body.heads) {
      shape += fmt::format(R"(<path d="M0 0L{:.3f} 0" stroke="#9f1239" stroke-width="{:.3f}"/>)", scale * body.radius,
                           line_width);
    }
    return shape;
  }
  std::string d;
  for (const Vec2 p : body.outline) {
    d += fmt::format("{}{:.3f} {:.3f}", d.empty() ? 'M' : 'L', scale * p.x, scale * p.y);
  }
  return fmt::format(R"(<path d="{}Z" {}/>)", d, style);
}

}  // namespace

std::vector<std::string> write_svg(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                   const Write& write) {
  const Page page = page_of(picture, options, false, execution);
  SvgSurface surface(page, execution, write);
  surface.open(picture, options.title.value_or(picture.title));
  std::vector<std::string> notes = paint(picture, options.parts, page, surface, execution);
  surface.close();
  return notes;
}

Timetable timetable_of(const MovingBody& body) {
  const double size = body.outline.empty() ? body.radius : outline_reach(body.outline);
  Timetable table;
  double travel = 0.0;
  double way = 0.0;
  for (std::size_t i = 0; i < body.poses.size(); ++i) {
    const double turn = i == 0 ? 0.0 : turn_between(body.poses[i - 1].theta, body.poses[i].theta);
    way += body.lengths[i];
    travel += body.lengths[i] + size * std::abs(turn);
    table.moments.push_back(travel);
    table.shares.push_back(way);
  }
  for (double& moment : table.moments) moment = travel > 0.0 ? moment / travel : 0.0;
  for (double& share : table.shares) share = way > 0.0 ? share / way : 0.0;
  return table;
}

std::string svg_moving_body(const MovingBody& body, double scale, double line_width) {
  const Timetable table = timetable_of(body);
  if (!(table.moments.back() > 0.0)) return {};
  const std::string moments = fmt::format("{:.6f}", fmt::join(table.moments, ";"));
  const std::string motion = fmt::format(
      R"(<animateMotion {} calcMode="linear" keyTimes="{}" keyPoints="{:.6f}"><mpath href="#way"/></animateMotion>)",
      duration, moments, fmt::join(table.shares, ";"));
  std::vector<double> angles;  // degrees, without jumps
  double theta = body.poses.front().theta;
  for (std::size_t i = 0; i < body.poses.size(); ++i) {
    if (i > 0) theta += turn_between(body.poses[i - 1].theta, body.poses[i].theta);
    angles.push_back(theta * 180.0 / std::numbers::pi);
  }
  const std::string turning = fmt::format(
      R"(<animateTransform attributeName="transform" type="rotate" {} calcMode="linear" keyTimes="{}" values="{:.3f}"/>)",
      duration, moments, fmt::join(angles, ";"));
  return fmt::format(
      "<g id=\"body\" visibility=\"hidden\"><set attributeName=\"visibility\" "
      "to=\"visible\"/>\n{}\n<g>{}\n{}</g></g>\n",
      motion, turning, shape_of(body, scale, line_width));
}

std::string svg_moving_arm(const MovingArm& arm, double width, const std::function<Vec2(Vec2)>& at) {
  if (arm.moments.size() < 2) return {};
  const std::string moments = fmt::format("{:.6f}", fmt::join(arm.moments, ";"));
  std::string group = "<g id=\"arm\" visibility=\"hidden\"><set attributeName=\"visibility\" to=\"visible\"/>\n";
  for (const Projection& view : arm.views) {
    std::vector<std::string> places;
    for (const std::vector<Vec3>& spine : arm.spines) {
      std::string& points = places.emplace_back();
      for (const Vec3& end : spine) {
        const Vec2 p = at(view.at(end));
        points += fmt::format("{}{:.3f},{:.3f}", points.empty() ? "" : " ", p.x, p.y);
      }
    }
    group += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#e11d48\" stroke-opacity=\"0.55\" "
        "stroke-width=\"{:.3f}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"><animate "
        "attributeName=\"points\" {} calcMode=\"linear\" keyTimes=\"{}\" values=\"{}\"/></polyline>\n",
        places.front(), width, duration, moments, fmt::join(places, ";"));
  }
  return group + "</g>\n";
}

}  // namespace warren
