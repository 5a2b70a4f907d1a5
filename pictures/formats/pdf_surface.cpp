// SPDX-License-Identifier: BSD-3-Clause
// The picture as one page of PDF, by libharu: lines stay lines, words are Helvetica, which every reader has, so the
// bytes depend on no machine. The whole document is in memory before it is written; more lines than a page can show are
// an image.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <new>

#include "core/base/error.hpp"
#include "pictures/formats/surface.hpp"
#include "pictures/model/letters.hpp"

#ifdef WARREN_PDF
#include <hpdf.h>
#endif

namespace warren {
#ifdef WARREN_PDF
namespace {

constexpr double points_a_pixel = 0.75;
constexpr double largest_side = 14'400.0;  // a side of a page

/// libharu goes on with what an allocation that failed gave it. So small ones get a last bit of memory, and who draws
/// asks whether one failed. Of a thread that makes one document after the other.
struct DocumentMemory {
  static constexpr std::size_t alignment = alignof(std::max_align_t);
  alignas(std::max_align_t) static inline thread_local std::array<std::byte, std::size_t{1} << 16U> last;
  static inline thread_local std::size_t used = 0;
  static inline thread_local bool has_failed = false;

  static void* take(HPDF_UINT bytes) {
    if (void* const block = std::malloc(bytes)) return block;
    has_failed = true;
    const std::size_t whole = (std::size_t{bytes} + alignment - 1) / alignment * alignment;
    if (whole > last.size() - used) return nullptr;
    used += whole;
    return last.data() + used - whole;
  }
  static void give_back(void* block) {
    const std::less<const void*> lies_before;
    if (lies_before(block, last.data()) || !lies_before(block, last.data() + last.size())) std::free(block);
  }
};

class PdfSurface : public Surface {
 public:
  PdfSurface(const Page& page, const Execution& execution) : page_(page), execution_(execution) {
    DocumentMemory::used = 0;
    DocumentMemory::has_failed = false;
    document_.reset(HPDF_NewEx(nullptr, DocumentMemory::take, DocumentMemory::give_back, 0, nullptr));
    if (!document_) throw std::bad_alloc();
    HPDF_SetCompressionMode(document_.get(), HPDF_COMP_ALL);
    sheet_ = HPDF_AddPage(document_.get());
    check();  // a page without its parts must not be asked for them
    HPDF_Page_SetWidth(sheet_, real(points_a_pixel * page.width));
    HPDF_Page_SetHeight(sheet_, real(points_a_pixel * page.height));
    HPDF_Page_SetLineCap(sheet_, HPDF_ROUND_END);
    HPDF_Page_SetLineJoin(sheet_, HPDF_ROUND_JOIN);
    regular_ = HPDF_GetFont(document_.get(), "Helvetica", "WinAnsiEncoding");
    bold_ = HPDF_GetFont(document_.get(), "Helvetica-Bold", "WinAnsiEncoding");
    check();
  }
  void tell(HPDF_InfoType what, const std::string& words) {
    HPDF_SetInfoAttr(document_.get(), what, latin1_text(words).c_str());
  }
  void finish(const Write& write) {
    HPDF_SaveToStream(document_.get());
    check();
    std::array<HPDF_BYTE, std::size_t{1} << 16U> piece{};
    for (;;) {
      execution_.check();
      auto size = static_cast<HPDF_UINT32>(piece.size());
      const HPDF_STATUS status = HPDF_ReadFromStream(document_.get(), piece.data(), &size);
      if (size > 0) write({reinterpret_cast<const char*>(piece.data()), size});
      if (status == HPDF_STREAM_EOF || size == 0) return;
      check();
    }
  }

  void begin_group(std::string_view, std::string_view, const Pen& pen) override {
    pen_ = pen;
    HPDF_Page_GSave(sheet_);
    use_pen();
  }
  void end_group() override {
    paint_path();
    HPDF_Page_GRestore(sheet_);
    check();
  }
  void take_pen(const Pen& pen) override {
    if (pen == pen_) return;
    paint_path();
    pen_ = pen;
    use_pen();
  }
  void segment(Vec2 a, Vec2 b) override { add_to_path(std::array{a, b}, false); }
  void chain(std::span<const Vec2> points, std::span<const double> turns, bool closed) override {
    add_to_path(without_arcs(points, turns), closed);
  }
  void text(const PlacedText& text) override {
    paint_path();
    const std::string words = latin1_text(text.text);
    HPDF_Page_SetFontAndSize(sheet_, text.bold ? bold_ : regular_, real(points_a_pixel * text.size));
    const double width = HPDF_Page_TextWidth(sheet_, words.c_str());
    const double back = text.anchor == Anchor::start ? 0.0 : text.anchor == Anchor::middle ? 0.5 * width : width;
    const Vec2 p = at(text.at) - (text.upright ? Vec2{0.0, back} : Vec2{back, 0.0});
    const HPDF_REAL cosine = text.upright ? 0.0F : 1.0F;
    const HPDF_REAL sine = text.upright ? 1.0F : 0.0F;
    HPDF_Page_BeginText(sheet_);
    HPDF_Page_SetTextMatrix(sheet_, cosine, sine, -sine, cosine, real(p.x), real(p.y));
    HPDF_Page_ShowText(sheet_, words.c_str());
    HPDF_Page_EndText(sheet_);
    check();
  }

