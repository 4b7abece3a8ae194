# Warnings for our own code; third-party headers are system headers and stay quiet.
function(culm_set_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion)
  if(CULM_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # not what is global in another source that is compiled along; and what is included is taken for a
    # header, whose unnamed namespaces GCC mistrusts
    target_compile_options(${target} PRIVATE -Wshadow=local -Wno-subobject-linkage)
  else()
    target_compile_options(${target} PRIVATE -Wshadow)
  endif()
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
