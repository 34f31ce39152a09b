# What the kernels and messages libraries take from the system. Installed with them: ensonifyConfig.cmake reads it too.

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(TBB REQUIRED)
find_package(embree 3 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)

if(NOT TARGET geographiclib)
  find_path(GEOGRAPHICLIB_INCLUDE GeographicLib/TransverseMercatorExact.hpp REQUIRED)
  find_library(GEOGRAPHICLIB_LIBRARY NAMES GeographicLib Geographic REQUIRED)
  add_library(geographiclib INTERFACE IMPORTED)
  target_include_directories(geographiclib SYSTEM INTERFACE ${GEOGRAPHICLIB_INCLUDE})
  target_link_libraries(geographiclib INTERFACE ${GEOGRAPHICLIB_LIBRARY})
endif()

if(NOT TARGET fftwf)  # FFTW in single precision
  find_path(FFTW_INCLUDE fftw3.h REQUIRED)
  find_library(FFTWF_LIBRARY fftw3f REQUIRED)
  add_library(fftwf INTERFACE IMPORTED)
  target_include_directories(fftwf SYSTEM INTERFACE ${FFTW_INCLUDE})
  target_link_libraries(fftwf INTERFACE ${FFTWF_LIBRARY})
endif()

if(NOT TARGET openmesh)
  find_package(OpenMesh REQUIRED)
  add_library(openmesh INTERFACE IMPORTED)
  target_link_libraries(openmesh INTERFACE OpenMeshTools OpenMeshCore)
endif()

if(NOT TARGET msgpack_cxx)  # headers only
  find_path(MSGPACK_INCLUDE msgpack.hpp REQUIRED)
  add_library(msgpack_cxx INTERFACE IMPORTED)
  target_include_directories(msgpack_cxx SYSTEM INTERFACE ${MSGPACK_INCLUDE})
  target_compile_definitions(msgpack_cxx INTERFACE MSGPACK_NO_BOOST MSGPACK_DEFAULT_API_VERSION=3)
endif()
