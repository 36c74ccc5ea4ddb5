# Writes the header that names the commit of the source; the file is touched only if that has changed.
# cmake -DSOURCE=FOLDER -DHEADER=FILE -P cmake/write_commit.cmake

function(ask_git output)
  execute_process(COMMAND git -C ${SOURCE} ${ARGN}
    OUTPUT_VARIABLE answer RESULT_VARIABLE result ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT result EQUAL 0)
    set(answer "")
  endif()
  set(${output} "${answer}" PARENT_SCOPE)
endfunction()

set(commit unknown)
ask_git(prefix rev-parse --show-prefix)  # not empty: unpacked somewhere in another checkout, whose commit says nothing
ask_git(head rev-parse --short=10 HEAD)
if(head AND NOT prefix)
  # Measured results are no part of the program, and change with each measurement.
  ask_git(changes status --porcelain --untracked-files=no -- . ":(exclude)cases/*/measured")
  set(commit ${head})
  if(changes)
    string(APPEND commit "+")
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "// Written by cmake/write_commit.cmake.\n#define TANKTREAD_COMMIT \"${commit}\"\n")