  bool takes_as_mask(std::size_t points) const override {
    constexpr std::size_t most_points = 500'000;
    return points > most_points;
  }
  /// One pixel of the colour, seen through the mask.
  void mask(const Mask& mask, Rgb color) override {
    paint_path();
    const std::array pixel{color.red, color.green, color.blue};
    const HPDF_Image ink = HPDF_LoadRawImageFromMem(document_.get(), pixel.data(), 1, 1, HPDF_CS_DEVICE_RGB, 8);
    const HPDF_Image cover =
        HPDF_LoadRawImageFromMem(document_.get(), mask.pixels().data(), static_cast<HPDF_UINT>(mask.width()),
                                 static_cast<HPDF_UINT>(mask.height()), HPDF_CS_DEVICE_GRAY, 8);
    check();
    HPDF_Image_AddSMask(ink, cover);
    draw_image(ink, page_.data);
    check();
  }
  double image_density() const override { return 3.0; }  // some 300 pixels an inch
  void image(const Image& image, const Box& at) override {
    const HPDF_Image pixels =
        HPDF_LoadRawImageFromMem(document_.get(), image.row(0), static_cast<HPDF_UINT>(image.width()),
                                 static_cast<HPDF_UINT>(image.height()), HPDF_CS_DEVICE_RGB, 8);
    check();
    draw_image(pixels, at);
  }

 private:
  void draw_image(HPDF_Image image, const Box& at) {
    HPDF_Page_DrawImage(sheet_, image, real(points_a_pixel * at.min.x),
                        real(points_a_pixel * (page_.height - at.max.y)), real(points_a_pixel * at.width()),
                        real(points_a_pixel * at.height()));
  }

  static HPDF_REAL real(double number) { return static_cast<HPDF_REAL>(number); }
  /// In points, y up.
  Vec2 at(Vec2 p) const {
    const Vec2 on_page = in_world_ ? page_.view.at(p) : p;
    return {points_a_pixel * on_page.x, points_a_pixel * (page_.height - on_page.y)};
  }
  void add_to_path(std::span<const Vec2> points, bool closed) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      execution_.poll(i + 1);
      const Vec2 p = at(points[i]);
      (i == 0 ? HPDF_Page_MoveTo : HPDF_Page_LineTo)(sheet_, real(p.x), real(p.y));
    }
    path_steps_ += points.size();
    if (closed) HPDF_Page_ClosePath(sheet_);
    constexpr std::size_t most_steps = 10'000;
    if (path_steps_ < most_steps) return;
    execution_.check();
    paint_path();
  }
  void use_pen() {
    const auto part = [](std::uint8_t value) { return real(value / 255.0); };
    const auto stroke = [&](Rgb c, double width) {
      HPDF_Page_SetRGBStroke(sheet_, part(c.red), part(c.green), part(c.blue));
      HPDF_Page_SetLineWidth(sheet_, real(width));
    };
    if (pen_.stroke) stroke(*pen_.stroke, points_a_pixel * pen_.width);
    if (pen_.fill) HPDF_Page_SetRGBFill(sheet_, part(pen_.fill->red), part(pen_.fill->green), part(pen_.fill->blue));
    constexpr double hair = 0.1;  // its line closes the seams
    if (pen_.crisp && pen_.fill && !pen_.stroke) stroke(*pen_.fill, hair);
    HPDF_ExtGState& state = opacities_[pen_.opacity];
    if (state == nullptr) {
      state = HPDF_CreateExtGState(document_.get());
      HPDF_ExtGState_SetAlphaFill(state, real(pen_.opacity));
      HPDF_ExtGState_SetAlphaStroke(state, real(pen_.opacity));
    }
    HPDF_Page_SetExtGState(sheet_, state);
    check();
  }

  void paint_path() {
    if (path_steps_ == 0) return;
    path_steps_ = 0;
    const bool has_lines = pen_.stroke || pen_.crisp;
    (!pen_.fill ? HPDF_Page_Stroke : has_lines ? HPDF_Page_FillStroke : HPDF_Page_Fill)(sheet_);
  }
  void check() const {
    const bool failed = HPDF_GetError(document_.get()) != HPDF_OK;  // all that is asked of it is right
    if (failed || DocumentMemory::has_failed) throw std::bad_alloc();
  }

  const Page& page_;
  const Execution& execution_;
  std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, decltype(&HPDF_Free)> document_{nullptr, HPDF_Free};
  HPDF_Page sheet_ = nullptr;
  HPDF_Font regular_ = nullptr;
  HPDF_Font bold_ = nullptr;
  std::map<double, HPDF_ExtGState> opacities_;
  Pen pen_;
  std::size_t path_steps_ = 0;
};

}  // namespace

bool can_write_pdf() { return true; }

std::vector<std::string> draw_pdf(const Page& page, const std::string& title, std::string subject, const DrawOn& draw,
                                  const Execution& execution, const Write& write) {
  if (points_a_pixel * std::max(page.width, page.height) > largest_side) {
    throw UsageError("@size: a page of PDF is at most 5080 mm wide and high");
  }
  PdfSurface surface(page, execution);
  std::replace(subject.begin(), subject.end(), '\n', ' ');
  surface.tell(HPDF_INFO_TITLE, title);
  surface.tell(HPDF_INFO_SUBJECT, subject);
  std::vector<std::string> notes = draw(surface);
  surface.finish(write);
  return notes;
}

#else

bool can_write_pdf() { return false; }

std::vector<std::string> draw_pdf(const Page&, const std::string&, std::string, const DrawOn&, const Execution&,
                                  const Write&) {
  throw UsageError("this warren was built without libharu and writes no .pdf; say .svg, or build it with libhpdf-dev");
}

#endif

std::vector<std::string> write_pdf(const Picture& picture, const PictureOptions& options, const Execution& execution,
                                   const Write& write) {
  const Page page = page_of(picture, options, false, execution);
  const auto draw = [&](Surface& surface) { return paint(picture, options.parts, page, surface, execution); };
  return draw_pdf(page, options.title.value_or(picture.title), picture.description, draw, execution, write);
}

}  // namespace warren
