# `cpack --preset package`: the program with its pages, completions and jobs as a .deb for the distribution it was built
# on, and as a tarball that brings every library but glibc and libstdc++. Headers and the CMake package are in neither.

# what the tarball brings. Not libstdc++: every system has one for its own programs, and Debian's asks for a later glibc
# than the program does
install(CODE "set(torquescope_program \"$<TARGET_FILE:torquescope>\")" COMPONENT libraries EXCLUDE_FROM_ALL)
install(CODE [[
  file(GET_RUNTIME_DEPENDENCIES EXECUTABLES "${torquescope_program}" RESOLVED_DEPENDENCIES_VAR needed
       PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|stdc[+][+]|gcc_s)[.]so")
  file(INSTALL ${needed} DESTINATION "${CMAKE_INSTALL_PREFIX}/lib/torquescope" TYPE SHARED_LIBRARY FOLLOW_SYMLINK_CHAIN)
]] COMPONENT libraries EXCLUDE_FROM_ALL)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/package_contents.cmake)
set(CPACK_PACKAGE_VENDOR "The Torquescope authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_FILE_NAME torquescope-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_NAME torquescope)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME torquescope)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Torquescope authors")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# `torquescope report` and `compare`; everything else does without
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-h5py, python3-numpy, python3-matplotlib, python3-jinja2")
include(CPack)
