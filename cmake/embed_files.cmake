# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFROM=FOLDER -DTO=FILE.cpp -DHEADER=H -DFUNCTION=F -P embed_files.cmake: the bytes of the folder's files that are no C++,
# as the header H declares them (std::span<const EmbeddedFile> F()), in the order of their names.
cmake_minimum_required(VERSION 3.25)
file(GLOB files RELATIVE ${FROM} ${FROM}/*)
list(FILTER files EXCLUDE REGEX "[.][ch]pp$")
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
  file(SIZE ${FROM}/${file} size)
  file(READ ${FROM}/${file} bytes HEX)
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  file(SHA256 ${FROM}/${file} digest)
  string(APPEND rows "    {\"${file}\", {\"${bytes}\", ${size}}, \"${digest}\"},\n")
endforeach()
file(WRITE ${TO} "// Made by cmake/embed_files.cmake.
#include \"${HEADER}\"

namespace warren {

std::span<const EmbeddedFile> ${FUNCTION}() {
  static constexpr EmbeddedFile files[] = {
${rows}  };
  return files;
}

}  // namespace warren
")
