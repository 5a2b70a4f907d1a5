// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a JSON text as its parser takes them, one by one: lines are counted, and every 64 KiB the deadline is
// looked at and the memory asked for that the parser may need before the next look, however long a word or a run of
// blanks is.
#pragma once

#include <cstddef>
#include <iterator>
#include <string_view>

#include "parallel/execution.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

class JsonBytes {
 public:
  /// Begins behind a byte order mark. Both must outlive it, and it all of its iterators.
  JsonBytes(const InputFile& file, const Execution& execution);

  /// The line of the byte that is taken next, from 1 on.
  const std::size_t& line() const { return line_; }

  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    Iterator(const char* at, JsonBytes* bytes) : at_(at), bytes_(bytes) {}
    const char& operator*() const { return *at_; }
    /// Throws Stopped, and InputError for numbers longer than any is.
    Iterator& operator++() {
      if (*at_ == '\n') ++bytes_->line_;
      if (++at_ == bytes_->next_look_) bytes_->look();
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

   private:
    const char* at_;
    JsonBytes* bytes_;
  };

  Iterator begin() { return {text_.data(), this}; }
  Iterator end() { return {text_.data() + text_.size(), this}; }

 private:
  void look();

  const InputFile& file_;
  const Execution& execution_;
  std::string_view text_;
  const char* next_look_;
  std::size_t line_ = 1;
  std::size_t without_quote_ = 0;  // bytes since the last quotation mark, or a little more
};

}  // namespace warren
