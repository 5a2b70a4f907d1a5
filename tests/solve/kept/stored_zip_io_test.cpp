// SPDX-License-Identifier: BSD-3-Clause
// ZIP64 is asked of a stranger's reader in tests/exports/read_exports.py.
#include "solve/kept/roadmap_formats_io.hpp"

#include <gtest/gtest.h>

#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

std::string bytes_of_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); ++i) {
    if (hex[i] == ' ') continue;
    bytes.push_back(static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
    ++i;
  }
  return bytes;
}

TEST(StoredZip, IsAHeadTheBytesTheirCheckSumAndADirectory) {
  const TemporaryDirectory directory;
  OutputFile file(directory.file("a.zip"), {});
  StoredZip zip(file);
  zip.begin("n", 3);
  zip.write("a");
  zip.write("bc");
  zip.end();
  zip.close();
  file.commit();
  EXPECT_EQ(directory.read("a.zip"),
            bytes_of_hex("504b0304 1400 0800 0000 0000 2100 00000000 00000000 00000000 0100 0000 6e 616263 "
                         "504b0708 c2412435 03000000 03000000 "
                         "504b0102 1400 1400 0800 0000 0000 2100 c2412435 03000000 03000000 0100 0000 0000 0000 0000 "
                         "00000000 00000000 6e "
                         "504b0506 0000 0000 0100 0100 2f000000 32000000 0000"));
}

}  // namespace
}  // namespace warren
