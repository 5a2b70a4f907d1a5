# SPDX-License-Identifier: BSD-3-Clause
# cmake -DROOT=DIR -DTO=FILE.cpp [-DCOMMIT=NAME] -P commit.cmake: which commit the sources are of, as
# tools/words/help.hpp declares it. Run by every build; the file is touched only where that has changed.
cmake_minimum_required(VERSION 3.25)
if(NOT COMMIT)
  set(COMMIT unknown)
  find_program(GIT git)
  if(GIT AND EXISTS ${ROOT}/.git)
    execute_process(COMMAND ${GIT} -C ${ROOT} describe --always --dirty --abbrev=12 --exclude=*
                    OUTPUT_VARIABLE said RESULT_VARIABLE code OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(code EQUAL 0)
      set(COMMIT ${said})
    endif()
  endif()
endif()
set(text "// Made by cmake/commit.cmake.
#include \"tools/words/help.hpp\"

namespace warren::tools {

std::string_view build_commit() { return \"${COMMIT}\"; }

}  // namespace warren::tools
")
set(before)
if(EXISTS ${TO})
  file(READ ${TO} before)
endif()
if(NOT before STREQUAL text)
  file(WRITE ${TO} "${text}")
endif()
