// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/printable.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/error.hpp"

namespace warren {
namespace {

using namespace std::string_literals;

TEST(Printable, WhatMovesCursorsOrTurnsDirectionsStandsAsItsBytes) {
  struct Case {
    std::string_view what;
    std::string text;
    std::string shown;
  };
  for (const Case& c : std::initializer_list<Case>{
           {"an escape sequence", "\x1b[31m", "\\x1b[31m"},
           {"end of line and NUL", "a\nb\0c\r\t"s, "a\\x0ab\\x00c\\x0d\\x09"},
           {"DEL", "\x7f", "\\x7f"},
           {"a C1 control", "\xc2\x9b", "\\xc2\\x9b"},
           {"an override of direction", "\xe2\x80\xae", "\\xe2\\x80\\xae"},
           {"an isolate of direction", "\xe2\x81\xa6", "\\xe2\\x81\\xa6"},
           {"an end of line of Unicode's", "\xe2\x80\xa8", "\\xe2\\x80\\xa8"},
           {"a byte order mark", "\xef\xbb\xbf", "\\xef\\xbb\\xbf"},
           {"a tag", "\xf3\xa0\x81\x81", "\\xf3\\xa0\\x81\\x81"},
           {"no character", "\xef\xbf\xbf", "\\xef\\xbf\\xbf"},
           {"overlong in two bytes", "\xc1\x9b", "\\xc1\\x9b"},
           {"overlong in three", "\xe0\x80\x9b", "\\xe0\\x80\\x9b"},
           {"overlong in four", "\xf0\x80\x80\x9b", "\\xf0\\x80\\x80\\x9b"},
           {"half of a pair", "\xed\xa0\x80", "\\xed\\xa0\\x80"},
           {"beyond the last character", "\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},
           {"cut off", "\xe2\x80", "\\xe2\\x80"},
           {"a lonely continuation", "\x80z", "\\x80z"},
       }) {
    SCOPED_TRACE(c.what);
    EXPECT_EQ(printable(c.text), c.shown);
    EXPECT_EQ(printable(printable(c.text)), c.shown);
  }
}

TEST(Printable, LettersOfAllScriptsStandAsTheyAre) {
  const std::string text =
      "a \\x1b ~ \xc3\xa4 \xe6\xbc\xa2 \xd7\x90 \xd8\xa8 \xe0\xa4\x95\xe2\x80\x8d \xf0\x9f\x90\xad";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, LongTextIsCutBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", 4), "abcd...");
  EXPECT_EQ(printable("abcd", 4), "abcd");
  EXPECT_EQ(printable("abc\xc3\xa4z", 4), "abc\xc3\xa4...");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, EveryErrorIsOneLine) {
  const std::string nasty = "a\x1b]0;b\nc";
  const std::string shown = "a\\x1b]0;b\\x0ac";
  EXPECT_EQ(std::string(InputError(nasty, nasty, nasty).what()), shown + ": " + shown + " (found: " + shown + ")");
  EXPECT_EQ(std::string(ReadError(nasty, nasty).what()), shown + ": can't be read: " + shown);
  EXPECT_EQ(std::string(WriteError(nasty, nasty).what()), shown + ": can't be written: " + shown);
  EXPECT_EQ(std::string(UsageError(nasty).what()), shown);
}

}  // namespace
}  // namespace warren
