# What lands under <prefix>: programs in bin (Targets.cmake), worlds and launch files in share/ensonify, and the kernels
# and messages libraries with their headers, for `find_package(ensonify)`: targets ensonify::messages, ensonify::kernels.
include(CMakePackageConfigHelpers)

install(DIRECTORY scenarios launch DESTINATION share/ensonify
        FILES_MATCHING PATTERN "*.yaml" PATTERN "*.csv" PATTERN "README.md")

set(package lib/cmake/ensonify)
install(EXPORT ensonifyTargets NAMESPACE ensonify:: DESTINATION ${package} COMPONENT development)
configure_package_config_file(cmake/ensonifyConfig.cmake.in ${CMAKE_BINARY_DIR}/ensonifyConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/ensonifyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/ensonifyConfig.cmake ${CMAKE_BINARY_DIR}/ensonifyConfigVersion.cmake
              cmake/LibraryDependencies.cmake
        DESTINATION ${package} COMPONENT development)
