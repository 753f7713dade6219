cmake_minimum_required(VERSION 3.25)

# Writes into FILE the labels that the test cases of the executable TESTS have beside LABEL, their room's: `pinned` those
# with that tag, `quick` those that are not slow and start no ranks. ctest reads it after Catch2's own list, in which
# a test cannot have two labels.
function(list_cases variable)
  execute_process(COMMAND ${TESTS} ${ARGN} --list-test-names-only OUTPUT_VARIABLE names RESULT_VARIABLE n)
  # It ends with how many there are, as far as an exit code can.
  if(NOT n MATCHES "^[0-9]+$")
    message(FATAL_ERROR "${TESTS} does not list its tests: ${n}")
  endif()
  string(REPLACE "\n" ";" names "${names}")
  list(REMOVE_ITEM names "")
  set(${variable} "${names}" PARENT_SCOPE)
endfunction()

list_cases(quick "~[.]~[mpiexec]~[slow]")
list_cases(pinned "[pinned]~[.]")
set(cases ${quick} ${pinned})
list(REMOVE_DUPLICATES cases)
set(text "")
foreach(name IN LISTS cases)
  set(labels ${LABEL})
  foreach(label quick pinned)
    if(name IN_LIST ${label})
      string(APPEND labels ";${label}")
    endif()
  endforeach()
  string(APPEND text "set_tests_properties([==[${PREFIX}${name}]==] PROPERTIES LABELS \"${labels}\")\n")
endforeach()
file(WRITE ${FILE} "${text}")
