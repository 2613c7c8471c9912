# Writes the commit of SOURCE to the header OUTPUT if it has changed.
cmake_minimum_required(VERSION 3.25)

# git refuses to read another user's clone unless it is declared safe; these commands run nothing from it.
function(ask_git result)
  set(${result} "" PARENT_SCOPE)
  if(NOT GIT)
    return()
  endif()
  execute_process(COMMAND ${GIT} -c safe.directory=${SOURCE} -C ${SOURCE} ${ARGN}
    OUTPUT_VARIABLE answer OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  set(${result} "${answer}" PARENT_SCOPE)
endfunction()

ask_git(folder rev-parse --show-toplevel) # SOURCE may be inside another repository
get_filename_component(source "${SOURCE}" REALPATH)
set(commit unknown)
if(folder STREQUAL source)
  ask_git(commit log -1 --format=%h\ of\ %cs)
  ask_git(changes status --porcelain -- host kernels bench CMakeLists.txt CMakePresets.json)
  if(NOT commit)
    set(commit unknown)
  elseif(changes)
    string(APPEND commit ", with changes")
  endif()
endif()
set(text "#pragma once\n#define PHLUX_COMMIT \"${commit}\"\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} before)
endif()
if(NOT text STREQUAL "${before}")
  file(WRITE ${OUTPUT} "${text}")
endif()
