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

complains(distributed/leader.cpp "#include <mpi.h>" "rule .mpi.")
passes(distributed/mpi_transport.cpp "#include <mpi.h>\n#include \"tools/words/help.hpp\"")
passes(worlds/plane/a.hpp "#include \"spatial/points/kd_tree.hpp\"\n#include <vector>")
passes(scenes/formats/walls_io.cpp "#include <fstream>\n#include <fmt/format.h>")
passes(tools/main.cpp "#include \"scenes/scene/scene.hpp\"\n#include <iostream>\nint main() { std::cout << 1; return 0; }")
passes(tests/planners/roadmap/a_test.cpp "#include \"tools/words/help.hpp\"\n#include \"tests/paths.hpp\"")
passes(core/base/a.cpp "// never std::cout, never exit(1)\nvoid on_exit(); int snprintf(char*);")
passes(spatial/maps/a.cpp "std::unordered_map<int, int> ids;  // lookups only")
complains(worlds/plane/a.hpp "#include \"planners/roadmap/prm.hpp\"" "worlds/plane/ may include")
complains(worlds/plane/a.hpp "#include \"worlds/poses/car_world.hpp\"" "worlds/plane/ may include")
complains(planners/grid/a.hpp "#include \"worlds/plane/maze_world.hpp\"" "planners/grid/ may include")
complains(planners/grid/a.hpp "#include \"planners/trees/rrt.hpp\"" "planners/grid/ may include")
complains(core/plane/a.cpp "#include \"core/search/graph.hpp\"" "core/plane/ may include")
complains(core/base/a.cpp "#include \"parallel/chunks.hpp\"" "core/base/ may include")
complains(spatial/maps/a.cpp "#include \"tools/screen/progress.hpp\"" "spatial/maps/ may include")
complains(core/base/a.cpp "#include \"geometry.hpp\"" "core/base/ may include")
complains(core/base/a.cpp "#include \"../worlds/scene.hpp\"" "core/base/ may include")
complains(verify/judges/a.cpp "#include \"scenes/formats/scene_io.hpp\"" "verify/judges/ may include")
complains(core/a.cpp "" "core/ is no room")
complains(worlds/attic/a.cpp "" "worlds/attic/ is no room")
complains(verify/judges/verify_point.cpp "#include \"spatial/obstacles/wall_index.hpp\"" "reached from verify/judges/verify_point.cpp: a judge shares nothing"
          spatial/obstacles/wall_index.hpp "#pragma once")
passes(verify/judges/verify_point.cpp "#include \"verify/near/arcs.hpp\"\n#include \"core/base/types.hpp\"" verify/near/arcs.hpp "#pragma once"
       core/base/types.hpp "#pragma once" spatial/points/kd_tree.hpp "#include \"core/base/types.hpp\"")
complains(verify/judges/verify_a.hpp "#include \"verify/near/arcs.hpp\"" "core/plane/geometry.hpp: reached from scenes/scene/lines.cpp"
          verify/near/arcs.hpp "#include \"scenes/scene/lines.hpp\"" scenes/scene/lines.hpp "#pragma once"
          scenes/scene/lines.cpp "#include \"core/plane/geometry.hpp\"" core/plane/geometry.hpp "#pragma once")
complains(verify/judges/verify_a.hpp "#include \"verify/near/arcs.hpp\"" "core/plane/geometry.hpp: reached from verify/near/arcs.hpp"
          verify/near/arcs.hpp "#include \"core/plane/geometry.hpp\"" core/plane/geometry.hpp "#pragma once")
complains(verify/judges/verify_a.cpp "#include \"verify/near/arcs.hpp\"" "scenes/scene/motions.hpp: reached from verify/near/arcs.hpp"
          verify/near/arcs.hpp "#include \"scenes/scene/motions.hpp\"" scenes/scene/motions.hpp "#pragma once"
          worlds/poses/car_world.cpp "#include \"scenes/scene/motions.hpp\"")
