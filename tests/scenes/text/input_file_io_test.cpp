// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/input_file_io.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

TEST(InputFile, SmallFilesAreHeldAndDoNotChangeWithTheirFile) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.txt", "0 0 1 1\n");
  const InputFile file(path, {});
  std::filesystem::resize_file(path, 0);
  EXPECT_EQ(file.bytes(), "0 0 1 1\n");
  EXPECT_EQ(name_of_mapped(file.bytes().data()), nullptr);
}

TEST(InputFile, AMappedFileIsKnownByItsAddresses) {
  constexpr std::size_t size = std::size_t{16} << 20;
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.txt", "0 0 1 1\n");
  std::filesystem::resize_file(path, size);
  const char* begin = nullptr;
  {
    const InputFile file(path, {});
    begin = file.bytes().data();
    ASSERT_EQ(file.bytes().size(), size);
    EXPECT_TRUE(file.bytes().starts_with("0 0 1 1\n"));
    ASSERT_NE(name_of_mapped(begin), nullptr);
    EXPECT_EQ(std::string{name_of_mapped(begin)}, path);
    EXPECT_EQ(name_of_mapped(begin + size - 1), name_of_mapped(begin));
    EXPECT_EQ(name_of_mapped(begin + size), nullptr);
    EXPECT_EQ(name_of_mapped(&path), nullptr);
  }
  EXPECT_EQ(name_of_mapped(begin), nullptr);
}

TEST(InputFile, BytesInMemoryAreAFileToo) {
  const InputFile file = InputFile::of_bytes("a name", std::string_view("a\0b", 3));
  EXPECT_EQ(file.name(), "a name");
  EXPECT_EQ(file.bytes(), std::string_view("a\0b", 3));
}

}  // namespace
}  // namespace warren
