# SPDX-License-Identifier: BSD-3-Clause
# cmake -DREADME=FILE -DPROGRAM=FILE -P check_readme.cmake: the readme shows the program byte for byte, but for its SPDX line.
cmake_minimum_required(VERSION 3.25)
file(READ ${README} readme)
file(READ ${PROGRAM} program)
string(REGEX REPLACE "^// SPDX[^\n]*\n" "" program "${program}")
string(FIND "${readme}" "```cpp\n${program}```\n" place)
if(place EQUAL -1)
  message(FATAL_ERROR "${README} does not show ${PROGRAM} as it is")
endif()
