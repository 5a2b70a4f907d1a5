# SPDX-License-Identifier: BSD-3-Clause
# warren_library(FOLDER [FOLDER ...]): the sources in the folder's rooms as library warren_FOLDER, linked to the folders that it may
# include. Sources are found by pattern: a file belongs to the library of the folder that it lies in, always.
function(warren_library folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
  add_library(warren_${folder} STATIC ${sources})
  add_library(warren::${folder} ALIAS warren_${folder})
  set_target_properties(warren_${folder} PROPERTIES LINKER_LANGUAGE CXX EXPORT_NAME ${folder})
  target_include_directories(warren_${folder} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(warren_${folder} PUBLIC cxx_std_20)
  foreach(below IN LISTS ARGN)
    target_link_libraries(warren_${folder} PUBLIC warren_${below})
  endforeach()
  if(folder MATCHES "^(solve|pictures|studies)$")
    warren_unity(warren_${folder} 28)
    warren_cold(warren_${folder})
  else()
    warren_unity(warren_${folder})
    warren_headers(warren_${folder} warren_hot_headers)
  endif()
endfunction()
