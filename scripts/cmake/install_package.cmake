# install + export: an outside project finds torquescope and links torquescope::optim (tests/install)
include(CMakePackageConfigHelpers)
get_property(layers GLOBAL PROPERTY TORQUESCOPE_LAYERS)
list(TRANSFORM layers PREPEND torquescope_ OUTPUT_VARIABLE targets)
install(TARGETS ${targets} EXPORT torquescope_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT torquescope_targets NAMESPACE torquescope:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/torquescope
        COMPONENT development)
install(DIRECTORY engine kernels DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/torquescope COMPONENT development
        FILES_MATCHING PATTERN "*.hpp")
install(FILES ${CMAKE_BINARY_DIR}/generated/engine/base/version.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/torquescope/engine/base COMPONENT development)
# the page builder with its templates, where the installed program looks for it
install(DIRECTORY scripts/report DESTINATION ${CMAKE_INSTALL_DATADIR}/torquescope
        PATTERN "__pycache__" EXCLUDE)
# jobs that need no recording of anybody else
install(FILES jobs/clean_joint.toml jobs/concealed_stribeck.toml jobs/crs_a465_five_joints.toml jobs/crs_a465_joint.toml
        jobs/smoke.toml
        DESTINATION ${CMAKE_INSTALL_DATADIR}/torquescope/jobs)
install(DIRECTORY jobs/robots DESTINATION ${CMAKE_INSTALL_DATADIR}/torquescope/jobs FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY jobs/motions DESTINATION ${CMAKE_INSTALL_DATADIR}/torquescope/jobs FILES_MATCHING PATTERN "*.csv")
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/torquescope-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/torquescope-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/torquescope)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/torquescope-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/torquescope-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/torquescope-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/torquescope COMPONENT development)
