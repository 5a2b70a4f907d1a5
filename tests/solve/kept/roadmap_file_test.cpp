// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <thread>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/kept/mend_checksums.hpp"
#include "tests/solve/kept/small_roadmap_file.hpp"

namespace warren {
namespace {

using test::mend_checksums;
using test::SmallRoadmapFile;
using test::write_at;

const Execution one_thread{.threads = 1};

/// What is said of bytes that no file may have; "" where they are taken.
std::string refusal(std::string_view bytes) {
  return test::refusal<InputError>([&] { const auto file = RoadmapFile::of_bytes("a.roadmap", bytes, one_thread); });
}

bool says(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(RoadmapFile, GivesBackWhatWasWritten) {
  const SmallRoadmapFile small;
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.roadmap");
  test::write_sections(path, small.header, small.sections());
  const RoadmapFile file(path, {});
  EXPECT_EQ(file.header().world_hash, small.header.world_hash);
  EXPECT_EQ(file.header().recipe_hash, 42U);
  EXPECT_EQ(file.header().writer, "warren 0.1.0");
  ASSERT_EQ(file.sections().size(), 4U);
  EXPECT_EQ(file.sections()[3].name, "edge.first");
  EXPECT_TRUE(file.sections()[3].optional);
  const auto meta = file.section<char>("meta", {});
  EXPECT_EQ(std::string(meta.begin(), meta.end()), small.meta);
  const auto states = file.section<double>("states", {});
  EXPECT_EQ(std::vector(states.begin(), states.end()), small.states);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(states.data()) % alignof(double), 0U);
  const auto first = file.optional_section<std::uint32_t>("edge.first", {});
  ASSERT_TRUE(first);
  EXPECT_EQ(std::vector(first->begin(), first->end()), small.first);
  EXPECT_TRUE(file.section<std::uint64_t>("empty", {}).empty());
  EXPECT_FALSE(file.optional_section<std::uint64_t>("nowhere", {}));
}

TEST(RoadmapFile, TakesAFileWithoutSections) {
  const TemporaryDirectory directory;
  test::write_sections(directory.file("a"), {}, {});
  EXPECT_TRUE(RoadmapFile(directory.file("a"), {}).sections().empty());
}

TEST(RoadmapFile, RefusesToGiveASectionThatIsMissingOrOfAnotherType) {
  const auto file = RoadmapFile::of_bytes("a.roadmap", SmallRoadmapFile{}.written(), {});
  EXPECT_EQ(test::refusal<InputError>([&] { file.section<double>("nowhere", {}); }),
            "a.roadmap: section `nowhere` is missing");
  EXPECT_EQ(test::refusal<InputError>([&] { file.section<float>("states", {}); }),
            "a.roadmap: section `states` must have elements of type <f4 (found: <f8)");
  EXPECT_EQ(test::refusal<InputError>([&] { file.optional_section<float>("states", {}); }),
            "a.roadmap: section `states` must have elements of type <f4 (found: <f8)");
}

TEST(RoadmapFile, RefusesUnknownSectionsUnlessTheyAreOptional) {
  const auto file = RoadmapFile::of_bytes("a.roadmap", SmallRoadmapFile{}.written(), {});
  constexpr std::array<std::string_view, 3> all{"meta", "states", "empty"};
  EXPECT_NO_THROW(file.refuse_unknown(all));
  const std::string said = test::refusal<InputError>([&] { file.refuse_unknown(std::span(all).first(2)); });
  EXPECT_TRUE(says(said, "doesn't know section `empty`")) << said;
  EXPECT_TRUE(says(said, "warren 0.1.0")) << said;
}

/// One 4-KB file of several sections, all of its 32,768 bits.
TEST(RoadmapFile, RefusesEveryFlippedBit) {
  SmallRoadmapFile small;
  small.first = SmallRoadmapFile::counted((4096 - 512) / 4 - 3);
  std::string bytes = small.written();
  ASSERT_EQ(bytes.size(), 4096U);
  ASSERT_EQ(refusal(bytes), "");
  std::size_t taken = 0;
  std::size_t nameless = 0;
  for (const std::uint64_t bit : test::seeds(8 * bytes.size(), bytes.size(), 0)) {
    const auto mask = static_cast<char>(1U << (bit % 8));
    bytes[bit / 8] ^= mask;
    const std::string said = refusal(bytes);
    taken += said.empty() ? 1U : 0U;
    const bool names = says(said, "section `") || says(said, "header") || says(said, "roadmap file");
    nameless += names && said.starts_with("a.roadmap: ") ? 0U : 1U;
    bytes[bit / 8] ^= mask;
  }
  EXPECT_EQ(taken, 0U);
  EXPECT_EQ(nameless, 0U);
}

TEST(RoadmapFile, RefusesAFileThatIsCutOffAnywhere) {
  const std::string bytes = SmallRoadmapFile{}.written();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string said = refusal(std::string_view(bytes).substr(0, size));
    const std::string expected = size < 8
                                     ? "expected a roadmap file"
                                     : "cut off: expected " + std::to_string(size < 64 ? 64 : bytes.size()) + " bytes";
    EXPECT_TRUE(says(said, expected)) << size << ": " << said;
    EXPECT_TRUE(size < 8 || says(said, "(found: " + std::to_string(size) + " bytes)")) << said;
  }
}

TEST(RoadmapFile, RefusesBytesBehindItsEnd) {
  std::string bytes = SmallRoadmapFile{}.written();
  bytes += '\0';
  EXPECT_EQ(refusal(bytes),
            "a.roadmap: bytes follow the end of this roadmap file: expected 960 bytes (found: 961 bytes)");
}

TEST(RoadmapFile, NamesTheDamagedSection) {
  std::string bytes = SmallRoadmapFile{}.written();
  bytes[448 + 9] ^= 1;
  EXPECT_EQ(refusal(bytes),
            "a.roadmap: section `states` is damaged within bytes 448 to 479: their checksum is another one; make or "
            "copy the roadmap again");
}

constexpr std::size_t entries = 64;  // meta, states, empty, edge.first
constexpr std::size_t meta_entry = entries;
constexpr std::size_t states_entry = entries + 64;
constexpr std::size_t last_entry = entries + 192;
constexpr std::size_t flags_at = 20;
constexpr std::size_t offset_at = 24;
constexpr std::size_t elements_at = 32;
constexpr std::size_t reserved_at = 40;

struct Forgery {
  const char* name;
  void (*change)(std::string& bytes);
  const char* said;
};

/// All checksums are right: these are the rules behind them.
constexpr std::array forgeries{
    Forgery{"no roadmap", [](std::string& b) { b[1] = 'w'; }, "expected a roadmap file, which begins with"},
    Forgery{"text mode", [](std::string& b) { b[7] = '\r'; }, "expected a roadmap file, which begins with"},
    Forgery{"major version", [](std::string& b) { b[8] = 2; },
            "format version 2.0 and expected is 1: read it with its writer or make it again (found: written by `warren "
            "0.1.0`)"},
    Forgery{"big-endian", [](std::string& b) { write_at(b, 12, 0x04030201U); }, "this roadmap file is big-endian"},
    Forgery{"no mark", [](std::string& b) { write_at(b, 12, 7U); }, "the header has no mark of byte order"},
    Forgery{"longer", [](std::string& b) { write_at(b, 16, std::uint64_t{9999}); }, "cut off: expected 9999 bytes"},
    Forgery{"shorter", [](std::string& b) { write_at(b, 16, std::uint64_t{99}); }, "bytes follow the end"},
    Forgery{"many sections", [](std::string& b) { write_at(b, 24, 65U); }, "at most 64 sections (found: 65)"},
    Forgery{"more sections", [](std::string& b) { write_at(b, 24, 6U); }, "no room for its sections"},
    Forgery{"fewer sections", [](std::string& b) { write_at(b, 24, 3U); }, "the header must have"},
    Forgery{"small header", [](std::string& b) { write_at(b, 28, 64U); }, "the header of this roadmap file is damaged"},
    Forgery{"no header", [](std::string& b) { write_at(b, 28, 0U); }, "the header of this roadmap file is damaged"},
    Forgery{"odd header", [](std::string& b) { write_at(b, 28, 383U); }, "the header of this roadmap file is damaged"},
    Forgery{"huge header", [](std::string& b) { write_at(b, 28, 0xffffffc0U); }, "cut off: expected 4294967232"},
    Forgery{"writer's end", [](std::string& b) { b[63] = 'x'; }, "the writer must be followed by zeros alone"},
    Forgery{"empty name", [](std::string& b) { b[meta_entry] = '\0'; }, "a section's name must be"},
    Forgery{"bad name", [](std::string& b) { b[meta_entry] = 'M'; }, "a section's name must be"},
    Forgery{"name's end", [](std::string& b) { b[meta_entry + 15] = 'x'; },
            "the name of section `meta` must be followed by zeros alone"},
    Forgery{"twice", [](std::string& b) { b.replace(states_entry, 6, std::string("meta\0\0", 6)); },
            "section `meta` stands twice"},
    Forgery{"type", [](std::string& b) { b[states_entry + 16] = '>'; },
            "section `states` must have elements of a type"},
    Forgery{"flags", [](std::string& b) { b[states_entry + flags_at] = 2; }, "section `states` has flags that are not"},
    Forgery{"high flags", [](std::string& b) { b[last_entry + flags_at + 3] = 1; }, "has flags that are not known"},
    Forgery{"reserved", [](std::string& b) { b[states_entry + 63] = 1; }, "must have zeros in its reserved bytes"},
    Forgery{"reserved", [](std::string& b) { b[states_entry + reserved_at] = 1; }, "zeros in its reserved bytes"},
    Forgery{"overlap", [](std::string& b) { write_at(b, states_entry + offset_at, std::uint64_t{384}); },
            "section `states` must begin at byte 448, after what is before it (found: 384)"},
    Forgery{"gap", [](std::string& b) { write_at(b, states_entry + offset_at, std::uint64_t{512}); },
            "section `states` must begin at byte 448"},
    Forgery{"misaligned", [](std::string& b) { write_at(b, states_entry + offset_at, std::uint64_t{449}); },
            "section `states` must begin at byte 448"},
    Forgery{"far away", [](std::string& b) { write_at(b, states_entry + offset_at, ~std::uint64_t{63}); },
            "section `states` must begin at byte 448"},
    Forgery{"in the header", [](std::string& b) { write_at(b, meta_entry + offset_at, std::uint64_t{0}); },
            "section `meta` must begin at byte 384"},
    Forgery{"beyond the end", [](std::string& b) { write_at(b, last_entry + elements_at, std::uint64_t{113}); },
            "section `edge.first` ends beyond the file, at byte 964 (found: 960 bytes)"},
    Forgery{"overflow", [](std::string& b) { write_at(b, states_entry + elements_at, std::uint64_t{1} << 61U); },
            "section `states` has more elements than a file of 960 bytes can hold (found: 2305843009213693952)"},
    Forgery{"overflow by one",
            [](std::string& b) { write_at(b, states_entry + elements_at, (std::uint64_t{1} << 61U) + 4); },
            "section `states` has more elements"},
    Forgery{"an empty block", [](std::string& b) { write_at(b, meta_entry + elements_at, std::uint64_t{0}); },
            "must be"},
    Forgery{"an end too many", [](std::string& b) { b.append(64, '\0'), write_at(b, 16, std::uint64_t{b.size()}); },
            "the sections end at byte 960 (found: 1024 bytes)"},
    Forgery{"padding", [](std::string& b) { b[447] = 1; },
            "the bytes behind section `meta` must be zeros, bytes 401 to 447"},
    Forgery{"last padding", [](std::string& b) { b[959] = 1; }, "the bytes behind section `edge.first` must be zeros"},
    Forgery{"header's padding", [](std::string& b) { b[344] = 1; },
            "the bytes behind the header must be zeros, bytes 344"},
};

TEST(RoadmapFile, RefusesForgedHeaders) {
  const std::string sound = SmallRoadmapFile{}.written();
  for (const Forgery& forgery : forgeries) {
    std::string bytes = sound;
    forgery.change(bytes);
    mend_checksums(bytes);
    const std::string said = refusal(bytes);
    EXPECT_TRUE(says(said, forgery.said)) << forgery.name << ": " << said;
  }
}

TEST(RoadmapFile, TakesALaterMinorVersionAndTypesToCome) {
  std::string bytes = SmallRoadmapFile{}.written();
  bytes[10] = 3;
  bytes[last_entry + 17] = 'z';
  mend_checksums(bytes);
  EXPECT_EQ(refusal(bytes), "");
}

TEST(RoadmapFile, ReadsAPipe) {
  const std::string bytes = SmallRoadmapFile{}.written();
  const TemporaryDirectory directory;
  const std::string path = directory.file("pipe");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path, std::ios::binary) << bytes; });
  const RoadmapFile file(path, {});
  writer.join();
  EXPECT_EQ(file.section<double>("states", {}).size(), 4U);
}

