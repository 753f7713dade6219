# How TAMP's own code is compiled; what it borrows keeps its own flags.

set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g")

add_library(tamp_options INTERFACE)
target_compile_features(tamp_options INTERFACE cxx_std_20)
target_include_directories(tamp_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(tamp_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
# No fused multiply-add unless it is asked for, so that a number does not depend on how a function was inlined; and no
# errno from sqrt and no trap on a division, neither of which changes a number, so that loops with them are vectorised.
target_compile_options(tamp_options INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
# HDF5's own list of libraries is long; the program loads only those it calls.
target_link_options(tamp_options INTERFACE -Wl,--as-needed)
if(TAMP_NATIVE)
  target_compile_options(tamp_options INTERFACE -march=native)
endif()
if(TAMP_CHECKED)
  target_compile_definitions(tamp_options INTERFACE TAMP_CHECKED=1)
endif()
if(TAMP_SANITIZE)
  target_compile_options(tamp_options INTERFACE -fsanitize=${TAMP_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(tamp_options INTERFACE -fsanitize=${TAMP_SANITIZE})
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # gcc 12 sees overlapping copies in its own std::string (gcc bug 105651), and unset values in its own AVX-512 intrinsics
  # (gcc bug 105593) and, with sanitizers on, in inlined library code.
  target_compile_options(tamp_options INTERFACE -Wno-restrict -Wno-uninitialized -Wno-maybe-uninitialized)
endif()

# tamp_library(ROOM [SOURCE_LEFT_OUT...]): the library tamp_ROOM of every source below the current folder.
function(tamp_library room)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(left_out IN LISTS ARGN)
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${left_out})
  endforeach()
  if(NOT sources)
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
    file(TOUCH ${sources})
  endif()
  add_library(tamp_${room} STATIC ${sources})
  target_link_libraries(tamp_${room} PUBLIC tamp_options)
endfunction()

# Headers of what is borrowed give no warnings of ours.
foreach(borrowed TBB::tbb Eigen3::Eigen MPI::MPI_C hdf5::hdf5 fmt::fmt nlohmann_json::nlohmann_json CLI11::CLI11
                 Catch2::Catch2)
  get_target_property(folders ${borrowed} INTERFACE_INCLUDE_DIRECTORIES)
  if(folders)
    set_property(TARGET ${borrowed} APPEND PROPERTY INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${folders})
  endif()
endforeach()

function(tamp_print_summary)
  get_property(summary GLOBAL PROPERTY tamp_summary)
  set(tuned "any x86-64 processor")
  if(TAMP_NATIVE)
    set(tuned "this processor")
  endif()
  message(STATUS "TAMP ${PROJECT_VERSION}, ${CMAKE_BUILD_TYPE}, for ${tuned}, by ${CMAKE_CXX_COMPILER_ID} "
                 "${CMAKE_CXX_COMPILER_VERSION}, with\n${summary}")
endfunction()
