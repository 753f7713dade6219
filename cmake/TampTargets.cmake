# How TAMP's own code is compiled; what it borrows keeps its own flags.

set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g")

add_library(tamp_options INTERFACE)
target_compile_features(tamp_options INTERFACE cxx_std_20)
target_include_directories(tamp_options INTERFACE ${PROJECT_SOURCE_DIR})
if(TAMP_WARNINGS)
  target_compile_options(tamp_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
endif()

# The same bits from every compiler, for every processor: no fused multiply-add, and sums in the order in which they are
# written, which in Eigen's hands depends on the width of a register. Neither errno from sqrt nor traps on a division
# change a number; without them loops are vectorised.
target_compile_options(tamp_options INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
target_compile_definitions(tamp_options INTERFACE EIGEN_DONT_VECTORIZE)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(tamp_options INTERFACE -march=${TAMP_ARCH})
elseif(TAMP_ARCH STREQUAL "native" AND NOT CMAKE_CROSSCOMPILING)
  target_compile_options(tamp_options INTERFACE -mcpu=native)
endif()

# HDF5's own list of libraries is long; the program loads only those it calls.
target_link_options(tamp_options INTERFACE -Wl,--as-needed)
if(TAMP_CHECKED)
  target_compile_definitions(tamp_options INTERFACE TAMP_CHECKED=1)
endif()
if(TAMP_SANITIZE)
  # Lines in a report, but not variables, which would double the compile time. So would looking at every pointer for
  # null and alignment: the address sanitizer stops at what is read and written through null, and at its own sizes.
  # Optimised, as accessors that are not inlined are what takes the time.
  target_compile_options(tamp_options INTERFACE -fsanitize=${TAMP_SANITIZE} -fno-sanitize=null,alignment,object-size
                                                -fno-omit-frame-pointer -g1 -O2)
  target_link_options(tamp_options INTERFACE -fsanitize=${TAMP_SANITIZE})
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # gcc 12 sees overlapping and endless copies in its own std::string (gcc bug 105651), and unset values in its own
  # AVX-512 intrinsics (gcc bug 105593) and, with sanitizers on, in inlined library code.
  target_compile_options(tamp_options INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-uninitialized
                                                -Wno-maybe-uninitialized)
endif()

# tamp_sources(SOURCES [LEFT_OUT...]): every source below the current folder but those whose paths match.
function(tamp_sources variable)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(left_out IN LISTS ARGN)
    list(FILTER sources EXCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/${left_out}")
  endforeach()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# tamp_library(ROOM [LEFT_OUT...]): the library tamp_ROOM of those sources.
function(tamp_library room)
  tamp_sources(sources ${ARGN})
  add_library(tamp_${room} STATIC ${sources})
  target_link_libraries(tamp_${room} PUBLIC $<BUILD_INTERFACE:tamp_options>)
  tamp_unite_folders(tamp_${room})
endfunction()

# Where CMAKE_UNITY_BUILD is on, the sources of a folder are compiled as one, or as a few where there are more than
# TAMP_MOST_UNITED: what they borrow is read, and its templates are made, once. Sources with options of their own stay
# by themselves. tools/lint, which spends its time on what is borrowed, takes whole folders.
set(TAMP_MOST_UNITED 16)
function(tamp_unite_folders target)
  if(CMAKE_BUILD_TYPE STREQUAL "Lint")
    set(TAMP_MOST_UNITED 100)
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(ABSOLUTE_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER "${folder}" group)
    list(APPEND groups ${group})
    list(APPEND sources_of_${group} ${source})
  endforeach()
  list(REMOVE_DUPLICATES groups)
  foreach(group IN LISTS groups)
    list(LENGTH sources_of_${group} n)
    math(EXPR n_units "(${n} + ${TAMP_MOST_UNITED} - 1) / ${TAMP_MOST_UNITED}")
    set(i 0)
    foreach(source IN LISTS sources_of_${group})
      math(EXPR unit "${i} * ${n_units} / ${n}")
      math(EXPR i "${i} + 1")
      set(name ${group})
      if(unit GREATER 0)
        string(APPEND name _${unit})
      endif()
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name})
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# Sources that take the compiler long, or much memory, stay by themselves there.
function(tamp_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Compiles a target that is no part of a time step, and so not worth more of the compiler's time.
function(tamp_compile_fast target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Kernels are made of many small functions on registers. gcc's own limits leave some of them calls, which keep no
# register: a step then takes a sixth longer (docs/findings/what_made_it_faster.md).
function(tamp_inline_kernels target)
  set(limits inline-unit-growth=300 large-unit-insns=100000 large-function-growth=1000 large-function-insns=20000
             large-stack-frame-growth=4000 max-inline-insns-single=1000 max-inline-insns-auto=100)
  list(TRANSFORM limits PREPEND --param=)
  target_compile_options(${target} PRIVATE $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>:${limits}>)
endfunction()

# Headers of what is borrowed give no warnings of ours.
foreach(borrowed TBB::tbb Eigen3::Eigen MPI::MPI_C hdf5::hdf5 fmt::fmt nlohmann_json::nlohmann_json CLI11::CLI11
                 Catch2::Catch2)
  if(TARGET ${borrowed})
    get_target_property(folders ${borrowed} INTERFACE_INCLUDE_DIRECTORIES)
    if(folders)
      set_property(TARGET ${borrowed} APPEND PROPERTY INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${folders})
    endif()
  endif()
endforeach()

function(tamp_print_summary)
  get_property(summary GLOBAL PROPERTY tamp_summary)
  message(STATUS "TAMP ${PROJECT_VERSION}, ${CMAKE_BUILD_TYPE}, for ${TAMP_ARCH} processors, by "
                 "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, with\n${summary}")
endfunction()
