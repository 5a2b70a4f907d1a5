# SPDX-License-Identifier: BSD-3-Clause
# warren_library(FOLDER [FOLDER ...]): the sources in the folder's rooms as library warren_FOLDER, linked to the folders that it may
# include. Sources are found by pattern: a file belongs to the library of the folder that it lies in, always.
function(warren_library folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
  if(folder STREQUAL "solve")  # the planners of each world: where all the time of a solve goes, so compiled with all care
    set(planned ${sources})
    list(FILTER planned INCLUDE REGEX "/planned_[a-z0-9_]+_world[.]cpp$")
    list(REMOVE_ITEM sources ${planned})
    add_library(warren_planned OBJECT ${planned})
    set_target_properties(warren_planned PROPERTIES UNITY_BUILD OFF)
    target_link_libraries(warren_planned PRIVATE warren_worlds warren_planners)
    target_compile_features(warren_planned PRIVATE cxx_std_20)
    list(APPEND sources $<TARGET_OBJECTS:warren_planned>)
  endif()
  add_library(warren_${folder} STATIC ${sources})
  add_library(warren::${folder} ALIAS warren_${folder})
  set_target_properties(warren_${folder} PROPERTIES LINKER_LANGUAGE CXX EXPORT_NAME ${folder})
  target_include_directories(warren_${folder} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(warren_${folder} PUBLIC cxx_std_20)
  foreach(below IN LISTS ARGN)
    target_link_libraries(warren_${folder} PUBLIC warren_${below})
  endforeach()
  if(folder STREQUAL "solve")
    warren_unity(warren_${folder} 28)
    warren_cold(warren_${folder} -O2)
  elseif(folder MATCHES "^(pictures|studies)$")
    warren_unity(warren_${folder} 28)
    warren_cold(warren_${folder})
  else()
    warren_unity(warren_${folder})
    warren_headers(warren_${folder} warren_hot_headers)
  endif()
endfunction()

# warren_careful_first(TARGET): where several objects have one inline function, the linker takes the first one's, so those
# that are compiled with all care come first. It is a fiftieth of a search.
function(warren_careful_first target)
  foreach(library IN ITEMS planned planners worlds verify spatial scenes parallel core)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:warren_${library}>)
  endforeach()
endfunction()
