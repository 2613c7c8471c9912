# Writes OUTPUT, a C++ file that defines NAMESPACE::FUNCTION(), declared in HEADER: it returns the text of every file of
# FOLDER named in FILES (relative paths, separated by "|"), each as a sources::EmbeddedFile.
# Run by the build: cmake -DFOLDER=... -DFILES=... -DHEADER=... -DNAMESPACE=... -DFUNCTION=... -DOUTPUT=... -P embed_files.cmake

get_filename_component(FOLDER_NAME "${FOLDER}" NAME)
set(CHUNK 4000) # bytes per literal: compilers may limit them to 65536 bytes

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
  # With its length: clang does not count as many characters in a constant expression.
  string(APPEND entries "{\"${name}\",\n${literals}\"\"sv},\n")
endforeach()

file(WRITE "${OUTPUT}.tmp" "// Made by embed_files.cmake from the files of ${FOLDER_NAME}/. Do not edit.
#include \"${HEADER}\"

namespace ${NAMESPACE} {
namespace {
using namespace std::literals;
constexpr phlux::sources::EmbeddedFile files[] = {
${entries}{\"\", \"\"}}; // an end mark, as an array must not be empty
} // namespace
std::span<const phlux::sources::EmbeddedFile> ${FUNCTION}() { return std::span(files).first(std::size(files) - 1); }
} // namespace ${NAMESPACE}
")
file(RENAME "${OUTPUT}.tmp" "${OUTPUT}")