/// A file above 64 MiB, with one damaged byte far within.
class LargeRoadmapFile : public ::testing::Test {
 protected:
  static constexpr std::size_t in_block = checked_block / sizeof(std::uint64_t);
  static constexpr std::size_t blocks = 100;
  static constexpr std::size_t damaged = 50;

  void SetUp() override {
    std::vector<std::uint64_t> numbers(blocks * in_block);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i * 0x9e3779b97f4a7c15U;
    const std::vector<char> text(1000, 'x');
    const std::vector sections{roadmap_section("numbers", numbers), roadmap_section("text", text)};
    test::write_sections(path_, {}, sections);
    offset_ = RoadmapFile(path_, {}).find("numbers")->offset;
  }
  void flip(std::size_t at) const {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char byte = static_cast<char>(file.get() ^ 0x10);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(byte);
  }

  TemporaryDirectory directory_;
  std::string path_ = directory_.file("large.roadmap");
  std::size_t offset_ = 0;
};

/// Its numbers, each checked before it is seen.
struct Looked {
  explicit Looked(const RoadmapFile& file) : look(file.first_look(*file.find("numbers"))) {
    const std::span<const std::byte> bytes = file.unchecked_bytes(*file.find("numbers"));
    all = {reinterpret_cast<const std::uint64_t*>(bytes.data()), bytes.size() / sizeof(std::uint64_t)};
  }
  std::span<const std::uint64_t> part(std::size_t first, std::size_t count) const {
    look.ensure(first * sizeof(std::uint64_t), count * sizeof(std::uint64_t));
    return all.subspan(first, count);
  }
  std::uint64_t operator[](std::size_t i) const { return part(i, 1).front(); }

