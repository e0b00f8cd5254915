# Run at every build: writes build_id.cpp anew only where the commit has changed.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty=.dirty --abbrev=10 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "core/build_id.h"
namespace gaitlab {
std::string build_id() { return "@VERSION@+@commit@ (@COMPILER@; @LIBRARIES@)"; }
}  // namespace gaitlab
]])
