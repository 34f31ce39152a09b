# The kinds of target. A folder's CMakeLists.txt is a handful of calls to these.

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME programs)  # what does not say COMPONENT development

# The standard headers and Eigen are compiled once, for all units: half of what a unit would cost (docs/decisions).
# Precompiling changes no result; every file still includes what it uses.
file(WRITE ${CMAKE_BINARY_DIR}/generated/pch.cpp "")
add_library(ensonify_pch STATIC ${CMAKE_BINARY_DIR}/generated/pch.cpp)
target_link_libraries(ensonify_pch PUBLIC ensonify_settings PRIVATE Eigen3::Eigen)
set(precompiled <algorithm> <array> <chrono> <cmath> <cstdint> <deque> <filesystem> <functional> <map> <memory> <numbers>
                <optional> <set> <span> <string> <string_view> <variant> <vector> <Eigen/Geometry>)
target_precompile_headers(ensonify_pch PRIVATE ${precompiled})

# ensonify_library(NAME SOURCES a.cpp b.cpp DEPS other_library ... HEADERS a.h ...): of kernels and messages the headers
# that other projects get, too. install_check compiles each alone: what they include must be one of them.
function(ensonify_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;PRIVATE_DEPS;HEADERS" ${ARGN})
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_precompile_headers(${name} REUSE_FROM ensonify_pch)
    target_link_libraries(${name} PUBLIC ensonify_settings ${ARG_DEPS} PRIVATE ${ARG_PRIVATE_DEPS})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ensonify_settings ${ARG_DEPS})
  endif()
  ensonify_find_threads(${name} ${ARG_SOURCES} ${ARG_DEPS} ${ARG_PRIVATE_DEPS})
  if(ARG_HEADERS)
    target_sources(${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR} FILES ${ARG_HEADERS})
  endif()
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(folder MATCHES "^(kernels|messages)")
    ensonify_export(${name})
    if(folder MATCHES "^kernels")
      target_link_libraries(ensonify_kernels INTERFACE ${name})
    endif()
  endif()
endfunction()

# ensonify_find_threads(NAME SOURCES... LIBRARIES...): notes of a target (ENSONIFY_THREADS) whether one of its units, or the
# header beside it, starts threads by itself, TBB or ZeroMQ, or a library of ours that it links. One that is defined later
# counts as if it did: too many tests are watched rather than too few.
function(ensonify_find_threads name)
  set(starts OFF)
  foreach(one ${ARGN})
    set(found "")
    if(TARGET ${one})
      get_property(found TARGET ${one} PROPERTY ENSONIFY_THREADS)
    elseif(one MATCHES "^(ensonify|kernels|testing)_")
      set(found ON)
    else()
      cmake_path(ABSOLUTE_PATH one BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
      cmake_path(REPLACE_EXTENSION one h OUTPUT_VARIABLE header)
      foreach(file ${one} ${header})
        if(EXISTS ${file} AND NOT found)
          file(STRINGS ${file} found REGEX "#include <(tbb/(parallel|task)_.*|thread|future|zmq.*)>" LIMIT_COUNT 1)
        endif()
      endforeach()
    endif()
    if(found)
      set(starts ON)
    endif()
  endforeach()
  set_target_properties(${name} PROPERTIES ENSONIFY_THREADS ${starts})
endfunction()

# Makes a library one that other projects can link as ensonify::<short name> (InstallRules.cmake).
function(ensonify_export name)
  string(REPLACE "ensonify_" "" short ${name})
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${short})
  install(TARGETS ${name} EXPORT ensonifyTargets ARCHIVE DESTINATION lib COMPONENT development
          FILE_SET HEADERS DESTINATION include/ensonify COMPONENT development)
endfunction()

# ensonify_testing_library(NAME SOURCES ... DEPS ...): code that only tests and benchmarks use; in */testing, never installed.
function(ensonify_testing_library name)
  if(NOT (ENSONIFY_TESTS OR ENSONIFY_BENCH))
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_precompile_headers(${name} REUSE_FROM ensonify_pch)
  target_link_libraries(${name} PUBLIC ensonify_settings ${ARG_DEPS})
endfunction()

