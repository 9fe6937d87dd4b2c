# Settings that every target shares, and the two ways a target is declared.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(PAS_CCACHE ccache)
if(PAS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without this leave, ccache passes every use of a precompiled header by.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros ${PAS_CCACHE})
endif()
set(CMAKE_PCH_WARN_INVALID OFF)

add_library(pas_settings INTERFACE)
# No contraction: the same source gives the same bits whatever the compiler may fuse.
target_compile_options(pas_settings INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -ffp-contract=off
  $<$<BOOL:${PAS_WARNINGS_AS_ERRORS}>:-Werror>)
# The compiler tidies its memory up after every 1.5 GB instead of 0.13: up to a seventh of its time.
target_compile_options(pas_settings INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1500000>)
target_include_directories(pas_settings INTERFACE ${PROJECT_SOURCE_DIR})
# A program loads what it uses: OpenCV's image files alone bring a hundred libraries, 0.2 s a start.
target_link_options(pas_settings INTERFACE -Wl,--as-needed)
if(PAS_SANITIZE)
  target_compile_options(pas_settings INTERFACE
    -fsanitize=${PAS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(pas_settings INTERFACE -fsanitize=${PAS_SANITIZE})
  # Eigen aligns by itself when AddressSanitizer is on; the libraries that allocate what we free do not.
  # The library's own checks: past the end of a vector there may be room that nobody misses.
  target_compile_definitions(pas_settings INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1 _GLIBCXX_ASSERTIONS)
endif()

if(PAS_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "PAS_FUZZ needs clang: -DCMAKE_CXX_COMPILER=clang++ (ci/fuzz does all of it)")
  endif()
  target_compile_options(pas_settings INTERFACE
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(pas_settings INTERFACE -fsanitize=address,undefined)
endif()

# Headers that nearly every file reads, parsed once: one set for the program, one for the tests.
function(pas_precompiled target)
  add_library(${target} STATIC ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${target} PRIVATE pas_settings Eigen3::Eigen pas::opencv
                        nlohmann_json::nlohmann_json)
  target_precompile_headers(${target} PRIVATE <algorithm> <cmath> <filesystem> <functional> <map>
    <memory> <optional> <set> <sstream> <string> <vector> <Eigen/Core> <Eigen/Geometry>
    <opencv2/core.hpp> <nlohmann/json.hpp> ${ARGN})
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()
function(pas_reuse_precompiled target from)
  target_precompile_headers(${target} REUSE_FROM ${from})
  target_link_libraries(${target} PRIVATE Eigen3::Eigen pas::opencv nlohmann_json::nlohmann_json)
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# Files of one target compiled a few at a time, so that their headers are parsed once. OFF compiles
# each by itself, which is quicker while one file is edited and finds a missing #include.
option(PAS_UNITY "Compile several files of a target at once" ON)
function(pas_unity target batch)
  if(PAS_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
  endif()
endfunction()

# pas_library(io io LINK yaml-cpp): a folder of the tree as a library, from all sources in it (a new
# file is found by itself). Headers are included from the top of the tree: "slam/geometry/pose.h".
function(pas_library target folder)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h)
  if(sources)
    add_library(${target} STATIC ${sources} ${headers})
    target_link_libraries(${target} PUBLIC pas_settings ${ARG_LINK})
    pas_reuse_precompiled(${target} pas_precompiled)
  else()
    add_library(${target} INTERFACE)
    target_sources(${target} PRIVATE ${headers})
    target_link_libraries(${target} INTERFACE pas_settings ${ARG_LINK})
  endif()
endfunction()

# pas_stage(slam geometry LINK Eigen3::Eigen): the folder of one stage as a library, slam_geometry. It
# links io and the stages of its world that were declared before it, so the order of the declarations
# is the data flow, and joins slam_all.
function(pas_stage world stage)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  get_property(before GLOBAL PROPERTY pas_stages_${world})
  set(target ${world}_${stage})
  pas_library(${target} ${world}/${stage} LINK io ${before} ${ARG_LINK})
  get_target_property(type ${target} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    pas_unity(${target} 16)
  endif()
  set_property(GLOBAL APPEND PROPERTY pas_stages_${world} ${target})
  if(NOT TARGET ${world}_all)
    add_library(${world}_all INTERFACE)
  endif()
  target_link_libraries(${world}_all INTERFACE ${target})
endfunction()

# pas_lanes(a.cpp b.cpp): loops over rows that the compiler is to do several pixels at once of. It may
# take it that nobody reads errno or the processor's floating-point flags; results are the same bits.
function(pas_lanes)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
    SKIP_UNITY_BUILD_INCLUSION ON
    COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math;-Wno-psabi")
endfunction()

# pas_test(slam/faces SOURCES a_test.cpp LINK slam_faces [TIMEOUT s] [CASES n]): one executable a folder;
# every case is a CTest test of its own, "slam/planes/Suite.Case". CASES is how many inputs a
# rapidcheck property draws (100). PAS_SHARED_DIR (environment) may
# name the folder with the reference figures and recordings; tests that need it skip without it.
function(pas_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT;CASES" "SOURCES;LINK" ${ARGN})
  string(REPLACE "/" "_" target ${name}_test)
  add_executable(${target} ${ARG_SOURCES})
  # The C++ library comes first: else what GoogleTest needs of it is taken from the first of our
  # archives that has it, too, and brings all that the archive needs.
  target_link_libraries(${target} PRIVATE pas_settings stdc++ ${ARG_LINK} GTest::gmock GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE
    PAS_SOURCE_DIR="${PROJECT_SOURCE_DIR}" PAS_BINARY_DIR="${PROJECT_BINARY_DIR}")
  pas_reuse_precompiled(${target} pas_precompiled_tests)
  pas_unity(${target} 12)
  # What is tested is built as released; the tests themselves need not be.
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(PAS_SANITIZE)
    math(EXPR ARG_TIMEOUT "10 * ${ARG_TIMEOUT}")  # several times slower, and on machines that are shared
  endif()
  if(NOT ARG_CASES)
    set(ARG_CASES 100)
  endif()
  gtest_discover_tests(${target} TEST_PREFIX ${name}/ DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT ${ARG_TIMEOUT}
    ENVIRONMENT "RC_PARAMS=seed=20240207 max_size=100 max_success=${ARG_CASES}")
endfunction()
include(GoogleTest)
