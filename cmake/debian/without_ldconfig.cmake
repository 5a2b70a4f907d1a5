# SPDX-License-Identifier: BSD-3-Clause
# Run by CPack when the packages are made: takes out of the shared library's the scripts that call ldconfig, which CPack adds
# and Debian's policy has replaced by a trigger.
cmake_minimum_required(VERSION 3.25)
foreach(deb IN LISTS CPACK_PACKAGE_FILES)
  if(deb MATCHES "/libwarren[0-9]+_")
    set(unpacked ${deb}.unpacked)
    execute_process(COMMAND dpkg-deb --raw-extract ${deb} ${unpacked} COMMAND_ERROR_IS_FATAL ANY)
    file(REMOVE ${unpacked}/DEBIAN/postinst ${unpacked}/DEBIAN/postrm)
    execute_process(COMMAND dpkg-deb --root-owner-group --build ${unpacked} ${deb} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
    file(REMOVE_RECURSE ${unpacked})
  endif()
endforeach()