complains(spatial/obstacles/wall_index.cpp "#include <nanoflann.hpp>" "rule 'nanoflann'")
complains(roadmaps/file/roadmap_file.cpp "#include <xxhash.h>" "rule 'xxhash'")
complains(planners/axis/medial_axis.cpp "#include <boost/polygon/voronoi.hpp>" "rule 'boost'")
complains(planners/grid/a.cpp "#include <atomic>" "rule 'threads'")
complains(planners/grid/a.cpp "auto n = std::thread::hardware_concurrency();" "rule 'cores'")
complains(scenes/mazes/maze.cpp "#include <sstream>" "rule 'streams'")
complains(core/base/a.cpp "void f() { std::printf(\"x\"); }" "rule 'printing'")
complains(core/base/a.cpp "void f() { std::cerr << 1; }" "rule 'printing'")
complains(parallel/a.cpp "auto v = std::getenv(\"X\");" "rule 'environment'")
complains(worlds/plane/a.cpp "void f() { std::exit(1); }" "rule 'exits'")
complains(tests/a_test.cpp "std::random_device d;" "rule 'chance'")
complains(core/base/a.cpp "std::mt19937_64 engine(1);" "rule 'engines'")
complains(worlds/plane/a.cpp "std::shared_ptr<int> p;" "rule 'shared_ownership'")
complains(planners/grid/a.cpp "#include <nlohmann/json.hpp>" "rule 'json'")
complains(planners/grid/a.cpp "#include <fmt/format.h>" "rule 'texts'")
complains(worlds/plane/a.cpp "#include <png.h>" "rule 'pictures'")
complains(core/base/a.cpp "#include <gtest/gtest.h>" "rule 'judges'")
complains(tools/screen/a.cpp "#include <benchmark/benchmark.h>" "rule 'stopwatches'")
complains(worlds/plane/a.cpp "std::unordered_map<int, int> ids;" "rule 'unordered")
complains(worlds/poses/a.cpp "double f(double x) { return std::sin(x); }" "rule 'trigonometry'")
complains(planners/trees/a.hpp "inline double f(double x) { return 2.0*pow (x, x) + pow(x, 2.0); }" "rule 'trigonometry'")
complains(verify/near/a.cpp "double f(double x) { return ::atan2(x, 1.0); }" "rule 'trigonometry'")
complains(core/plane/a.cpp "double f(double x) { return (hypot(x, x)); }" "rule 'trigonometry'")
complains(core/base/a.cpp "double f(std::complex<double> z) { return std::arg(z); }" "rule 'trigonometry'")
passes(worlds/poses/a.cpp "double f(double x) { return portable::sin(x) + std::sqrt(x) + table.log(x) + my_exp(x); }")
passes(core/base/trigonometry.cpp "double f(double x) { return sin(x); }")
complains(worlds/arms/a.cpp "Eigen::AngleAxisd turn(0.1, axis);" "rule 'eigen_angles'")
complains(solve/steps/a.hpp "#include \"solve/roadmaps/roadmap.hpp\"" "solve/steps/ may include")
complains(solve/roadmaps/a.cpp "#include \"solve/solve.hpp\"" "solve/roadmaps/ may include")
passes(solve/solve.cpp "#include \"solve/kinds/plane_steps.hpp\"")
# One name, one type.
set(comparison "namespace warren {\nstruct Comparison {\n}\n}  // namespace warren\n")
complains(verify/judges/a.hpp "${comparison}" "warren::Comparison is defined in verify/judges/a.hpp too" studies/compare/b.hpp "${comparison}")
complains(core/base/a.hpp "${comparison}" "warren::Comparison is defined in core/base/a.hpp too"
          tools/words/b.cpp "namespace warren {\nclass Comparison final\n    : public Other {\n}\n}  // namespace warren")
complains(core/base/a.hpp "namespace warren {\nusing Comparison = int\n}  // namespace warren" "warren::Comparison is defined in"
          core/plane/b.hpp "namespace warren {\nnamespace detail {\nclass A {\n}\n}  // namespace detail\nenum class Comparison : int {}\n}  // namespace warren")
passes(core/base/a.hpp "${comparison}namespace warren::b {\nclass Comparison {\n}\n}  // namespace warren::b"
       core/base/b.hpp "namespace warren {\nstruct Comparison\nnamespace detail {\nunion Comparison {\n}\n}  // namespace detail\n}  // namespace warren"
       core/base/c.cpp "namespace warren {\nnamespace {\nclass Comparison {\n}\n}  // namespace\n}  // namespace warren"
       tests/core/base/a_test.cpp "${comparison}")
# Comments name what is there.
complains(core/base/a.hpp "// As in gone.hpp, only faster." "core/base/a.hpp: a comment names gone.hpp")
complains(core/base/a.hpp "int a = 1  // (worlds/gone)" "a comment names worlds/gone,")
complains(core/base/a.hpp "// plane/b.hpp and base/b.hpp\n" "a comment names base/b.hpp," core/plane/b.hpp "#pragma once")
passes(core/base/a.hpp "// core/plane/b, plane/b.hpp; b.hpp. Of a kind NAME solve_NAME.cpp, see https://x.org/gone.py\n" core/plane/b.hpp "#pragma once")
complains(core/base/utils.hpp "" "named after its one type")
complains(README.md "" "holds no sources")

file(REMOVE_RECURSE ${SCRATCH})
file(WRITE ${SCRATCH}/core/a.hpp "#pragma once\n")
execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${SCRATCH} -P ${SCRIPT} RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
if(code EQUAL 0)
  message(SEND_ERROR "a file without the SPDX line should fail")
endif()
file(REMOVE_RECURSE ${SCRATCH})
