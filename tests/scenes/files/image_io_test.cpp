// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/image_io.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/files/test_images.hpp"

namespace warren {
namespace {

struct Picture {
  ImageHeader header;
  std::vector<int> samples;  // -1: never given
  int at(unsigned x, unsigned y, unsigned c) const { return samples[(y * header.width + x) * header.channels + c]; }
};

Picture picture_of(const std::string& path) {
  Picture picture;
  const auto begin = [&](const ImageHeader& header) {
    picture.header = header;
    picture.samples.assign(std::size_t{header.width} * header.height * header.channels, -1);
  };
  const auto row = [&](const PixelRun& run) {
    for (std::size_t i = 0; i < run.samples.size(); ++i) {
      const std::size_t x = run.first_x + i / picture.header.channels * run.step_x;
      int& to =
          picture.samples[(run.y * picture.header.width + x) * picture.header.channels + i % picture.header.channels];
      EXPECT_EQ(to, -1) << "given twice";
      to = run.samples[i];
    }
  };
  read_image(InputFile(path, {}), {begin, row}, {});
  return picture;
}

TEST(ReadImage, GivesEveryColourTypeDepthAndInterlacingExactly) {
  const TemporaryDirectory directory;
  const std::map<int, std::vector<int>> depths{{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                                               {PNG_COLOR_TYPE_RGB, {8, 16}},
                                               {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                                               {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}};
  for (const auto& [type, some] : depths) {
    for (const int depth : some) {
      for (const bool interlaced : {false, true}) {
        for (const auto& [width, height] : {std::pair{1U, 1U}, {3U, 2U}, {13U, 9U}, {70U, 11U}}) {
          SCOPED_TRACE(testing::Message() << type << " " << depth << " " << interlaced << " " << width);
          const unsigned most = (1U << depth) - 1;
          const auto sample = [&](unsigned x, unsigned y, unsigned c) {
            return static_cast<unsigned>(random_bits(x, y, c) & most);
          };
          const Picture picture =
              picture_of(directory.write("a.png", png_bytes({type, depth, interlaced}, width, height, sample)));
          ASSERT_EQ(picture.header.width, width);
          ASSERT_EQ(picture.header.height, height);
          ASSERT_EQ(picture.header.channels, channels_of(type));
          ASSERT_EQ(picture.header.maximum, depth == 16 ? 65535U : 255U);
          const unsigned stretch = picture.header.maximum / most;
          for (unsigned y = 0; y < height; ++y) {
            for (unsigned x = 0; x < width; ++x) {
              for (unsigned c = 0; c < picture.header.channels; ++c) {
                ASSERT_EQ(picture.at(x, y, c), static_cast<int>(sample(x, y, c) * stretch)) << x << " " << y;
              }
            }
          }
        }
      }
    }
  }
}

TEST(ReadImage, ExpandsPalettesOfEveryDepthAndTheirTransparency) {
  const TemporaryDirectory directory;
  const std::vector<png_color> palette{{1, 2, 3}, {200, 100, 50}};
  for (const int depth : {1, 2, 4, 8}) {
    for (const bool interlaced : {false, true}) {
      const auto sample = [](unsigned x, unsigned y, unsigned) { return (x + y) % 2; };
      const auto form = PngForm{PNG_COLOR_TYPE_PALETTE, depth, interlaced, palette};
      const Picture opaque = picture_of(directory.write("p.png", png_bytes(form, 9, 5, sample)));
      ASSERT_EQ(opaque.header.channels, 3U);
      EXPECT_EQ(opaque.at(0, 0, 2), 3);
      EXPECT_EQ(opaque.at(3, 4, 0), 200);
      auto transparent = form;
      transparent.palette_alpha = {0};
      const Picture clear = picture_of(directory.write("q.png", png_bytes(transparent, 9, 5, sample)));
      ASSERT_EQ(clear.header.channels, 4U);
      EXPECT_EQ(clear.at(0, 0, 3), 0);
      EXPECT_EQ(clear.at(1, 0, 3), 255);
      EXPECT_EQ(clear.at(1, 0, 1), 100);
    }
  }
}

TEST(ReadImage, ReadsBinaryAndAsciiPgmWithComments) {
  const TemporaryDirectory directory;
  using namespace std::string_literals;
  const Picture ascii = picture_of(directory.write("a.pgm", "P2 # magic\n# w\n3\t2 #h\n100\n0 1 2\n 50 99 100\n"));
  EXPECT_EQ(ascii.header.maximum, 100U);
  EXPECT_EQ(ascii.samples, (std::vector<int>{0, 1, 2, 50, 99, 100}));
  const Picture binary =
      picture_of(directory.write("b.pgm", "P5\n# CREATOR: x 0.050 m/pix\n2 2\n255\n\n\x01\xff\x80"s));
  EXPECT_EQ(binary.samples, (std::vector<int>{10, 1, 255, 128}));  // one byte ends the header; the next is a pixel
  const Picture wide = picture_of(directory.write("c.pgm", "P5 2 1 256\n\x01\x00\x00\x7f"s));
  EXPECT_EQ(wide.samples, (std::vector<int>{256, 127}));
}

struct BmpForm {
  int coding = 0;
  std::string palette = {};
  std::string masks = {};  // of the fourth version of its header
};

std::string bmp_bytes(int width, int height, int bits, const std::string& rows, const BmpForm& form = {}) {
  const auto number = [](std::int64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(i < 8 ? value >> 8 * i & 0xff : 0);
    return text;
  };
  const int head = form.masks.empty() ? 40 : 108;
  std::string bytes = number(head, 4) + number(width, 4) + number(height, 4) + number(1, 2) + number(bits, 2) +
                      number(form.coding, 4) + number(0, 12) + number(static_cast<int>(form.palette.size()) / 4, 4) +
                      number(0, 4) + form.masks;
  bytes.resize(static_cast<std::size_t>(head));
  bytes += form.palette;
  const auto size = static_cast<std::int64_t>(bytes.size() + rows.size() + 14);
  return "BM" + number(size, 4) + number(0, 4) + number(size - static_cast<std::int64_t>(rows.size()), 4) + bytes +
         rows;
}

TEST(ReadImage, ReadsBmpOfEachDepthFromBelowAndFromAbove) {
  using namespace std::string_literals;
  const TemporaryDirectory directory;
  const auto read = [&](const std::string& bytes) { return picture_of(directory.write("a.bmp", bytes)).samples; };
  using Samples = std::vector<int>;
  // 24 bits: blue, green, red; rows of whole words, the lowest first
  EXPECT_EQ(read(bmp_bytes(1, 2, 24, "\1\2\3\0\4\5\6\0"s)), (Samples{6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(read(bmp_bytes(1, -2, 24, "\1\2\3\0\4\5\6\0"s)), (Samples{3, 2, 1, 6, 5, 4}));
  const std::string two = "\1\1\1\0\2\2\2\0"s;
  EXPECT_EQ(read(bmp_bytes(3, 1, 1, "\xa0\0\0\0"s, {.palette = two})), (Samples{2, 2, 2, 1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(read(bmp_bytes(3, 1, 4, "\x01\x10\0\0"s, {.palette = two})), (Samples{1, 1, 1, 2, 2, 2, 2, 2, 2}));
  EXPECT_EQ(read(bmp_bytes(2, 1, 8, "\1\0\0\0"s, {.palette = two})), (Samples{2, 2, 2, 1, 1, 1}));
  EXPECT_EQ(read(bmp_bytes(1, 1, 32, "\1\2\3\4"s)), (Samples{3, 2, 1, 4}));
  EXPECT_EQ(read(bmp_bytes(2, 1, 32, "\1\2\3\0\1\2\3\0"s)), (Samples{3, 2, 1, 3, 2, 1})) << "no alpha at all";
  const std::string colours = "\0\0\xff\0\0\xff\0\0\xff\0\0\0"s;  // as Nav2 saves maps of mode scale
  EXPECT_EQ(read(bmp_bytes(1, 1, 32, "\1\2\3\4"s, {.coding = 3, .masks = colours + "\0\0\0\xff"s})),
            (Samples{3, 2, 1, 4}));
  EXPECT_EQ(read(bmp_bytes(1, 1, 32, "\1\2\3\4"s, {.coding = 3, .masks = colours})), (Samples{3, 2, 1}));
}

TEST(ReadImage, RefusesWhatIsNoWholeImageAndNamesThePlace) {
  const TemporaryDirectory directory;
  const std::string good = png_bytes({}, 20, 20, [](unsigned x, unsigned, unsigned) { return x; });
  std::string broken = good;
  broken[good.size() - 30] = static_cast<char>(broken[good.size() - 30] + 1);
  const std::pair<std::string, std::string> cases[] = {
      {good.substr(0, 20), "expected a whole PNG image"},
      {good.substr(0, good.size() - 20), "expected a whole PNG image"},
      {broken, "expected a whole PNG image"},
      {"\x89PNG\r\n", "expected a whole PNG image"},
      {"P5\n", ":2: expected the width of a PGM image, 1 to 2147483647 (found: the end of the file)"},
      {"P5\nx 2\n255\n", ":2: expected the width of a PGM image, 1 to 2147483647 (found: x)"},
      {"P5\n2\n0\n255\n", ":3: expected the height of a PGM image, 1 to 2147483647 (found: 0)"},
      {"P5\n2\n2\n65536\n", ":4: expected the maxval of a PGM image, 1 to 65535 (found: 65536)"},
      {"P5 100000 100000 255\n", "a map has 1 to 2^32 - 1 cells (found: 100000 x 100000)"},
      {"P5 2 2 255\nabc", "expected 2 x 2 pixels, 4 bytes after the header (found: 3 bytes)"},
      {"P5 2 2 90\nAAAz", "expected pixels of at most 90, the maxval, in row 1 (found: 122)"},
      {"P2 2 2 90\n1 2\n3", ":3: expected a pixel, 0 to 90 (found: the end of the file)"},
      {"P2 2 2 90\n1 2\n3 91", ":3: expected a pixel, 0 to 90 (found: 91)"},
      {"P6 2 2 255\n", "expected a PNG, PGM (magic P5 or P2) or BMP image"},
      {bmp_bytes(2, 2, 24, std::string(12, 'a')), "expected 2 x 2 pixels, 16 bytes after the header (found: 12 bytes)"},
      {bmp_bytes(2, 2, 16, std::string(99, 'a')), "expected a BMP of 1, 4, 8, 24 or 32 bits"},
      {bmp_bytes(4, 1, 8, std::string(4, '\0'), {.coding = 1}), "a pixel that is not compressed"},
      {bmp_bytes(-2, 2, 24, std::string(99, 'a')), "a map has 1 to 2^32 - 1 cells (found: 0 x 2)"},
      {bmp_bytes(2, 0, 24, std::string(99, 'a')), "a map has 1 to 2^32 - 1 cells (found: 2 x 0)"},
      {bmp_bytes(4, 1, 8, "\1\1\2\1", {.palette = std::string(8, 'p')}), "the palette's 2 colours (found: 2)"},
      {bmp_bytes(4, 1, 8, "\1\1\2\1").substr(0, 50), "expected a BMP"},
  };
  for (const auto& [bytes, expected] : cases) {
    SCOPED_TRACE(expected);
    const std::string path = directory.write("bad", bytes);
    const std::string said = test::refusal<InputError>([&] { picture_of(path); });
    EXPECT_EQ(said.find(path), 0U) << said;
    EXPECT_NE(said.find(expected), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace warren
