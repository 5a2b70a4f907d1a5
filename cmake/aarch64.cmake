# SPDX-License-Identifier: BSD-3-Clause
# Debian's cross compiler for arm64, and its emulator to run what it makes. The libraries for arm64 lie below
# WARREN_CROSS_ROOT, where tools/cross unpacks them: the machine's own packages stay as they are.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)

set(WARREN_CROSS_ROOT ${CMAKE_CURRENT_LIST_DIR}/../build/cross/root CACHE PATH "where the libraries for arm64 lie")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES WARREN_CROSS_ROOT)
get_filename_component(root ${WARREN_CROSS_ROOT} ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH ${root} /usr/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(libraries ${root}/usr/lib/aarch64-linux-gnu:${root}/lib/aarch64-linux-gnu)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-rpath-link=${libraries}")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH=${libraries})