add_library(ensonify_kernels INTERFACE)  # all kernels at once
ensonify_export(ensonify_settings)
ensonify_export(ensonify_kernels)

# Command lines are read once and their headers are large: programs that have one share another precompiled header, and
# in builds for developers they are not optimized.
file(WRITE ${CMAKE_BINARY_DIR}/generated/tool_pch.cpp "")
add_library(tool_pch STATIC EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/generated/tool_pch.cpp)
target_link_libraries(tool_pch PUBLIC ensonify_settings PRIVATE Eigen3::Eigen CLI11::CLI11 fmt::fmt nlohmann_json::nlohmann_json)
target_compile_options(tool_pch PRIVATE $<$<CONFIG:RelWithDebInfo>:-O0>)
target_precompile_headers(tool_pch PRIVATE ${precompiled} <CLI/CLI.hpp> <fmt/format.h> <nlohmann/json.hpp>)

# ensonify_program(ensonify-topic SOURCES main.cpp DEPS ...): an installed program in <build>/bin.
function(ensonify_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ensonify_settings ${ARG_DEPS})
  if(CLI11::CLI11 IN_LIST ARG_DEPS)
    target_link_libraries(${name} PRIVATE Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)
    target_compile_options(${name} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O0>)
    target_precompile_headers(${name} REUSE_FROM tool_pch)
  else()
    target_precompile_headers(${name} REUSE_FROM ensonify_pch)
  endif()
  install(TARGETS ${name} RUNTIME DESTINATION bin)
endfunction()

add_custom_target(sanitize_tests)  # every test that runs under the sanitizer of this build

# And Catch2's, for all tests.
if(ENSONIFY_TESTS)
  file(WRITE ${CMAKE_BINARY_DIR}/test_pch.cpp "")
  add_library(test_pch STATIC ${CMAKE_BINARY_DIR}/test_pch.cpp)
  target_link_libraries(test_pch PUBLIC ensonify_settings Catch2::Catch2WithMain)
  target_precompile_headers(test_pch PRIVATE ${precompiled} <catch2/catch.hpp>)
  target_link_libraries(test_pch PRIVATE Eigen3::Eigen)
endif()

# Tests that start threads and run clean under the thread sanitizer. The others were not tried, or take too long, or count
# allocations, which the stand-in of TBB makes (docs/decisions/house.md).
set(ENSONIFY_WATCHED
  array_test autopilot_test bus_test clock_test coverage_test environment_test georeference_test graph_tool_test host_test
  grid_tool_test head_test irregular_test launch_file_test launcher_test lod_test logger_test mesh_file_test
  mesh_message_test nav_feed_test paging_kernel_test patch_tool_test profile_test progressive_test record_live_test
  recorder_test relief_test replay_test sonar_equation_test surface_test survey_grid_test survey_test
  terrain_sources_test terrain_test tile_cache_test tile_store_test tiles_test topic_tool_test towed_body_test
  trace_test transport_test uncertainty_test vehicle_test world_test)

# ensonify_test(NAME_test SOURCES a_test.cpp DEPS lib LABELS unit): one Catch2 program, run as one ctest case.
# Labels: unit, physics, system, determinism, golden, wire, bench. `sanitize`: also runs under the address sanitizer, for
# it handles memory, files or the bytes of others, and does not only compute. `threads` is not written: a unit test
# of code that starts threads, of those named above, also runs under the thread sanitizer. (The presets asan and tsan build those only.) Cases
# tagged [long] repeat for their numbers what their neighbours do once: sanitizers leave them out.
function(ensonify_test name)
  if(NOT ENSONIFY_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;DEPS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE test_pch ${ARG_DEPS})
  target_precompile_headers(${name} REUSE_FROM test_pch)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  ensonify_find_threads(${name} ${ARG_SOURCES} ${ARG_DEPS})
  get_property(threads TARGET ${name} PROPERTY ENSONIFY_THREADS)
  if(threads AND "unit" IN_LIST ARG_LABELS AND name IN_LIST ENSONIFY_WATCHED)
    list(APPEND ARG_LABELS threads)
  endif()
  set(cases "")
  if(ENSONIFY_SANITIZE)
    set(cases ~[long])
  endif()
  add_test(NAME ${name} COMMAND ${name} --use-colour no ${cases})
  ensonify_test_properties(${name} "${ARG_LABELS}" "${ARG_TIMEOUT}")
  if(("sanitize" IN_LIST ARG_LABELS AND ENSONIFY_SANITIZE MATCHES address) OR
     ("threads" IN_LIST ARG_LABELS AND ENSONIFY_SANITIZE MATCHES thread))
    add_dependencies(sanitize_tests ${name})
  endif()
