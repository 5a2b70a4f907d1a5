// SPDX-License-Identifier: BSD-3-Clause
// The bytes of an input: a pipe, device, standard input or small file read to its end; a file of 16 MiB and more mapped
// into memory (nothing is read before it is looked at, pages can be given back). Waiting for a pipe polls the deadline
// every 50 ms. A mapped file must not become shorter: who looks at what is gone gets SIGBUS (core/run/mapped_ranges.hpp
// tells a handler whose it was; the program says that the file can't be read).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "core/run/mapped_ranges.hpp"

namespace warren {

/// Of what kind a file is, its first so many bytes tell: blanks that go on for longer are nobody's.
inline constexpr std::size_t bytes_that_tell = std::size_t{1} << 16;

/// Without the byte order mark of UTF-8 that it may begin with.
inline std::string_view without_byte_order_mark(std::string_view text) {
  return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
}

class InputFile : NotCopied {
 public:
  /// Opens and maps or reads; "-" is standard input. Throws ReadError (also for directories), Stopped.
  InputFile(const std::string& path, const Execution& execution);
  /// Bytes that are in memory already, under the name that messages shall give: a copy.
  static InputFile of_bytes(std::string name, std::string_view bytes) { return {std::move(name), bytes, Held{}}; }
  ~InputFile();

  /// The path as given, or "standard input".
  const std::string& name() const { return name_; }
  std::string_view bytes() const { return bytes_; }
  /// Gives the pages around bytes first .. last - 1 back: they no longer count as held, and are read again when looked
  /// at again. Nothing happens to what was read from a pipe. Any threads may call it.
  void forget(std::size_t first, std::size_t last) const noexcept;

 private:
  struct Held {};
  InputFile(std::string name, std::string_view bytes, Held)
      : name_(std::move(name)), read_(bytes.begin(), bytes.end()) {
    bytes_ = {read_.data(), read_.size()};
  }
  void map(int file, std::size_t size);
  /// `size`: that of a regular file, which is read from its beginning and stays at it.
  void read_all(int file, std::optional<std::size_t> size, const Execution& execution);

  std::string name_;
  std::string_view bytes_;
  std::string shown_name_;
  void* map_ = nullptr;
  std::optional<MappedRange> range_;
  RawVector<char> read_;
};

}  // namespace warren
