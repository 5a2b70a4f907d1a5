# SPDX-License-Identifier: BSD-3-Clause
# What tools/packages makes of a build: Debian's packages by CPack, one a component of the installation. The library is
# there twice: static, for what is linked to stay fast and alone, and shared, of the same objects.
set(warren_soversion 0)  # of the shared library's interface: one more where a program would have to be built anew

add_library(warren_shared SHARED)
foreach(folder IN LISTS warren_libraries)
  target_sources(warren_shared PRIVATE $<TARGET_OBJECTS:warren_${folder}>)
endforeach()
target_sources(warren_shared PRIVATE $<TARGET_OBJECTS:warren_planned>)  # which warren_solve only takes in
target_include_directories(warren_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(warren_shared INTERFACE cxx_std_20)
target_link_libraries(warren_shared PUBLIC Eigen3::Eigen Threads::Threads PRIVATE fmt::fmt PNG::PNG TBB::tbb yaml-cpp pugixml::pugixml Qhull::qhull_r ZLIB::ZLIB)
if(HPDF_LIBRARY)
  target_link_libraries(warren_shared PRIVATE hpdf)
endif()
set_target_properties(warren_shared PROPERTIES OUTPUT_NAME warren EXPORT_NAME shared LINKER_LANGUAGE CXX
                      VERSION ${PROJECT_VERSION} SOVERSION ${warren_soversion})
install(TARGETS warren_shared EXPORT warren LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
        NAMELINK_COMPONENT library)

set(Python3_EXECUTABLE ${WARREN_SYSTEM_PYTHON})
if(WARREN_PYTHON)
  set(packages_of_python lib/python3/dist-packages/warren)
  install(TARGETS warren_python LIBRARY DESTINATION ${packages_of_python} COMPONENT python)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/apps/python/warren/ DESTINATION ${packages_of_python} COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
endif()

# The site, which tools/packages makes before.
install(DIRECTORY ${PROJECT_BINARY_DIR}/docs/html DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/warren-doc COMPONENT documents
        OPTIONAL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME warren)
# Who packs them is who maintains them: DEBFULLNAME and DEBEMAIL say it, as to Debian's own tools. Else an address of a
# domain that is reserved for examples, which reaches nobody by mistake.
set(warren_maintainer "The warren authors")
if(DEFINED ENV{DEBFULLNAME})
  set(warren_maintainer "$ENV{DEBFULLNAME}")
endif()
set(warren_address "warren@example.org")
if(DEFINED ENV{DEBEMAIL})
  set(warren_address "$ENV{DEBEMAIL}")
endif()
set(CPACK_PACKAGE_CONTACT "${warren_maintainer} <${warren_address}>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_NAME} built using CMake")  # CPack's own words: it puts others before the synopsis
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/debs)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program runtime library documents)
if(WARREN_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian/finish_packages.cmake)
set(CPACK_POST_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian/without_ldconfig.cmake)

set(extended "warren plans the motions of points, discs, rigid bodies, cars and arms by
roadmaps, among walls, polygons, maps of cells and solids, and through mazes
of hundreds of millions of cells. Every path is verified by code that shares
nothing with the planners.")
# warren_package(COMPONENT NAME SECTION SYNOPSIS WHAT_IT_HAS): a component as a package.
function(warren_package component name section synopsis has)
  string(TOUPPER ${component} c)
  foreach(pair IN ITEMS PACKAGE_NAME:${name} PACKAGE_SECTION:${section} PACKAGE_SHLIBDEPS:ON)
    string(REPLACE ":" ";" pair ${pair})
    list(GET pair 0 key)
    list(GET pair 1 value)
    set(CPACK_DEBIAN_${c}_${key} ${value} PARENT_SCOPE)
  endforeach()
  set(CPACK_DEBIAN_${c}_DESCRIPTION "${synopsis}\n${extended}\n\n${has}" PARENT_SCOPE)
endfunction()
warren_package(program warren science "motion planning by roadmaps: verified shortest paths" "This package has the program.")
warren_package(runtime libwarren${warren_soversion} libs "motion planning by roadmaps: shared library"
               "This package has the shared library.")
warren_package(library libwarren-dev libdevel "motion planning by roadmaps: headers and libraries"
               "This package has headers, static libraries and files for CMake and pkg-config.")
warren_package(documents warren-doc doc "motion planning by roadmaps: documents and examples"
               "This package has the reference as a site, documents, programs and worlds.")
warren_package(python python3-warren python "motion planning by roadmaps: module for Python"
               "This package has the module warren for Python, with its types.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libwarren${warren_soversion} (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.4), libfmt-dev, libhpdf-dev, libpng-dev, libpugixml-dev, libqhull-dev, libtbb-dev, libyaml-cpp-dev, zlib1g-dev")
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "warren-doc")
find_package(Python3 COMPONENTS Interpreter)
math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-scipy")

# What dpkg runs and reads beside the files.
set(control ${PROJECT_BINARY_DIR}/control)
file(WRITE ${control}/runtime/shlibs
     "libwarren ${warren_soversion} libwarren${warren_soversion} (>= ${PROJECT_VERSION})\n")
file(WRITE ${control}/runtime/triggers "activate-noawait ldconfig\n")
file(WRITE ${control}/python/postinst "#!/bin/sh\nset -e\nif [ \"$1\" = configure ] && command -v py3compile >/dev/null; then\n  py3compile -p python3-warren\nfi\n")
file(WRITE ${control}/python/prerm "#!/bin/sh\nset -e\nif command -v py3clean >/dev/null; then\n  py3clean -p python3-warren\nfi\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${control}/runtime/shlibs ${control}/runtime/triggers)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${control}/python/postinst ${control}/python/prerm)
include(CPack)
