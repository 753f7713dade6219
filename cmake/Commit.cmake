# Writes into HEADER of which commit the program's sources are, with a + where they have been changed since; nothing
# where there is no git. Only where it is another one than before, so that nothing is built anew without need.
# Python's part of the program is not in its file.
set(sources CMakeLists.txt cmake components runtime tasks tools ":(exclude)tools/python")
function(ask_git variable)
  execute_process(COMMAND git --no-optional-locks ${ARGN} WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE text OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(failed)
    set(text "")
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# Sources within another repository have no commit of their own, and in a shallow clone git knows not which one is theirs.
ask_git(top rev-parse --show-toplevel)
ask_git(is_shallow rev-parse --is-shallow-repository)
file(REAL_PATH "${SOURCE}" source)
set(commit "")
if(top STREQUAL source AND is_shallow STREQUAL "false")
  ask_git(commit log -1 --format=%h --abbrev=10 -- ${sources})
  ask_git(changes status --porcelain -- ${sources})
  if(changes)
    string(APPEND commit "+")
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define TAMP_COMMIT \"${commit}\"\n" @ONLY)
