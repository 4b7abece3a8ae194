# culm_add_package(NAME
#   DEPENDS     packages whose headers ours include
#   EXTERNAL    culm_external:: targets that our public headers include
#   PRIVATE     culm_external:: targets used in src/ and test/ only
#   PRECOMPILE  headers to precompile: this package begins a layer, see below
#   RANKS       process counts on which the tests run as well, under mpiexec)
#
# The folder is its own file list: include/culm/NAME/*.hpp, src/*.cpp, test/*_test.cpp. Makes
#   culm::NAME         the library (interface only while src/ is empty)
#   culm_NAME_test     all unit tests
#   culm_NAME_headers  every public header compiled alone, with CULM_HEADER_CHECK, by the test compiles
# Sources named *_cxx17.cpp are compiled as C++17, for the few Trilinos headers that need it.
#
# Parsing headers would cost more than half of a build. So a package that begins a layer compiles
# the headers that its layer shares beforehand, once for sources and once, with GoogleTest, for
# tests. Packages without PRECOMPILE use those of the highest layer that they depend on.
#
# With CULM_UNITY the sources of a package are compiled eight at a time, and so are its tests, which
# saves half of the time: their headers and templates are common. So what is in an unnamed namespace
# has a name that no other source, or no other test, of the package gives to something else.

include(CMakePackageConfigHelpers)

find_program(CULM_CCACHE ccache)
if(CULM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without this sloppiness ccache does not cache anything that uses a precompiled header. It must
  # look at the headers themselves: where only a comment changed, preprocessed texts are equal, and
  # it would return a precompiled header that does not know the changed file. Paths in the tree count
  # relative to it, so that one clone finds what another one compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_DEPEND=1
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CULM_CCACHE}
  )
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(PREPEND CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_CURRENT_LIST_DIR}/compile_with_headers.sh)
  # Where there is memory for it, the compiler does not look for what it no longer needs, which takes a tenth of its time.
  cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)  # MiB
  cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
  math(EXPR memory_per_core "${memory} / ${cores}")
  if(memory_per_core GREATER 4000)
    add_compile_options(--param=ggc-min-heapsize=4000000)  # KiB
  endif()
endif()

