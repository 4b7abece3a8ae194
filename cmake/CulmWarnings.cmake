# Warnings for our own code; third-party headers are system headers and stay quiet.
function(culm_set_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 reports these inside inlined Eigen expressions and std::string concatenation, although
    # nothing is wrong there.
    target_compile_options(
      ${target} PRIVATE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overread
                        -Wno-stringop-overflow -Wno-restrict
    )
  endif()
  if(CULM_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
