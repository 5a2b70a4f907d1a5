// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/write_picture.hpp"
#include "pictures/model/xml_text.hpp"

namespace warren {
namespace {

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

void write_html(const Picture& picture, const PictureOptions& options, const Execution& execution, const Write& write) {
  write(page_head);
  write("<title>" + xml_text(options.title.value_or(picture.title)) + "</title></head><body>\n");
  write_svg(picture, options, execution, write);
  write(page_tail);
}

}  // namespace warren
