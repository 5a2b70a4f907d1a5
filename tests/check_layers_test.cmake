# SPDX-License-Identifier: BSD-3-Clause
# cmake -DSCRIPT=check_layers.cmake -DSCRATCH=DIR -P check_layers_test.cmake: does check_layers.cmake notice? Each case is
# a tree of one file, or of a few; the rule named must be what is complained about, and a tree without fault must pass.
cmake_minimum_required(VERSION 3.25)

# Further files of the tree, and their texts, follow: without semicolons, these are a list.
function(run_check path text result output)
  file(REMOVE_RECURSE ${SCRATCH})
  file(WRITE ${SCRATCH}/${path} "// SPDX-License-Identifier: BSD-3-Clause\n${text}\n")
  set(rest ${ARGN})
  while(rest)
    list(POP_FRONT rest name content)
    file(WRITE ${SCRATCH}/${name} "// SPDX-License-Identifier: BSD-3-Clause\n${content}\n")
  endwhile()
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${SCRATCH} -P ${SCRIPT}
                  RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  set(${result} ${code} PARENT_SCOPE)
  set(${output} "${out}" PARENT_SCOPE)
endfunction()

function(passes path text)
  run_check(${path} "${text}" code out ${ARGN})
  if(NOT code EQUAL 0)
    message(SEND_ERROR "${path} with '${text}' should pass, but:\n${out}")
  endif()
endfunction()

function(complains path text expected)
  run_check(${path} "${text}" code out ${ARGN})
  string(REGEX REPLACE "[ \n]+" " " out "${out}")
  if(code EQUAL 0 OR NOT out MATCHES "${expected}")
    message(SEND_ERROR "${path} with '${text}' should fail with '${expected}', but gave ${code}:\n${out}")
  endif()
endfunction()

passes(worlds/a.hpp "#include \"spatial/points/kd_tree.hpp\"\n#include <vector>")
passes(worlds/walls_io.cpp "#include <fstream>\n#include <fmt/format.h>")
passes(tools/main.cpp "#include \"scenes/scene/scene.hpp\"\n#include <iostream>\nint main() { std::cout << 1; return 0; }")
passes(core/a.cpp "// never std::cout, never exit(1)\nvoid on_exit(); int snprintf(char*);")
passes(spatial/a.cpp "std::unordered_map<int, int> ids;  // lookups only")
complains(worlds/a.hpp "#include \"planners/roadmap/prm.hpp\"" "worlds/ may include")
complains(planners/a.hpp "#include \"worlds/plane/maze_world.hpp\"" "planners/ may include")
complains(core/a.cpp "#include \"parallel/chunks.hpp\"" "core/ may include")
complains(spatial/a.cpp "#include \"tools/progress.hpp\"" "spatial/ may include")
complains(core/a.cpp "#include \"geometry.hpp\"" "core/ may include")
complains(core/a.cpp "#include \"../worlds/scene.hpp\"" "core/ may include")
complains(verify/judges/verify_point.cpp "#include \"spatial/obstacles/wall_index.hpp\"" "reached from verify/judges/verify_point.cpp: a judge shares nothing"
          spatial/obstacles/wall_index.hpp "#pragma once")
passes(verify/judges/verify_point.cpp "#include \"worlds/arcs.hpp\"\n#include \"core/base/types.hpp\"" worlds/arcs.hpp "#pragma once"
       core/base/types.hpp "#pragma once" spatial/points/kd_tree.hpp "#include \"core/base/types.hpp\"")
complains(worlds/verify_a.hpp "#include \"worlds/arcs.hpp\"" "spatial/points/kd_tree.hpp: reached from worlds/lines.cpp"
          worlds/arcs.hpp "#include \"worlds/lines.hpp\"" worlds/lines.hpp "#pragma once"
          worlds/lines.cpp "#include \"spatial/points/kd_tree.hpp\"" spatial/points/kd_tree.hpp "#pragma once")
complains(worlds/verify_a.hpp "#include \"worlds/arcs.hpp\"" "core/plane/geometry.hpp: reached from worlds/arcs.hpp"
          worlds/arcs.hpp "#include \"core/plane/geometry.hpp\"" core/plane/geometry.hpp "#pragma once")
complains(worlds/verify_a.cpp "#include \"worlds/arcs.hpp\"" "worlds/motions.hpp: reached from worlds/arcs.hpp"
          worlds/arcs.hpp "#include \"worlds/motions.hpp\"" worlds/motions.hpp "#pragma once"
          worlds/poses/car_world.cpp "#include \"worlds/motions.hpp\"")
complains(spatial/obstacles/wall_index.cpp "#include <nanoflann.hpp>" "rule 'nanoflann'")
complains(planners/axis/medial_axis.cpp "#include <boost/polygon/voronoi.hpp>" "rule 'boost'")
complains(planners/a.cpp "#include <atomic>" "rule 'threads'")
complains(planners/a.cpp "auto n = std::thread::hardware_concurrency();" "rule 'cores'")
complains(worlds/maze.cpp "#include <sstream>" "rule 'streams'")
complains(core/a.cpp "void f() { std::printf(\"x\"); }" "rule 'printing'")
complains(core/a.cpp "void f() { std::cerr << 1; }" "rule 'printing'")
complains(parallel/a.cpp "auto v = std::getenv(\"X\");" "rule 'environment'")
complains(worlds/a.cpp "void f() { std::exit(1); }" "rule 'exits'")
complains(tests/a_test.cpp "std::random_device d;" "rule 'chance'")
complains(core/a.cpp "std::mt19937_64 engine(1);" "rule 'engines'")
complains(worlds/a.cpp "std::shared_ptr<int> p;" "rule 'shared_ownership'")
complains(planners/a.cpp "#include <nlohmann/json.hpp>" "rule 'json'")
complains(planners/a.cpp "#include <fmt/format.h>" "rule 'texts'")
complains(worlds/a.cpp "#include <png.h>" "rule 'pictures'")
complains(core/a.cpp "#include <gtest/gtest.h>" "rule 'judges'")
complains(tools/a.cpp "#include <benchmark/benchmark.h>" "rule 'stopwatches'")
complains(worlds/a.cpp "std::unordered_map<int, int> ids;" "rule 'unordered")
complains(core/utils.hpp "" "named after its one type")
complains(README.md "" "holds no sources")

file(REMOVE_RECURSE ${SCRATCH})
file(WRITE ${SCRATCH}/core/a.hpp "#pragma once\n")
execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${SCRATCH} -P ${SCRIPT} RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
if(code EQUAL 0)
  message(SEND_ERROR "a file without the SPDX line should fail")
endif()
file(REMOVE_RECURSE ${SCRATCH})