  std::span<const std::uint64_t> all;
  FirstLook look;
};

TEST_F(LargeRoadmapFile, IsCheckedWhereSomebodyLooks) {
  flip(offset_ + damaged * checked_block + 12345);
  const RoadmapFile file(path_, {});  // nobody has looked yet
  const Looked numbers(file);
  ASSERT_EQ(numbers.all.size(), blocks * in_block);
  for (std::size_t block = 0; block < blocks; ++block) {
    if (block == damaged) continue;
    const std::size_t i = block * in_block + block;
    EXPECT_EQ(numbers[i], i * 0x9e3779b97f4a7c15U);
  }
  const std::string first = std::to_string(offset_ + damaged * checked_block);
  const auto expected = path_ + ": section `numbers` is damaged within bytes " + first + " to ";
  const std::size_t at = damaged * in_block;
  EXPECT_EQ(numbers[at - 1], (at - 1) * 0x9e3779b97f4a7c15U);
  EXPECT_EQ(numbers[at + in_block], (at + in_block) * 0x9e3779b97f4a7c15U);
  for (int twice = 0; twice < 2; ++twice) {
    EXPECT_TRUE(says(test::refusal<InputError>([&] { numbers[at]; }), expected));
    EXPECT_TRUE(says(test::refusal<InputError>([&] { numbers[at + in_block - 1]; }), expected));
    EXPECT_TRUE(says(test::refusal<InputError>([&] { numbers.part(at - 1, 2); }), expected));
    EXPECT_TRUE(says(test::refusal<InputError>([&] { numbers.part(at - 1, 3 * in_block); }), expected));
    EXPECT_TRUE(says(test::refusal<InputError>([&] { file.section<std::uint64_t>("numbers", {}); }), expected));
    EXPECT_TRUE(says(test::refusal<InputError>([&] { file.check_all({}); }), expected));
  }
  EXPECT_EQ(numbers.part(at - 2, 2).size(), 2U);
  EXPECT_TRUE(numbers.part(at, 0).empty());
  EXPECT_EQ(file.section<char>("text", {}).size(), 1000U);
}

