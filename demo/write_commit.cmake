# Writes OUTPUT, the source of commitName(), when the commit has changed since. Run at every build.
execute_process(COMMAND git describe --always --exclude=* --dirty=+ --abbrev=10
  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR commit STREQUAL "")
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#include "demo/commit.h"

std::string rubble::demo::commitName() {
  return "@commit@";
}
]] @ONLY)
