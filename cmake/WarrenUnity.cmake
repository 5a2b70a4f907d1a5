# SPDX-License-Identifier: BSD-3-Clause
set(warren_cold_batch 28)
if(WARREN_SANITIZE)  # where reading headers takes more than what follows
  set(warren_cold_batch 44)
endif()

# warren_unity(TARGET [MOST]): with CMAKE_UNITY_BUILD (all presets), the target's sources are compiled in batches of about
# ten, or of MOST at the most (warren_cold_batch where little is optimised), because most of a file's time goes to the
# system's headers: half of the time from nothing. A file's batch is drawn by its name alone: related files, whose private
# names tend to be alike, lie apart, and a new file moves no other one (but for a doubling of the batches). Two files of a
# batch can't give one name to two things: the better name for one of them mends it.
function(warren_unity target)
  if(NOT CMAKE_UNITY_BUILD)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(LENGTH sources left)
  set(batches 1)
  set(most 14)
  if(ARGC GREATER 1)
    set(most ${ARGV1})
  endif()
  while(left GREATER most)
    math(EXPR left "${left} / 2")
    math(EXPR batches "${batches} * 2")
  endwhile()
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    string(MD5 hash ${name})
    string(SUBSTRING ${hash} 0 4 hash)
    math(EXPR batch "0x${hash} % ${batches}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP batch_${batch})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# warren_cold(TARGET): its sources with less optimisation (WarrenOptions.cmake).
function(warren_cold target)
  target_compile_options(${target} PRIVATE ${warren_cold_flags})
  if(target STREQUAL "warren_readers")
    warren_headers(${target} warren_cold_reader_headers)
  else()
    warren_headers(${target} warren_cold_headers)
  endif()
endfunction()

# warren_headers(TARGET HEADERS): with clang++ the headers of the system that most files read are read once for all
# targets of one optimisation: a sixth of the time. g++ gains nothing by that.
function(warren_headers target headers)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND NOT WARREN_SANITIZE MATCHES "thread" AND NOT CMAKE_CXX_CLANG_TIDY)
    if(NOT TARGET ${headers})
      # And those of the project that nearly all of them read. What g++ compiles includes each header by itself.
      set(own <core/base/bitmap.hpp> <core/base/solution.hpp> <core/plane/wall_set.hpp> <core/run/execution.hpp> <scenes/scene/scene.hpp>)
      if(headers MATCHES "cold" AND NOT headers MATCHES "reader")
        list(APPEND own <nlohmann/json.hpp> <solve/answer/answer.hpp> <solve/kept/roadmap.hpp> <solve/kinds/kind_of_problem.hpp> <solve/solve.hpp>)
      endif()
      file(WRITE ${PROJECT_BINARY_DIR}/${headers}.cpp "")
      add_library(${headers} STATIC ${PROJECT_BINARY_DIR}/${headers}.cpp)
      target_precompile_headers(${headers} PRIVATE <Eigen/Geometry> <fmt/format.h> <algorithm> <array> <chrono> <cmath> <filesystem>
        <fstream> <functional> <map> <memory> <numeric> <optional> <ranges> <set> <span> <sstream> <string> <thread> <variant> <vector> ${ARGN}
        ${own})
      target_include_directories(${headers} PRIVATE ${PROJECT_SOURCE_DIR})
      target_compile_options(${headers} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")  # for a compiler's cache
      target_link_libraries(${headers} PRIVATE Eigen3::Eigen fmt::fmt)
      if(headers MATCHES "test")
        target_link_libraries(${headers} PRIVATE GTest::gtest)
      endif()
      if(headers MATCHES "cold")
        target_compile_options(${headers} PRIVATE ${warren_cold_flags})
      endif()
    endif()
    target_precompile_headers(${target} REUSE_FROM ${headers})
  endif()
endfunction()
