// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/page_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pictures/model/letters.hpp"
#include "pictures/model/ticks.hpp"

namespace warren {
namespace {

void add_text(Page& page, Vec2 at, std::string words, double size, Anchor anchor, bool bold = false,
              bool upright = false) {
  if (!words.empty()) page.texts.push_back({at, std::move(words), size, anchor, bold, upright});
}

}  // namespace

void add_axes(Page& page, const AxesPanel& panel, Box at, std::optional<double> name_at) {
  const Vec2 low = at.min;
  const Vec2 high = at.max;
  const auto line = [&](Vec2 a, Vec2 b) { page.frame.push_back({a, b}); };
  line(low, {high.x, low.y});
  line({high.x, low.y}, high);
  line(high, {low.x, high.y});
  line({low.x, high.y}, low);
  const auto names_inside = [&] {
    add_text(page, {high.x - 6.0, high.y - 7.0}, panel.x_label, page_text_size, Anchor::end);
    add_text(page, {low.x + 6.0, low.y + page_text_size + 5.0}, panel.y_label, page_text_size, Anchor::start);
  };
  if (!panel.has_ticks) return names_inside();
  const View& view = page.view;
  const Vec2 zero = view.at(panel.origin);
  constexpr double pixels_a_tick = 80.0;
  const double longer = std::max(high.x - low.x, high.y - low.y);
  const double step = tick_step(longer / view.scale, std::max(longer / pixels_a_tick, 2.0));
  const auto ticks = [&](double from, double to) { return ticks_between(from / view.scale, to / view.scale, step); };
  double next = -1e9;  // where there is room again
  for (const double tick : ticks(low.x - zero.x, high.x - zero.x)) {
    const double x = zero.x + view.scale * tick;
    line({x, high.y}, {x, high.y + tick_length});
    const std::string words = tick_text(tick, step);
    const double half = 0.5 * text_width(words, page_text_size);
    if (x - half < next) continue;
    next = x + half + 6.0;
    add_text(page, {x, high.y + tick_length + 3.0 + page_text_size}, words, page_text_size, Anchor::middle);
  }
  for (const double tick : ticks(zero.y - high.y, zero.y - low.y)) {
    const double y = zero.y - view.scale * tick;
    line({low.x - tick_length, y}, {low.x, y});
    add_text(page, {low.x - tick_length - 4.0, y + 0.35 * page_text_size}, tick_text(tick, step), page_text_size,
             Anchor::end);
  }
  const double below = tick_length + 3.0 + 2.3 * page_text_size;
  if (!name_at) {
    names_inside();
  } else {
    add_text(page, {0.5 * (low.x + high.x), high.y + below}, panel.x_label, page_text_size, Anchor::middle);
    add_text(page, {*name_at, 0.5 * (low.y + high.y)}, panel.y_label, page_text_size, Anchor::middle, false, true);
  }
}

void add_scale_bar(Page& page, Vec2 at, std::string_view unit) {
  constexpr double wish = 45.0;
  const double step = tick_step(wish / page.view.scale, 1.0);
  const double length = step * page.view.scale;
  const Vec2 end{at.x + length, at.y};
  page.ink.push_back({at, end});
  for (const Vec2 p : {at, end}) page.ink.push_back({{p.x, p.y - 3.5}, {p.x, p.y + 3.5}});
  const bool one = step == 1.0 && unit == "cells";
  add_text(page, {end.x + swatch_gap, at.y + 0.35 * page_text_size},
           fmt::format("{}{}{}", tick_text(step, step), unit.empty() ? "" : " ", one ? "cell" : unit), page_text_size,
           Anchor::start);
}

}  // namespace warren