function(culm_add_package name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "DEPENDS;EXTERNAL;PRIVATE;PRECOMPILE;RANKS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "culm_add_package(${name}): unknown '${arg_UNPARSED_ARGUMENTS}'")
  endif()
  set(folder ${CMAKE_CURRENT_SOURCE_DIR})
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${folder}/include/culm/${name}/*.hpp)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/src/*.cpp)
  file(GLOB tests CONFIGURE_DEPENDS ${folder}/test/*_test.cpp)
  if(NOT headers AND NOT sources)
    message(STATUS "culm: package ${name} is empty so far")
    return()
  endif()

  set(target culm_${name})
  list(TRANSFORM arg_EXTERNAL PREPEND culm_external::)
  list(TRANSFORM arg_PRIVATE PREPEND culm_external::)
  if(sources)
    add_library(${target} STATIC ${sources})
    set(public PUBLIC)
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE})
  else()
    add_library(${target} INTERFACE)
    set(public INTERFACE)
  endif()
  add_library(culm::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${public} cxx_std_20)
  target_include_directories(
    ${target} ${public} $<BUILD_INTERFACE:${folder}/include>
                        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
  )
  target_link_libraries(${target} ${public} ${arg_EXTERNAL})

  if("culm_external::MPI" IN_LIST arg_EXTERNAL)
    set(uses_mpi ON)
  endif()
  foreach(dependency IN LISTS arg_DEPENDS)
    if(TARGET culm_${dependency})
      target_link_libraries(${target} ${public} culm::${dependency})
      get_property(its_mpi GLOBAL PROPERTY CULM_${dependency}_USES_MPI)
      if(its_mpi)
        set(uses_mpi ON)
      endif()
    elseif(NOT EXISTS ${PROJECT_SOURCE_DIR}/packages/${dependency}/CMakeLists.txt)
      message(FATAL_ERROR "culm_add_package(${name}): no package '${dependency}'")
    endif()
  endforeach()
  set_property(GLOBAL PROPERTY CULM_${name}_USES_MPI ${uses_mpi})
  culm_choose_layer(${name} PRECOMPILE ${arg_PRECOMPILE} DEPENDS ${arg_DEPENDS})
  if(sources)
    culm_finish_target(${target} SOURCES ${sources} LAYER ${name})
    culm_compile_together(${target})
  endif()

  if(CULM_TESTS AND tests)
    culm_add_package_tests(${name})
  endif()
  if(CULM_HEADER_CHECK AND headers)
    culm_add_header_check(${name})
  endif()

  install(TARGETS ${target} EXPORT culmTargets COMPONENT development)
  if(headers)
    install(DIRECTORY ${folder}/include/culm DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
            COMPONENT development)
  endif()
  set_property(GLOBAL APPEND PROPERTY CULM_PACKAGES ${name})
endfunction()

# The layer of a package: its own, or the last begun of those that it depends on.
function(culm_choose_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PRECOMPILE;DEPENDS")
  get_property(layers GLOBAL PROPERTY CULM_LAYERS)
  set(layer)
  foreach(dependency IN LISTS arg_DEPENDS)
    get_property(its_layer GLOBAL PROPERTY CULM_${dependency}_LAYER)
    list(FIND layers "${its_layer}" place)
    list(FIND layers "${layer}" highest)
    if(place GREATER highest)
      set(layer ${its_layer})
    endif()
  endforeach()
  if(arg_PRECOMPILE)
    set(layer ${name})
    set_property(GLOBAL APPEND PROPERTY CULM_LAYERS ${name})
    list(TRANSFORM arg_PRECOMPILE REPLACE "^([^<].*)$" "<\\1>")
    set_property(GLOBAL PROPERTY CULM_${name}_PRECOMPILE ${arg_PRECOMPILE})
  endif()
  set_property(GLOBAL PROPERTY CULM_${name}_LAYER ${layer})
endfunction()

# culm_precompile(target layer use): the target compiles with the headers of a layer, for SOURCES or
# for TESTS. The first target of a layer and use makes them, the others share.
function(culm_precompile target layer use)
  get_property(owner GLOBAL PROPERTY CULM_${layer}_${use}_PRECOMPILED)
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  else()
    get_property(headers GLOBAL PROPERTY CULM_${layer}_PRECOMPILE)
    if(use STREQUAL TESTS)
      list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
    endif()
    target_precompile_headers(${target} PRIVATE ${headers})
    set_property(GLOBAL PROPERTY CULM_${layer}_${use}_PRECOMPILED ${target})
  endif()
  # for ccache
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# Several sources of a target at once; see the top.
function(culm_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CULM_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# Warnings, instrumentation, the C++17 rule and, with LAYER, the precompiled headers of a package's
# layer; with TESTS, those for tests: for everything we compile.
function(culm_finish_target target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "TESTS" "LAYER" "SOURCES")
  culm_set_warnings(${target})
  culm_set_instrumentation(${target})
  # programs and libraries share precompiled headers, so they need the same kind of code
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
  set(cxx17 ${arg_SOURCES})
  list(FILTER cxx17 INCLUDE REGEX "_cxx17\\.cpp$")
  if(cxx17)
    set_source_files_properties(
      ${cxx17} PROPERTIES COMPILE_OPTIONS -std=c++17 SKIP_PRECOMPILE_HEADERS ON
                          SKIP_UNITY_BUILD_INCLUSION ON
    )
  endif()
  # templates that take minutes each: they gain nothing, and one process would compile them all
  set(large ${arg_SOURCES})
  list(FILTER large INCLUDE REGEX "_(elements|batches|pack)\\.cpp$")
  if(large)
    set_source_files_properties(${large} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  get_property(layer GLOBAL PROPERTY CULM_${arg_LAYER}_LAYER)
  if(layer AND arg_TESTS)
    culm_precompile(${target} ${layer} TESTS)
  elseif(layer)
    culm_precompile(${target} ${layer} SOURCES)
  endif()
endfunction()

# A header that compiles alone includes all it needs. Its own lines follow all that it includes, so
# what it includes may be precompiled: that declares nothing for it which it does not ask for. The
# headers that it includes are checked by themselves.
set(CULM_CHECK_PRECOMPILED culm/math/types.hpp culm/model/model.hpp culm/assembly/system.hpp)

macro(culm_add_header_check name)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers})
  add_custom_target(culm_${name}_headers)
  set(units_alone)
  foreach(shared IN LISTS CULM_CHECK_PRECOMPILED)
    set(units_${shared})
  endforeach()
  foreach(header IN LISTS headers)
    file(RELATIVE_PATH path ${folder}/include ${header})
    string(REPLACE "/" "_" unit ${path})
    set(unit ${CMAKE_CURRENT_BINARY_DIR}/headers/${unit}.cpp)
    file(CONFIGURE OUTPUT ${unit} CONTENT "#include <${path}>\n")
    culm_find_included(${path} included)
    set(with alone)
    foreach(shared IN LISTS CULM_CHECK_PRECOMPILED)
      if(shared IN_LIST included)
        set(with ${shared})
      endif()
    endforeach()
    list(APPEND units_${with} ${unit})
  endforeach()
  foreach(with alone ${CULM_CHECK_PRECOMPILED})
    if(units_${with})
      string(MAKE_C_IDENTIFIER culm_${name}_headers_${with} part)
      add_library(${part} OBJECT EXCLUDE_FROM_ALL ${units_${with}})
      target_link_libraries(${part} PRIVATE ${target})
      target_compile_options(${part} PRIVATE -O0)
      culm_finish_target(${part})
      if(NOT with STREQUAL alone)
        set_property(GLOBAL PROPERTY CULM_${with}_PRECOMPILE <${with}>)
        culm_precompile(${part} ${with} HEADERS)
      endif()
      add_dependencies(culm_${name}_headers ${part})
    endif()
  endforeach()
endmacro()

# The headers of culm that one includes before its first own line, itself or through others.
function(culm_find_included header result)
  get_property(known GLOBAL PROPERTY CULM_${header}_INCLUDED SET)
  get_property(found GLOBAL PROPERTY CULM_${header}_INCLUDED)
  if(NOT known)
    string(REGEX REPLACE "^culm/([^/]+)/.*" "\\1" package ${header})
    file(READ ${PROJECT_SOURCE_DIR}/packages/${package}/include/${header} text)
    string(REGEX MATCH "^((//[^\n]*|#pragma once|#include[^\n]*)?\n)*" text "${text}")
    string(REGEX MATCHALL "\n#include <culm/[^>]+" includes "${text}")
    foreach(include IN LISTS includes)
      string(REGEX REPLACE ".*<" "" include "${include}")
      culm_find_included(${include} further)
      list(APPEND found ${include} ${further})
    endforeach()
    list(REMOVE_DUPLICATES found)
    set_property(GLOBAL PROPERTY CULM_${header}_INCLUDED "${found}")
  endif()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# Makes `find_package(culm)` work after `cmake --install`.
function(culm_install_config)
  get_property(CULM_PACKAGES GLOBAL PROPERTY CULM_PACKAGES)
  if(NOT CULM_PACKAGES)
    return()
  endif()
  set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/culm)
  install(EXPORT culmTargets NAMESPACE culm:: DESTINATION ${destination} COMPONENT development)
  configure_package_config_file(
    ${PROJECT_SOURCE_DIR}/cmake/culmConfig.cmake.in ${PROJECT_BINARY_DIR}/culmConfig.cmake
    INSTALL_DESTINATION ${destination}
  )
  write_basic_package_version_file(
    ${PROJECT_BINARY_DIR}/culmConfigVersion.cmake COMPATIBILITY SameMinorVersion
  )
  install(FILES ${PROJECT_BINARY_DIR}/culmConfig.cmake ${PROJECT_BINARY_DIR}/culmConfigVersion.cmake
                ${PROJECT_SOURCE_DIR}/cmake/CulmDependencies.cmake DESTINATION ${destination}
          COMPONENT development
  )
endfunction()
