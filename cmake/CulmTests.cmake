# What ctest runs: unit tests of packages, and programs and scripts that test the whole.

include(GoogleTest)

# Open MPI: start as root (containers), allow more ranks than cores, do not pin ranks, because tests
# that run side by side would all be pinned to the same cores, and let ranks that wait yield to those
# that work. Do not look for fast networks and devices and do not wait a second for processes that have ended:
# short runs are many.
set(CULM_TEST_ENVIRONMENT
    OMPI_ALLOW_RUN_AS_ROOT=1
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    OMPI_MCA_rmaps_base_oversubscribe=1
    OMPI_MCA_hwloc_base_binding_policy=none
    OMPI_MCA_mpi_yield_when_idle=1
    OMPI_MCA_pml=ob1
    OMPI_MCA_odls_base_sigkill_timeout=0
    OMPI_MCA_btl_vader_single_copy_mechanism=none
    HWLOC_COMPONENTS=-pci,-linuxio,-x86
    OPENBLAS_NUM_THREADS=1
)

# Long tests, each a regular expression of names, and one of all of them.
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS tests/long.txt)
file(STRINGS ${PROJECT_SOURCE_DIR}/tests/long.txt CULM_LONG_TESTS REGEX "^[^#]")
list(TRANSFORM CULM_LONG_TESTS REPLACE "\\." "\\\\.")
list(TRANSFORM CULM_LONG_TESTS REPLACE "\\*" ".*")
list(JOIN CULM_LONG_TESTS "|" CULM_LONG_TEST)

# culm_add_test(name LABEL unit|regression|verification|style COMMAND program [arguments...]
#   RANKS        processes that it runs at once, 1 if not given
#   ENVIRONMENT  further settings, NAME=VALUE)
# Exit code 77 says that something it needs is not there. What tests/long.txt names gets the label long as
# well: tools/test leaves it out without --all.
#
# A test on several processes takes two of the places of tests that run at once, and begins before those on
# one: else it would wait until all others are done, since two places are hardly ever free together, and such
# tests would run one after the other at the end. Its ranks wait asleep, see tests/kit/patience.c; sanitizers
# want to be preloaded before all others.
function(culm_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "LABEL;RANKS" "COMMAND;ENVIRONMENT")
  set_property(GLOBAL APPEND PROPERTY CULM_TEST_NAMES ${name})
  if(name MATCHES "^(${CULM_LONG_TEST})$")
    list(APPEND arg_LABEL long)
  endif()
  set(environment ${CULM_TEST_ENVIRONMENT} ${arg_ENVIRONMENT})
  add_test(NAME ${name} COMMAND ${arg_COMMAND})
  set_tests_properties(
    ${name} PROPERTIES LABELS "${arg_LABEL}" ENVIRONMENT "${environment}" SKIP_RETURN_CODE 77
  )
  if(arg_RANKS GREATER 1)
    set_tests_properties(
      ${name} PROPERTIES LABELS "${arg_LABEL};parallel" PROCESSORS 2 COST 1e4
    )
    if(NOT CULM_SANITIZE)
      set_property(
        TEST ${name} APPEND PROPERTY ENVIRONMENT LD_PRELOAD=$<TARGET_FILE:culm_patience>
      )
    endif()
  endif()
endfunction()

# Called after all tests: tells which long tests are not there. Some need what a machine may lack.
function(culm_check_long_tests)
  get_property(names GLOBAL PROPERTY CULM_TEST_NAMES)
  foreach(name IN LISTS CULM_LONG_TESTS)
    if(NOT ";${names};" MATCHES ";${name};")
      message(STATUS "culm: no test ${name} here (tests/long.txt)")
    endif()
  endforeach()
endfunction()

# The same for a program of ours that mpiexec starts on a number of processes.
function(culm_add_parallel_test name label ranks program)
  culm_add_test(
    ${name} LABEL ${label} RANKS ${ranks}
    COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${program}> ${ARGN}
  )
endfunction()

# Of culm_add_package. A package without MPI shows each of its cases in ctest. With MPI each start costs
# a third of a second, so there one ctest test runs the whole program.
macro(culm_add_package_tests name)
  set(program culm_${name}_test)
  add_executable(${program} ${tests})
  target_link_libraries(${program} PRIVATE ${target} ${arg_PRIVATE} GTest::gmock GTest::gtest)
  target_include_directories(${program} PRIVATE ${PROJECT_SOURCE_DIR}/tests/kit)
  culm_finish_target(${program} SOURCES ${tests} LAYER ${name} TESTS)
  culm_compile_together(${program})
  # What takes time is compiled into the packages; more optimisation takes a fifth longer to compile.
  target_compile_options(${program} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(EXISTS ${folder}/test/main.cpp)
    target_sources(${program} PRIVATE ${folder}/test/main.cpp)
  elseif(uses_mpi)
    target_sources(${program} PRIVATE ${PROJECT_SOURCE_DIR}/tests/kit/mpi_main.cpp)
  else()
    target_link_libraries(${program} PRIVATE GTest::gtest_main)
  endif()
  if(uses_mpi)
    culm_add_test(unit.${name} LABEL unit COMMAND ${program})
  else()
    gtest_discover_tests(
      ${program}
      DISCOVERY_MODE PRE_TEST
      TEST_PREFIX ${name}.
      WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
      PROPERTIES LABELS unit
    )
  endif()
  foreach(ranks IN LISTS arg_RANKS)
    culm_add_parallel_test(unit.${name}.ranks${ranks} unit ${ranks} ${program})
  endforeach()
endmacro()
