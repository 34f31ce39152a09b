# Every library that the project takes from the system (Debian 12 package names in `dev`).

include(LibraryDependencies)  # those of the kernels and messages libraries
find_package(yaml-cpp REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(GDAL REQUIRED)
find_package(assimp 5.2 REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(ZMQ REQUIRED IMPORTED_TARGET libzmq)

if(ENSONIFY_TESTS)
  find_package(Catch2 2.13 REQUIRED)
endif()
if(ENSONIFY_BENCH)
  find_package(benchmark REQUIRED)
endif()
