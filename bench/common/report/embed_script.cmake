# Writes OUTPUT, a C++ file with a function FUNCTION of namespace phlux::bench that returns the text of SCRIPT.
# Run by the build: cmake -DSCRIPT=... -DFUNCTION=... -DOUTPUT=... -P embed_script.cmake

set(CHUNK 4000) # bytes a literal: compilers need not take longer ones than 65536 bytes

file(READ "${SCRIPT}" text)
string(LENGTH "${text}" length)
set(literals "")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} ${CHUNK} chunk)
  string(APPEND literals "R\"phlux(${chunk})phlux\"\n")
  math(EXPR at "${at} + ${CHUNK}")
endwhile()
file(WRITE "${OUTPUT}.tmp" "// Made by embed_script.cmake. Do not edit.
#include \"bench/common/report/scripts.h\"

namespace phlux::bench {
std::string_view ${FUNCTION}() { return ${literals}; }
} // namespace phlux::bench
")
file(RENAME "${OUTPUT}.tmp" "${OUTPUT}")
