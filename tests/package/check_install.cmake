# SPDX-License-Identifier: BSD-3-Clause
# cmake -DBUILD=DIR -DSOURCE=DIR -DSCRATCH=DIR -P check_install.cmake: installs program and documents below SCRATCH, asks
# whether all is there that people look for, whether man and bash understand it, and takes it all back.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH}/manifests)
set(prefix ${SCRATCH}/prefix)
foreach(component IN ITEMS program documents)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${prefix} OUTPUT_QUIET
                  COMMAND_ERROR_IS_FATAL ANY)
  file(RENAME ${BUILD}/install_manifest_${component}.txt ${SCRATCH}/manifests/install_manifest_${component}.txt)
endforeach()

foreach(file IN ITEMS bin/warren share/man/man1/warren.1 share/man/man1/warren-solve.1 share/man/man1/warren-query.1
        share/bash-completion/completions/warren share/zsh/site-functions/_warren share/fish/vendor_completions.d/warren.fish
        share/doc/warren/LICENSE share/doc/warren/README.md share/doc/warren/docs/file_formats.md
        share/doc/warren/examples/worlds/parking.scene)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
# A report of a bug begins with these lines.
execute_process(COMMAND ${prefix}/bin/warren --version OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
foreach(word IN ITEMS "warren [0-9]+[.][0-9]+[.][0-9]+" "commit ([0-9a-f]+|unknown)" "(g[+][+]|clang[+][+]) [0-9]+" "(x86-64|arm64)")
  if(NOT version MATCHES "${word}")
    message(FATAL_ERROR "--version says nothing of ${word}: ${version}")
  endif()
endforeach()
# A page for each verb, as help lists them.
execute_process(COMMAND ${prefix}/bin/warren help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n  [a-z-]+ " verbs "${help}")
list(LENGTH verbs count)
file(GLOB pages ${prefix}/share/man/man1/warren-*.1)
list(LENGTH pages page_count)
math(EXPR count "${count} - 2")  # the two lines of examples
if(NOT count EQUAL page_count OR count LESS 15)
  message(FATAL_ERROR "${count} verbs and ${page_count} manual pages")
endif()

find_program(man man)
if(man)
  foreach(page IN LISTS pages)
    execute_process(COMMAND ${man} --warnings -l ${page} OUTPUT_VARIABLE text ERROR_VARIABLE said RESULT_VARIABLE code)
    if(NOT code EQUAL 0 OR said OR NOT text MATCHES "SYNOPSIS")
      message(FATAL_ERROR "man says of ${page}: ${said}")
    endif()
  endforeach()
endif()
# As bash itself splits the line.
execute_process(COMMAND bash -c "PATH=${prefix}/bin:$PATH; . ${prefix}/share/bash-completion/completions/warren
COMP_WORDS=(warren solve maze : 5x7,algorithm = w) COMP_CWORD=6 COMP_LINE='warren solve maze:5x7,algorithm=w' COMP_POINT=33
_warren; echo \"$COMPREPLY\"" OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(NOT said STREQUAL "wilson\n")
  message(FATAL_ERROR "bash completes algorithm=w by: ${said}")
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -DBUILD=${SCRATCH}/manifests -P ${SOURCE}/cmake/uninstall.cmake
                COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE left ${prefix}/*)
if(left OR EXISTS ${prefix}/share/doc/warren)
  message(FATAL_ERROR "left after uninstall: ${left}")
endif()
file(REMOVE_RECURSE ${SCRATCH})
