# Writes into HEADER of which commit the program's sources are, with a + where they have been changed since; nothing
# where there is no git. Only where it is another one than before, so that nothing is built anew without need.
set(sources CMakeLists.txt cmake components runtime tasks tools)
function(ask_git variable)
  execute_process(COMMAND git --no-optional-locks ${ARGN} -- ${sources} WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE text OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(failed)
    set(text "")
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

ask_git(commit log -1 --format=%h --abbrev=10)
ask_git(changes status --porcelain)
if(changes)
  string(APPEND commit "+")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define TAMP_COMMIT \"${commit}\"\n" @ONLY)