endfunction()

# ensonify_check(NAME COMMAND program arguments... LABELS unit): any command as one ctest case; exit code 77: skipped.
function(ensonify_check name)
  if(NOT ENSONIFY_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "TIMEOUT" "COMMAND;LABELS" ${ARGN})
  add_test(NAME ${name} COMMAND ${ARG_COMMAND})
  ensonify_test_properties(${name} "${ARG_LABELS}" "${ARG_TIMEOUT}")
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77)
endfunction()

# ensonify_python_test(NAME FILE PATHS folder... LABELS unit TIMEOUT s): a unittest file that can import the project's
# client, tests/support and what is in PATHS.
function(ensonify_python_test name file)
  if(NOT ENSONIFY_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "TIMEOUT" "PATHS;LABELS" ${ARGN})
  ensonify_check(${name} COMMAND ${ENSONIFY_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/${file} -v
                 LABELS ${ARG_LABELS} TIMEOUT ${ARG_TIMEOUT})
  list(JOIN ARG_PATHS ":" paths)
  set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT
    PYTHONPATH=${CMAKE_SOURCE_DIR}/clients/python:${CMAKE_SOURCE_DIR}/tests/support:${paths})
endfunction()

# Labels, time limit and environment of a test, and what may run beside it.
function(ensonify_test_properties name labels timeout)
  if(NOT labels)
    set(labels unit)
  endif()
  if(NOT timeout)
    set(timeout 120)
  endif()
  if(ENSONIFY_SANITIZE)
    math(EXPR timeout "5 * ${timeout}")
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${labels}" TIMEOUT ${timeout}
    ENVIRONMENT "ENSONIFY_SOURCE=${CMAKE_SOURCE_DIR};ENSONIFY_FOLDER=${CMAKE_CURRENT_SOURCE_DIR};ENSONIFY_BUILD=${CMAKE_BINARY_DIR};ENSONIFY_BIN=${CMAKE_BINARY_DIR}/bin;ENSONIFY_SHARED=${CMAKE_SOURCE_DIR}/../shared;ASAN_OPTIONS=alloc_dealloc_mismatch=0;TSAN_OPTIONS=ignore_noninstrumented_modules=1 suppressions=${CMAKE_SOURCE_DIR}/cmake/thread_sanitizer/suppressions.txt")
  # One launch at a time, from the start on, and other programs beside it; measurements run alone.
  foreach(launches system determinism)
    if(launches IN_LIST labels)
      set_tests_properties(${name} PROPERTIES RESOURCE_LOCK launch COST 100)
    endif()
  endforeach()
  foreach(alone bench soak)
    if(alone IN_LIST labels)
      set_tests_properties(${name} PROPERTIES RUN_SERIAL ON)
    endif()
  endforeach()
endfunction()

# ensonify_bench(bench_trace SOURCES trace.cpp DEPS ...): a google-benchmark program in <build>/bench.
function(ensonify_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ensonify_settings benchmark::benchmark ${ARG_DEPS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bench)
endfunction()

# ensonify_fuzz(NAME_fuzz SOURCES a_fuzz.cpp DEPS lib): a libFuzzer program in <build>/fuzz, in the preset `fuzz` only.
# A folder corpus/ beside the CMakeLists.txt seeds it (`./dev fuzz`).
function(ensonify_fuzz name)
  if(NOT ENSONIFY_FUZZ)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ensonify_settings ${ARG_DEPS})
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz/corpus/${name})
  if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/corpus)
    file(COPY ${CMAKE_CURRENT_SOURCE_DIR}/corpus/ DESTINATION ${CMAKE_BINARY_DIR}/fuzz/corpus/${name})
  endif()
  add_dependencies(fuzzers ${name})
endfunction()
add_custom_target(fuzzers)  # every libFuzzer program

enable_testing()
