# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFROM=FOLDER -DTO=FILE.cpp -P embed_files.cmake: the bytes of the folder's files, as tools/verbs/example_files.hpp
# declares them, in the order of their names.
cmake_minimum_required(VERSION 3.25)
file(GLOB files RELATIVE ${FROM} ${FROM}/*)
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
  file(SIZE ${FROM}/${file} size)
  file(READ ${FROM}/${file} bytes HEX)
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  string(APPEND rows "    {\"${file}\", {\"${bytes}\", ${size}}},\n")
endforeach()
file(WRITE ${TO} "// Made by cmake/embed_files.cmake.
#include \"tools/verbs/example_files.hpp\"

namespace warren {

std::span<const ExampleFile> example_files() {
  static constexpr ExampleFile files[] = {
${rows}  };
  return files;
}

}  // namespace warren
")
