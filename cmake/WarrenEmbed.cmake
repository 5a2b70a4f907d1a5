# SPDX-License-Identifier: BSD-3-Clause
# warren_embed(TARGET FOLDER HEADER FUNCTION): the bytes of the folder's files in the target, as HEADER declares FUNCTION,
# a name as seen from namespace warren (embed_files.cmake).
function(warren_embed target folder header function)
  set(embed ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake)
  cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
  string(REGEX REPLACE ".*::" "" name ${function})
  set(made ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*)
  add_custom_command(OUTPUT ${made}
    COMMAND ${CMAKE_COMMAND} -DFROM=${folder} -DTO=${made} -DHEADER=${header} -DFUNCTION=${function} -P ${embed}
    DEPENDS ${files} ${embed} VERBATIM)
  target_sources(${target} PRIVATE ${made})
  set_source_files_properties(${made} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
