# SPDX-License-Identifier: BSD-3-Clause
# Run by CPack between the installation of all components below CPACK_TEMPORARY_DIRECTORY and their packing: what Debian's
# policy wants beyond `cmake --install`: licence and changes where it looks for them, manual pages compressed.
cmake_minimum_required(VERSION 3.25)
find_program(GZIP gzip REQUIRED)
find_program(STRIP strip REQUIRED)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} c)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  set(doc ${root}/share/doc/${CPACK_DEBIAN_${c}_PACKAGE_NAME})
  file(REMOVE ${root}/share/doc/warren/LICENSE)
  file(MAKE_DIRECTORY ${doc})
  file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/copyright ${doc}/copyright)
  file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/changelog ${doc}/changelog)
  file(CHMOD ${doc}/copyright ${doc}/changelog PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(GLOB packed ${doc}/changelog ${doc}/CHANGELOG.md ${root}/share/man/man1/*.1)
  execute_process(COMMAND ${GZIP} -9nf ${packed} COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB archives ${root}/lib/*/*.a)
  if(archives)
    execute_process(COMMAND ${STRIP} --strip-debug --remove-section=.comment --remove-section=.note
                            --enable-deterministic-archives ${archives} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
