# Instrumentation. The link options are public: whoever links an instrumented library needs them.
function(culm_set_instrumentation target)
  if(CULM_SANITIZE)
    target_compile_options(
      ${target}
      PRIVATE -fsanitize=${CULM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    )
    target_link_options(${target} PUBLIC -fsanitize=${CULM_SANITIZE})
  endif()
  if(CULM_COVERAGE)
    target_compile_options(${target} PRIVATE --coverage)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()
