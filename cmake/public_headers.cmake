# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFROM=TREE -DTO=DIR -DFOLDERS="core parallel ..." -P public_headers.cmake: the headers as others include them:
# TO/warren/core/base/types.hpp for <warren/core/base/types.hpp>, and TO/warren/warren.hpp for all that most programs
# need. Includes within them name warren/ too, so that no header of the same name in somebody else's tree is taken for
# one of these. Writes only what has changed.
cmake_minimum_required(VERSION 3.25)
separate_arguments(FOLDERS)
foreach(folder IN LISTS FOLDERS)
  file(GLOB_RECURSE headers RELATIVE ${FROM} ${FROM}/${folder}/*.hpp)
  foreach(header IN LISTS headers)
    file(READ ${FROM}/${header} text)
    string(REGEX REPLACE "#include \"([a-z_0-9/]+[.]hpp)\"" "#include <warren/\\1>" text "${text}")
    string(REPLACE "pictures/warren.hpp" "warren.hpp" header ${header})
    file(CONFIGURE OUTPUT ${TO}/warren/${header} CONTENT "${text}" @ONLY)
  endforeach()
endforeach()
