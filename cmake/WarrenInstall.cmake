# SPDX-License-Identifier: BSD-3-Clause
# What `cmake --install` leaves behind: headers, a library a folder, a package for find_package(warren), a file for
# pkg-config, the licence, the program with its manual pages and completions, documents and examples. Targets:
# warren::core and so on, and warren::warren, which is all of them. Components: "library" is the package without the
# program, "program" and "documents" are the rest.
include(CMakePackageConfigHelpers)

set(warren_libraries core parallel spatial scenes worlds verify planners solve pictures)
set(warren_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/warren)

add_library(warren_all INTERFACE)
add_library(warren::warren ALIAS warren_all)
set_target_properties(warren_all PROPERTIES EXPORT_NAME warren)
foreach(folder IN LISTS warren_libraries)
  target_link_libraries(warren_all INTERFACE warren_${folder})
  install(TARGETS warren_${folder} EXPORT warren ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
endforeach()
install(TARGETS warren_all EXPORT warren COMPONENT library)

# Headers as others include them, <warren/...>: for programs of this build, examples above all, and for the package.
list(JOIN warren_libraries " " warren_folders)
set(warren_headers ${PROJECT_BINARY_DIR}/include)
set(warren_copied ${warren_headers}/warren/warren.hpp)  # what is told is looked at again after it was written
foreach(folder IN LISTS warren_libraries)
  file(GLOB_RECURSE own CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
  list(REMOVE_ITEM own pictures/warren.hpp)
  list(TRANSFORM own PREPEND ${warren_headers}/warren/)
  list(APPEND warren_copied ${own})
endforeach()
add_custom_target(warren_headers BYPRODUCTS ${warren_copied}
  COMMAND ${CMAKE_COMMAND} -DFROM=${PROJECT_SOURCE_DIR} -DTO=${warren_headers} -DFOLDERS=${warren_folders}
          -P ${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake VERBATIM)
add_dependencies(warren_all warren_headers)
target_include_directories(warren_all INTERFACE $<BUILD_INTERFACE:${warren_headers}>)
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} -DFROM=${PROJECT_SOURCE_DIR} -DTO=${warren_headers}
  \"-DFOLDERS=${warren_folders}\" -P ${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake COMMAND_ERROR_IS_FATAL ANY)"
  COMPONENT library)
install(DIRECTORY ${warren_headers}/warren DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)
install(EXPORT warren NAMESPACE warren:: FILE warrenTargets.cmake DESTINATION ${warren_package_dir} COMPONENT library)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/warrenConfig.cmake.in ${PROJECT_BINARY_DIR}/warrenConfig.cmake
                              INSTALL_DESTINATION ${warren_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/warrenConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/warrenConfig.cmake ${PROJECT_BINARY_DIR}/warrenConfigVersion.cmake
        DESTINATION ${warren_package_dir} COMPONENT library)

# The way from the file to the prefix, so that an installation may be moved.
file(RELATIVE_PATH warren_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${CMAKE_CURRENT_LIST_DIR}/warren.pc.in ${PROJECT_BINARY_DIR}/warren.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/warren.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT library)

# What people read, and what their shells ask: manual pages and completions as the program itself prints them, documents,
# examples. `cmake --build DIR --target uninstall` takes back what the last installation has put in place.
set(warren_words ${PROJECT_BINARY_DIR}/words)
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} \"-DPROGRAM=$<TARGET_FILE:warren>\" -DTO=${warren_words}
  -P ${CMAKE_CURRENT_LIST_DIR}/program_words.cmake COMMAND_ERROR_IS_FATAL ANY)" COMPONENT program)
install(DIRECTORY ${warren_words}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(FILES ${warren_words}/warren DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${warren_words}/_warren DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
install(FILES ${warren_words}/warren.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
        COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT documents)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
add_custom_target(uninstall
  COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -P ${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake VERBATIM)
