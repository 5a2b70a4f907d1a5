// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_file.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/rng.hpp"
#include "tests/paths.hpp"
#include "tests/solve/kept/mend_checksums.hpp"
#include "tests/solve/kept/small_roadmap_file.hpp"

namespace warren {
namespace {

using test::read_at;
using test::SmallRoadmapFile;

/// The table of docs/file_formats.md, number by number.
TEST(WriteRoadmapFile, PutsEachByteWhereTheDocumentSaysIt) {
  const SmallRoadmapFile small;
  const std::string bytes = small.written();
  EXPECT_EQ(bytes.substr(0, 8), "\x89WRRMAP\n");
  EXPECT_EQ(read_at<std::uint16_t>(bytes, 8), 1U);
  EXPECT_EQ(read_at<std::uint16_t>(bytes, 10), 0U);
  EXPECT_EQ(read_at<std::uint32_t>(bytes, 12), 0x01020304U);
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 16), bytes.size());
  EXPECT_EQ(read_at<std::uint32_t>(bytes, 24), 4U);
  EXPECT_EQ(read_at<std::uint32_t>(bytes, 28), 384U);  // 64 + 4 * 64 + 3 * 8 + 8, up to the next multiple of 64
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 32), small.header.world_hash);
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 40), 42U);
  EXPECT_EQ(bytes.substr(48, 16), std::string("warren 0.1.0") + std::string(4, '\0'));
  const std::size_t entry = 64 + 64;  // of "states"
  EXPECT_EQ(bytes.substr(entry, 16), std::string("states") + std::string(10, '\0'));
  EXPECT_EQ(bytes.substr(entry + 16, 4), std::string("<f8") + '\0');
  EXPECT_EQ(read_at<std::uint32_t>(bytes, entry + 20), 0U);
  EXPECT_EQ(read_at<std::uint32_t>(bytes, 64 + 3 * 64 + 20), 1U);  // "edge.first" is optional
  EXPECT_EQ(read_at<std::uint64_t>(bytes, entry + 24), 448U);      // behind "meta" at 384
  EXPECT_EQ(read_at<std::uint64_t>(bytes, entry + 32), 4U);
  EXPECT_EQ(bytes.substr(entry + 40, 24), std::string(24, '\0'));
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 320), test::checksum_of(bytes, 384, small.meta.size()));
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 328), test::checksum_of(bytes, 448, 32));
  EXPECT_EQ(read_at<std::uint64_t>(bytes, 376), test::checksum_of(bytes, 0, 376));
  EXPECT_EQ(bytes.substr(384, small.meta.size()), small.meta);
  EXPECT_EQ(read_at<double>(bytes, 448 + 16), 1e60);
  EXPECT_EQ(bytes.substr(480, 32), std::string(32, '\0'));
  EXPECT_EQ(bytes.size(), 512U + 448U);  // 101 numbers of 4 bytes, up to the next multiple of 64
}

TEST(WriteRoadmapFile, GivesTheSameBytesForAnyNumberOfThreads) {
  std::vector<std::uint32_t> numbers((std::size_t{3} << 18) + 5);  // 3 MiB and a little more
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint32_t>(i * 2654435761U);
  const TemporaryDirectory directory;
  const auto written = [&](unsigned threads) {
    const std::vector sections{roadmap_section("to", numbers)};
    test::write_sections(directory.file("a"), {1, 2, "x"}, sections, {.threads = threads});
    return directory.read("a");
  };
  const std::string one = written(1);
  EXPECT_EQ(read_at<std::uint64_t>(one, 128 + 24), test::checksum_of(one, 192 + (std::size_t{3} << 20), 20));
  for (const unsigned threads : {2U, 3U, 8U}) EXPECT_EQ(written(threads), one) << threads;
}

TEST(WriteRoadmapFile, WritesAsManySectionsAndAsLongNamesAsReadersTake) {
  const std::vector<char> one{'x'};
  std::vector<std::string> names{"sixteen.letters_"};
  while (names.size() < 64) names.push_back("s" + std::to_string(names.size()));
  std::vector<RoadmapSection> sections;
  for (const std::string& name : names) sections.push_back(roadmap_section(name, one));
  const TemporaryDirectory directory;
  test::write_sections(directory.file("a"), {1, 2, "sixteen.letters_"}, sections);
  const RoadmapFile file(directory.file("a"), {});
  ASSERT_EQ(file.sections().size(), 64U);
  for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(file.sections()[i].name, names[i]);
  EXPECT_EQ(file.header().writer, "sixteen.letters_");
}

TEST(WriteRoadmapFile, WritesWhatTwentyLinesOfPythonRead) {
  if (std::system("python3 -c '' 2>/dev/null") != 0) GTEST_SKIP() << "no python3";  // NOLINT(cert-env33-c)
  const TemporaryDirectory directory;
  const SmallRoadmapFile small;
  test::write_sections(directory.file("a.roadmap"), small.header, small.sections());
  const std::string line = "python3 -B " + test::source_dir() + "/tests/solve/kept/read_roadmap.py " +
                           directory.file("a.roadmap") + " >" + directory.file("out");
  ASSERT_EQ(std::system(line.c_str()), 0);  // NOLINT(cert-env33-c)
  std::string meta;
  for (const char c : small.meta) meta += (meta.empty() ? "" : ", ") + std::to_string(c);
  std::string first;
  for (const std::uint32_t n : small.first) first += (first.empty() ? "" : ", ") + std::to_string(n);
  EXPECT_EQ(directory.read("out"),
            "{\"writer\": \"warren 0.1.0\", \"world\": 81985529216486895, \"recipe\": 42, \"sections\": {"
            "\"meta\": {\"optional\": false, \"numbers\": [" +
                meta +
                "]}, "
                "\"states\": {\"optional\": false, \"numbers\": [0.5, -1.25, 1e+60, 3.0]}, "
                "\"empty\": {\"optional\": false, \"numbers\": []}, "
                "\"edge.first\": {\"optional\": true, \"numbers\": [" +
                first + "]}}}\n");
}

}  // namespace
}  // namespace warren
