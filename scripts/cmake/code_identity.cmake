# Run at every build: what the numbers of a result depend on, as one sha256, and the commit for people. Writes OUTPUT
# only when it changed, so that nothing is linked again for nothing.
#
#   cmake -D SOURCE=... -D OUTPUT=... -P code_identity.cmake
set(layers kernels)
file(STRINGS ${SOURCE}/engine/layers.txt lines REGEX ":")
foreach(line IN LISTS lines)
  string(REGEX REPLACE ":.*" "" layer "${line}")
  if(NOT layer MATCHES "^(kernels|app|python)$")  # what people type and read, not what is computed
    list(APPEND layers engine/${layer})
  endif()
endforeach()
set(all "")
foreach(layer IN LISTS layers)
  file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/${layer}/*.cpp ${SOURCE}/${layer}/*.hpp)
  list(APPEND all ${files})
endforeach()
list(SORT all)
set(text "")
foreach(file IN LISTS all)
  file(SHA256 ${SOURCE}/${file} hash)
  string(APPEND text "${file} ${hash}\n")
endforeach()
string(SHA256 sources "${text}")

set(commit "")
find_package(Git QUIET)
if(GIT_FOUND AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12 WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()

set(code "// written by scripts/cmake/code_identity.cmake
#include \"engine/experiment/runs/code_identity.hpp\"

namespace torquescope {
char const* sources_sha256() { return \"${sources}\"; }
char const* source_commit() { return \"${commit}\"; }
}  // namespace torquescope
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL code)
  file(WRITE ${OUTPUT} "${code}")
endif()
