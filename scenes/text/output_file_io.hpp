// SPDX-License-Identifier: BSD-3-Clause
// Where results are written. A regular file is written beside its place, as .NAME.part, and renamed by commit(), so
// nothing half-written ever stands under the name asked for; devices, pipes and "-" (standard output) are written
// straight. What a killed run left behind is removed by the next that writes the same file: whoever writes a .part
// holds its lock, which ends with the process. A reader that closes its pipe is a WriteError, not a signal. Waiting for
// a slow reader polls the deadline.
#pragma once

#include <algorithm>
#include <array>
#include <exception>
#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"

namespace warren {

class OutputFile : NotCopied {
 public:
  /// Throws WriteError if the place can't be written, Stopped while waiting for a pipe's reader.
  OutputFile(const std::string& path, const Execution& execution);
  /// Without commit(), a regular file is left as it was.
  ~OutputFile();

  /// Appends bytes; small pieces are collected. Throws WriteError (full disk, closed pipe), Stopped.
  void write(std::string_view bytes);
  /// Writes what is left and asks the file system whether it has it all: for files that belong together, each of them
  /// before the first commit(). Throws WriteError, Stopped. Only commit() may follow.
  void complete();
  /// Completes the file, closes it and puts it in its place. Throws WriteError, Stopped. Nothing may follow.
  void commit();

 private:
  void open_straight(const std::string& path);
  void open_beside(std::string target);
  bool create(std::string part);
  void flush();
  void write_now(std::string_view bytes);
  void discard() noexcept;
  [[noreturn]] void fail(int error) const;

  Execution execution_;
  std::string name_;
  std::string target_;     ///< where the file goes; empty: written straight
  std::string temporary_;  ///< what is written until then
  std::string pending_;
  int file_ = -1;
};

/// Takes back the first of two files that belong together, if it was not there before and the second fails: half of
/// them is none. Made before the first is written.
class FirstOfTwoFiles : NotCopied {
 public:
  explicit FirstOfTwoFiles(const std::string& path);
  /// Removes the file, unless there was one before or keep() was called.
  ~FirstOfTwoFiles();
  /// Both are in their places.
  void keep() { path_.clear(); }

 private:
  std::string path_;  // empty: stays
};

void write_file(const std::string& path, std::string_view bytes, const Execution& execution);

/// Long texts, made piece by piece on all cores and written in their order: a file of any size goes through 64 pieces
/// of memory, and its bytes are the same for any number of threads. Calls make(Range, std::string&), which appends, for
/// each piece of `grain` indices of 0 .. n - 1, and sink.write() with what it made, one after the other. Throws
/// Stopped, and as make and the sink do.
template <class Sink, class Make>
void write_in_pieces(Sink& sink, std::size_t n, std::size_t grain, const Execution& execution, const Make& make) {
  constexpr std::size_t pieces_at_once = 64;
  std::array<std::string, pieces_at_once> texts;
  std::array<std::exception_ptr, pieces_at_once> errors;  // the first by number, not by time
  for (std::size_t begin = 0; begin < n; begin += pieces_at_once * grain) {
    const std::size_t count = std::min(pieces_at_once * grain, n - begin);
    for_chunks(count, grain, execution, [&](Range range) {
      std::string& text = texts[range.first / grain];
      text.clear();
      try {
        make(Range{begin + range.first, begin + range.last}, text);
      } catch (...) {
        errors[range.first / grain] = std::current_exception();
      }
    });
    for (std::size_t piece = 0; piece < chunk_count(count, grain); ++piece) {
      if (errors[piece]) std::rethrow_exception(errors[piece]);
      sink.write(texts[piece]);
    }
  }
}

/// Does an OutputFile of that name write at once what can't be taken back? "-", the names of open files, and whatever
/// is there and no regular file.
bool is_written_straight(const std::string& path);

/// "-" and the system's names for standard output.
bool is_standard_output(std::string_view path);

/// The path of the file that `path` leads to: symbolic links followed, also to where nothing is yet.
std::string behind_links(std::string path);

}  // namespace warren
