# Two Debian packages, made by `cpack` (`./dev package`): ensonify runs simulations, ensonify-dev is for programs that
# link the kernels and messages. What shared libraries they need dpkg-shlibdeps finds out.
install(FILES LICENSE DESTINATION share/doc/ensonify RENAME copyright)
install(FILES LICENSE DESTINATION share/doc/ensonify-dev RENAME copyright COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Ensonify authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME ensonify)
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "Programs, worlds and launch files: vehicles, instruments and sonar heads
over a seabed of any size, as processes that talk ZeroMQ.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS  # of the tools in Python and the Python client
    "python3, python3-gdal, python3-matplotlib, python3-msgpack, python3-numpy, python3-pil, python3-scipy, python3-zmq")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS graphviz)  # `ensonify graph --svg`

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ensonify-dev)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Libraries and headers for CMake's find_package(ensonify): the kernels
(acoustics, seabed, motion, survey) and the messages.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS  # what LibraryDependencies.cmake finds
    libeigen3-dev libembree-dev libfftw3-dev libgeographiclib-dev libmsgpack-cxx-dev libopenmesh-dev librandom123-dev
    libtbb-dev nlohmann-json3-dev)
list(JOIN CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
include(CPack)
