# Installs the libraries into an empty folder, sees that no header of tests is among them, then builds and runs a foreign
# project against them; it compiles each header alone, so that one which includes a private header fails.
#   cmake -D BUILD=<build folder> -D SOURCE=<root> -D COMPILER=<c++> -P check_install.cmake
set(work ${BUILD}/check_install)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}\n${text}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --component development --prefix ${work}/prefix)
file(GLOB_RECURSE headers RELATIVE ${work}/prefix/include ${work}/prefix/include/*)
list(FILTER headers INCLUDE REGEX "(^|[/_])(tests?|testing|bench)([/_.]|$)")
if(headers)
  message(FATAL_ERROR "headers of tests are installed: ${headers}")
endif()
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/cmake/consumer -B ${work}/build -D CMAKE_PREFIX_PATH=${work}/prefix
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_EXPORT_NO_PACKAGE_REGISTRY=ON)
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer)

# And one whose tests are launch files.
run(${CMAKE_COMMAND} -S ${SOURCE}/examples/launch_tests -B ${work}/launch_tests -D CMAKE_PREFIX_PATH=${work}/prefix
    -D ENSONIFY_PROGRAM=${BUILD}/bin/ensonify -D CMAKE_EXPORT_NO_PACKAGE_REGISTRY=ON)
run(${CMAKE_CTEST_COMMAND} --test-dir ${work}/launch_tests --no-tests=error --output-on-failure)
