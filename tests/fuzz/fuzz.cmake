# SPDX-License-Identifier: BSD-3-Clause
# The readers under fire: libFuzzer comes with clang++ and wants the sanitizers. In the tests each reader takes its seeds
# and mutations of them, blindly but for what the program's own files tell; tools/fuzz builds all with coverage and goes on.
if(WARREN_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  file(GLOB fuzz_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp ${CMAKE_CURRENT_LIST_DIR}/*.hpp)
  add_executable(fuzz_readers ${fuzz_sources})
  target_link_libraries(fuzz_readers PRIVATE warren_tools)
  target_compile_options(fuzz_readers PRIVATE -fsanitize=fuzzer-no-link)
  target_link_options(fuzz_readers PRIVATE -fsanitize=fuzzer)
  warren_unity(fuzz_readers)
  file(GLOB fuzz_seeds CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_LIST_DIR}/seeds ${CMAKE_CURRENT_LIST_DIR}/seeds/*)
  foreach(reader IN LISTS fuzz_seeds)
    file(GLOB seeds CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/seeds/${reader}/*)
    list(JOIN seeds "," seeds)
    add_test(NAME fuzz.${reader}
      COMMAND fuzz_readers -seed_inputs=${seeds} -seed=1 -runs=3000 -max_total_time=2 -timeout=60 -rss_limit_mb=2560
              -malloc_limit_mb=1100 -artifact_prefix=${CMAKE_CURRENT_BINARY_DIR}/fuzz.${reader}.)
    set_tests_properties(fuzz.${reader} PROPERTIES LABELS fuzz TIMEOUT 300 ENVIRONMENT WARREN_FUZZ_READER=${reader})
  endforeach()
endif()
