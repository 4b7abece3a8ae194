# Run by each build: writes OUTPUT, a header with the commit of SOURCE, where it has changed, and the
# build TYPE and COMPILER. A tree without git has no commit.
find_program(git git)
if(git)
  execute_process(
    COMMAND ${git} -C ${SOURCE} describe --always --dirty --exclude * --abbrev=12
    OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
  )
endif()
if(NOT COMMIT)
  set(COMMIT unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#pragma once

/// What this program was built from, and how.
namespace culm::build_info {
inline constexpr const char* commit = "@COMMIT@";
inline constexpr const char* type = "@TYPE@";
inline constexpr const char* compiler = "@COMPILER@";
}  // namespace culm::build_info
]])
