# Language, warnings, output folders and sanitizers: what every target of the project shares.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(ENSONIFY_TESTS "Build the tests" ON)
option(ENSONIFY_BENCH "Build the benchmarks" ON)
option(ENSONIFY_FUZZ "Build the libFuzzer targets (clang)" OFF)
option(ENSONIFY_WERROR "Warnings are errors" OFF)
set(ENSONIFY_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Every program lands in one folder: `ensonify X` executes `ensonify-X` found beside itself.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# Debian's Python (never a shim found on PATH), or the environment that `dev` made on top of it.
set(ENSONIFY_PYTHON /usr/bin/python3)
if(EXISTS ${CMAKE_SOURCE_DIR}/build/venv/bin/python)
  set(ENSONIFY_PYTHON ${CMAKE_SOURCE_DIR}/build/venv/bin/python)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
find_program(LLD ld.lld)
if(LLD)
  add_link_options(-fuse-ld=lld)
endif()

add_library(ensonify_settings INTERFACE)
target_include_directories(ensonify_settings INTERFACE
  $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:include/ensonify>)
target_compile_features(ensonify_settings INTERFACE cxx_std_20)
target_compile_options(ensonify_settings INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wnon-virtual-dtor;-Wpedantic;-Wno-missing-field-initializers>
  # g++ 12 sees uninitialised variants where there are none (GCC bugs 105562, 107919).
  # And writes beyond strings where there are none, once their header is precompiled (GCC bugs 105329, 105651).
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>>
  # g++ 12 may leave a cold part of a function that holds nothing; exceptions that pass the function behind it then end the
  # program (check_unwinding.py). Without cold parts there are none.
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-fno-reorder-blocks-and-partition>>
  $<$<BOOL:${ENSONIFY_WERROR}>:$<BUILD_INTERFACE:-Werror>>
  # The same source gives the same bits: no fused multiply-add unless written (docs/architecture.md).
  $<BUILD_INTERFACE:-ffp-contract=off>)
# Rays are traced with Embree's AVX2 code, so nothing is lost by the compiler's using it. Public, because the alignment
# of Eigen's types follows it.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(ensonify_settings INTERFACE -march=x86-64-v3)
endif()
if(ENSONIFY_SANITIZE)
  add_compile_options(-fsanitize=${ENSONIFY_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${ENSONIFY_SANITIZE})
  # A test that counts allocations replaces new and delete; g++ sees the pair apart when it inlines one of them only,
  # and the address sanitizer (Targets.cmake) when a shared library allocates.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-mismatched-new-delete>)
endif()
if(ENSONIFY_SANITIZE MATCHES thread)
  # In place of oneTBB, into whose library the thread sanitizer does not see.
  target_include_directories(ensonify_settings BEFORE INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/cmake/thread_sanitizer>)
endif()
if(ENSONIFY_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)  # coverage, by which libFuzzer finds its way
endif()
