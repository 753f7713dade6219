# Libraries that TAMP uses. Each find is followed by a line for the summary that ends the configure step.

function(tamp_uses name version purpose)
  set_property(GLOBAL APPEND_STRING PROPERTY tamp_summary "  ${name} ${version}: ${purpose}\n")
endfunction()

find_program(TAMP_CCACHE ccache)
if(TAMP_CCACHE)
  # Precompiled headers are found again by their content.
  set(with_ccache ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${TAMP_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${with_ccache})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${with_ccache})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
endif()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)

find_package(TBB REQUIRED CONFIG)
tamp_uses(oneTBB ${TBB_VERSION} "threads and concurrent containers")

find_package(Eigen3 3.4 REQUIRED CONFIG)
tamp_uses(Eigen ${Eigen3_VERSION} "small vectors and matrices")

# Debian's package has no CMake file of its own.
find_path(SLEEF_INCLUDE_DIR sleef.h REQUIRED)
find_library(SLEEF_LIBRARY sleef REQUIRED)
add_library(SLEEF::sleef UNKNOWN IMPORTED)
set_target_properties(SLEEF::sleef PROPERTIES IMPORTED_LOCATION ${SLEEF_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${SLEEF_INCLUDE_DIR})
tamp_uses(SLEEF "" "elementary functions with the same bits on every processor")

# Neither has this one, of which the header is all that is used.
find_path(XXHASH_INCLUDE_DIR xxhash.h)
if(NOT XXHASH_INCLUDE_DIR)
  message(FATAL_ERROR "xxHash was not found; install libxxhash-dev")
endif()
add_library(xxHash::xxhash INTERFACE IMPORTED)
set_target_properties(xxHash::xxhash PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${XXHASH_INCLUDE_DIR})
tamp_uses(xxHash "" "checksums of files")

find_package(MPI REQUIRED COMPONENTS C)
tamp_uses(MPI ${MPI_C_VERSION} "messages between ranks (${MPI_C_LIBRARIES})")

# The parallel build, so that ranks can write one file together.
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "HDF5 ${HDF5_VERSION} was built without MPI; install libhdf5-openmpi-dev")
endif()
tamp_uses(HDF5 ${HDF5_VERSION} "fields and checkpoints (parallel build)")

find_package(fmt REQUIRED CONFIG)
tamp_uses(fmt ${fmt_VERSION} "text")

find_package(nlohmann_json 3.11 REQUIRED CONFIG)
tamp_uses(nlohmann-json ${nlohmann_json_VERSION} "scenes and reports")

find_package(CLI11 REQUIRED CONFIG)
tamp_uses(CLI11 ${CLI11_VERSION} "the command line")

if(TAMP_MESHES)
  find_package(CGAL 5.5 REQUIRED CONFIG)
  tamp_uses(CGAL ${CGAL_VERSION} "triangle meshes (GPL)")
endif()

if(TAMP_TESTS)
  find_package(Catch2 2.13...<3 QUIET CONFIG)
  if(Catch2_FOUND)
    tamp_uses(Catch2 ${Catch2_VERSION} "tests")
  elseif(TAMP_TESTS STREQUAL "auto")
    message(STATUS "The tests are left out: they need Catch2 from 2.13 to below 3")
  else()
    message(FATAL_ERROR "The tests need Catch2 from 2.13 to below 3; install catch2, or set TAMP_TESTS to OFF")
  endif()
endif()
