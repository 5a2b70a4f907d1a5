// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/scratch_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/properties.hpp"

namespace warren::fuzz {
namespace {

class ScratchFolder : NotCopied {
 public:
  ScratchFolder() : path_(parent() + "/warren-fuzz-XXXXXX") {
    demand(::mkdtemp(path_.data()) != nullptr, "a folder for files");
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  static std::string parent() {
    if (const char* folder = std::getenv("TMPDIR")) return folder;
    return std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
  }

  std::string path_;
};

}  // namespace

std::string scratch_file(std::string_view name) {
  static const ScratchFolder folder;
  return folder.path() + "/" + std::string{name};
}

std::string write_scratch(std::string_view name, std::string_view bytes) {
  const std::string path = scratch_file(name);
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  demand(file.good(), "a file that can be written");
  return path;
}

}  // namespace warren::fuzz
