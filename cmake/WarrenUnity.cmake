# SPDX-License-Identifier: BSD-3-Clause
# warren_unity(TARGET): with CMAKE_UNITY_BUILD (all presets), the target's sources are compiled in batches of about ten,
# because most of a file's time goes to the system's headers: half of the time from nothing. A file's batch is drawn by its name alone:
# related files, whose private names tend to be alike, lie apart, and a new file moves no other one (but for a doubling
# of the batches). Two files of a batch can't give one name to two things: the better name for one of them mends it.
function(warren_unity target)
  if(NOT CMAKE_UNITY_BUILD)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(LENGTH sources left)
  set(batches 1)
  while(left GREATER 14)
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
