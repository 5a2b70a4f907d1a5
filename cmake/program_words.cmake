# SPDX-License-Identifier: BSD-3-Clause
# cmake -DPROGRAM=warren -DTO=FOLDER -P program_words.cmake: manual pages (man1/) and completions as the program prints
# them, under the names that shells look for.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${TO})
file(MAKE_DIRECTORY ${TO}/man1)
execute_process(COMMAND ${PROGRAM} man --folder ${TO}/man1 COMMAND_ERROR_IS_FATAL ANY)
foreach(pair IN ITEMS bash:warren zsh:_warren fish:warren.fish)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 shell)
  list(GET pair 1 name)
  execute_process(COMMAND ${PROGRAM} completion ${shell} OUTPUT_FILE ${TO}/${name} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