TEST_F(LargeRoadmapFile, NamesItsFirstDamagedBlockForAnyNumberOfThreads) {
  for (const std::size_t block : {blocks - 1, damaged, damaged + 1}) flip(offset_ + block * checked_block);
  const std::string first = "bytes " + std::to_string(offset_ + damaged * checked_block) + " to";
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    const RoadmapFile file(path_, {.threads = threads});
    EXPECT_TRUE(says(test::refusal<InputError>([&] { file.check_all({.threads = threads}); }), first)) << threads;
  }
}

TEST_F(LargeRoadmapFile, HasItsSmallSectionsAndZerosCheckedWhenItIsOpened) {
  const std::size_t text = offset_ + blocks * checked_block;
  flip(text + 999);
  EXPECT_TRUE(says(test::refusal<InputError>([&] { RoadmapFile(path_, {}); }), "section `text` is damaged"));
  flip(text + 999);
  flip(text + 1001);
  EXPECT_TRUE(says(test::refusal<InputError>([&] { RoadmapFile(path_, {}); }),
                   "the bytes behind section `text` must be zeros"));
}

TEST_F(LargeRoadmapFile, IsLookedAtByManyThreads) {
  const RoadmapFile file(path_, {});
  const Looked numbers(file);
  std::vector<std::thread> threads;
  std::array<std::size_t, 4> wrong{};
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < numbers.all.size(); i += 4099)
        wrong[t] += numbers[i] != i * 0x9e3779b97f4a7c15U ? 1U : 0U;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, (std::array<std::size_t, 4>{}));
  EXPECT_NO_THROW(file.check_all({}));
}

}  // namespace
}  // namespace warren
