# What lands under <prefix>, in two components.
#   programs      programs in bin (Targets.cmake), worlds and launch files in share/ensonify, pages in share/doc/ensonify,
#                 manual pages, completions
#   development   the kernels and messages libraries with their public headers, for `find_package(ensonify)`: targets
#                 ensonify::messages, ensonify::kernels
include(CMakePackageConfigHelpers)

file(GLOB_RECURSE data RELATIVE ${CMAKE_SOURCE_DIR}
     scenarios/*.yaml scenarios/*.csv scenarios/*.obj scenarios/README.md launch/*.yaml launch/README.md)
foreach(file IN LISTS data)
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${file} DESTINATION share/ensonify/${folder})
endforeach()

# The pages as they lie here, so that their links hold and the `docs/...` that programs name is found.
file(GLOB_RECURSE pages RELATIVE ${CMAKE_SOURCE_DIR} docs/*.md docs/*.png docs/*.svg docs/*.bib scenarios/*.md
     clients/README.md components/README.md examples/README.md kernels/README.md launch/README.md tools/README.md)
foreach(file IN LISTS pages ITEMS README.md)
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${file} DESTINATION share/doc/ensonify/${folder})
endforeach()

# Written from what the installed programs say for --help.
set(help ${CMAKE_BINARY_DIR}/help)
install(CODE "
  file(REMOVE_RECURSE ${help})
  execute_process(COMMAND ${ENSONIFY_PYTHON} ${CMAKE_SOURCE_DIR}/cmake/package/write_help.py
                          \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin\" ${PROJECT_VERSION} ${help} COMMAND_ERROR_IS_FATAL ANY)")
install(DIRECTORY ${help}/ DESTINATION share)

set(package lib/cmake/ensonify)
install(EXPORT ensonifyTargets NAMESPACE ensonify:: DESTINATION ${package} COMPONENT development)
configure_package_config_file(cmake/ensonifyConfig.cmake.in ${CMAKE_BINARY_DIR}/ensonifyConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/ensonifyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/ensonifyConfig.cmake ${CMAKE_BINARY_DIR}/ensonifyConfigVersion.cmake
              cmake/LaunchTests.cmake cmake/LibraryDependencies.cmake
        DESTINATION ${package} COMPONENT development)
