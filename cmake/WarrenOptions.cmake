# SPDX-License-Identifier: BSD-3-Clause
# Options of the build and the flags that every target shares.

option(WARREN_TESTS "build the tests" ON)
set(WARREN_TESTS_OF all CACHE STRING "which tests: units (compiled with the code), program (they ask it from outside), all")
option(WARREN_BENCH "build the microbenchmarks" OFF)
option(WARREN_PYTHON "build the Python package" OFF)
option(WARREN_MPI "build warren-mpi, which needs MPI" OFF)
option(WARREN_PACKAGES "build what Debian's packages are made of: tools/packages" OFF)
option(WARREN_WERROR "warnings are errors" OFF)
option(WARREN_NATIVE "tune for this machine (the default build runs on any x86-64, or on any arm64)" OFF)
option(WARREN_PLAIN "only the code that other processors than x86-64 run, on x86-64 too" OFF)
set(WARREN_COMMIT "" CACHE STRING "the commit that --version names, for sources without git (default: what git says)")
set(WARREN_SANITIZE "" CACHE STRING "sanitizers, as -fsanitize= takes them")
# Debian's oneTBB gives the thread sanitizer false reports.
string(FIND "${WARREN_SANITIZE}" thread warren_plain_chunks)
if(warren_plain_chunks GREATER_EQUAL 0)
  set(warren_plain_chunks ON)
else()
  set(warren_plain_chunks OFF)
endif()
option(WARREN_PLAIN_CHUNKS "loops on std::jthread instead of oneTBB" ${warren_plain_chunks})

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_OPTIMIZE_DEPENDENCIES ON)  # a library's sources are compiled before the libraries below it are linked

# Every machine computes the same bits: no contraction into fused operations, no fast-math.
add_compile_options(-ffp-contract=off -fno-fast-math)
if(WARREN_PYTHON)  # what the module calls nothing of is left out of it, by the function
  add_compile_options($<$<CONFIG:Release>:-ffunction-sections> $<$<CONFIG:Release>:-fdata-sections>)
endif()
# Warnings are the developers' business. At -O3 g++ also warns of paths through the libraries' headers that don't exist:
# what it sees by following them is asked of preset dev, which has asserts.
if(WARREN_WERROR)
  add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wnull-dereference -Werror)
  # Between the files of a batch, names may shadow each other; `tools/check alone` looks at each file by itself.
  if(CMAKE_UNITY_BUILD)
    add_compile_options(-Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  add_compile_options("$<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-null-dereference;-Wno-restrict;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-maybe-uninitialized;-Wno-free-nonheap-object;-Wno-dangling-pointer>")
  # g++ says it only when asked; clang++ says it, but not of files in batches.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wunused-const-variable=1>)
endif()
if(WARREN_NATIVE)
  add_compile_options(-march=native)
endif()
if(WARREN_SANITIZE)
  add_compile_options(-fsanitize=${WARREN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${WARREN_SANITIZE})
  # Each inlined copy is checked anew: with less inlining a fifth of the compilation goes and no test is slower.
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    add_compile_options("SHELL:-mllvm -inline-threshold=25")
  endif()
  # At a fixed address: the tests start the program thousands of times, and a quarter of such a start was relocation, of
  # a million pointers that the sanitizer describes the globals with.
  if(WARREN_SANITIZE MATCHES address)
    set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
    add_compile_options(-fno-pie)
    add_link_options($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-no-pie>)
  endif()
  find_program(WARREN_MOLD mold)
  if(WARREN_MOLD)
    add_link_options(-fuse-ld=mold)
  endif()
  # What the address sanitizer sees as well, and no build needs; by day also what few mistakes are and a fifth of the
  # compilation: `tools/check all` and preset fuzz say alignment, and have those too.
  if(WARREN_SANITIZE MATCHES alignment)
    add_compile_options(-fno-sanitize=null,vptr,object-size)
  elseif(WARREN_SANITIZE MATCHES undefined)
    add_compile_options(-fno-sanitize=null,vptr,object-size,pointer-overflow,function -fno-sanitize=alignment)
  endif()
endif()

# Folders where no time goes at run time are compiled with less care: tests' own code and what surrounds planning. What users
# run of them is as fast. Small functions are inlined all the same: less is left to compile then, and the compiler takes a
# quarter less time.
set(warren_cold_flags)
if(WARREN_SANITIZE)
  set(warren_cold_flags -O0)
elseif(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_CXX_COMPILER_ID MATCHES Clang)
  set(warren_cold_flags -O1 -finline-functions "SHELL:-mllvm -inline-threshold=25")
elseif(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(warren_cold_flags -O1 -finline-small-functions)
endif()
