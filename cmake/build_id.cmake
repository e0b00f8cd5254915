# Run at every build; rewrites build_id.cpp only if the commit has changed. In an unchanged checkout of the release tag
# vVERSION, the id is the version alone.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty=.dirty --abbrev=10 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
set(of_commit true)
if(commit MATCHES "^unknown$|[.]dirty$")
  set(of_commit false)
endif()
execute_process(COMMAND git -C ${SOURCE_DIR} describe --exact-match --dirty --match v${VERSION} --tags
  OUTPUT_VARIABLE release OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(release STREQUAL "v${VERSION}")
  set(id ${VERSION})
else()
  set(id ${VERSION}+${commit})
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "core/build_id.h"
namespace gaitlab {
std::string build_id() { return "@id@ (@COMPILER@; @LIBRARIES@)"; }
bool build_is_of_commit() { return @of_commit@; }
}  // namespace gaitlab
]])
