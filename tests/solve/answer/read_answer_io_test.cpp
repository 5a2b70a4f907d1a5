// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/read_answer_io.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <limits>

#include "core/base/error.hpp"

namespace warren {
namespace {

std::string repeated(std::string_view head, std::string_view again, std::string_view tail) {
  constexpr std::size_t bytes = std::size_t{1} << 20;
  std::string text{head};
  while (text.size() < bytes) text += again;
  return text + std::string{tail};
}

TEST(RecordedAnswer, ASignalIsSeenWhateverTheFileIsFullOf) {
  const SignalFlag signal{SIGINT};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  for (const std::string& text : {repeated("{", " ", "x"), repeated(R"({"a": ")", "w", ""),
                                  repeated(R"({"a": )", "[", "x"), repeated(R"({"a": [0)", ",0", "x"),
                                  repeated(R"({"path": [[0,0])", ",[0,0]", "x"), repeated("", R"({"a":)", "x")}) {
    SCOPED_TRACE(text.substr(0, 20));
    const InputFile file = InputFile::of_bytes("a.json", text);
    EXPECT_THROW(read_answer(file, {}), InputError) << "it ends in a mistake";
    EXPECT_THROW(read_answer(file, Execution{1, &deadline}), Stopped);
  }
}

TEST(RecordedAnswer, NumbersThatAreNoStateAreNotKept) {
  const InputFile file =
      InputFile::of_bytes("a.json", repeated(R"({"a": [0)", ",0", R"(], "path": [[1, 2], [3, 4]]})"));
  EXPECT_EQ(read_answer(file, {}).path.size(), 2U);
  EXPECT_THROW(read_answer(InputFile::of_bytes("a.json", repeated(R"({"path": [[0)", ",0", "]]}")), {}), InputError);
  EXPECT_THROW(read_answer(InputFile::of_bytes("a.json", repeated(R"({"start": [0)", ",0", "]}")), {}), InputError);
}

}  // namespace
}  // namespace warren
