# Writes OUTPUT, a C++ file that holds every file of FOLDER named in FILES (relative paths, separated by "|").
# Run by the build: cmake -DFOLDER=... -DFILES=... -DOUTPUT=... -P embed_kernels.cmake

set(CHUNK 4000) # bytes a literal: compilers need not take longer ones than 65536 bytes

string(REPLACE "|" ";" files "${FILES}")
set(entries "")
foreach(name IN LISTS files)
  file(READ "${FOLDER}/${name}" text)
  string(LENGTH "${text}" length)
  set(literals "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} ${CHUNK} chunk)
    string(APPEND literals "R\"phlux(${chunk})phlux\"\n")
    math(EXPR at "${at} + ${CHUNK}")
  endwhile()
  if(NOT literals)
    set(literals "\"\"\n")
  endif()
  string(APPEND entries "{\"${name}\",\n${literals}},\n")
endforeach()

file(WRITE "${OUTPUT}.tmp" "// Made by embed_kernels.cmake from the files of kernels/. Do not edit.
#include \"sources/embedded.h\"

namespace phlux::sources {
namespace {
constexpr EmbeddedFile files[] = {
${entries}{\"\", \"\"}}; // an end mark, so that no kernels at all is no empty array
} // namespace
std::span<const EmbeddedFile> embedded_files() { return std::span(files).first(std::size(files) - 1); }
} // namespace phlux::sources
")
file(RENAME "${OUTPUT}.tmp" "${OUTPUT}")
