# Manual, completion of command lines, and the packages that `cpack` makes: culm, the program, and
# culm-dev, the libraries to build other programs with.

# The program writes them, when it is installed. The prefix may be another one then.
string(CONFIGURE [[
  set(share "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/@CMAKE_INSTALL_DATADIR@")
  set(manual "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/@CMAKE_INSTALL_MANDIR@/man1")
  message(STATUS "Installing: manual and completion")
  file(MAKE_DIRECTORY ${share}/bash-completion/completions ${share}/zsh/vendor-completions)
  execute_process(COMMAND $<TARGET_FILE:culm> manual ${manual} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND $<TARGET_FILE:culm> completion bash
                  OUTPUT_FILE ${share}/bash-completion/completions/culm COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND $<TARGET_FILE:culm> completion zsh
                  OUTPUT_FILE ${share}/zsh/vendor-completions/_culm COMMAND_ERROR_IS_FATAL ANY)
]] write_manual @ONLY)
install(CODE "${write_manual}")
# Debian's Python finds the package `culm` by this file.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/culm.pth
     CONTENT "../../../${CMAKE_INSTALL_DATADIR}/culm/python\n")
install(FILES ${PROJECT_BINARY_DIR}/culm.pth DESTINATION lib/python3/dist-packages)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME culm)
set(CPACK_PACKAGE_CONTACT "culm developers <culm@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME culm)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "nonlinear dynamics of slender structures
 Statics and dynamics of geometrically exact beams, multilayer shells and rigid
 bodies, by the program culm, its module for Python and its library for C."
)
# The reference BLAS, which Trilinos would take as well, is three to four times slower.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS
    "openmpi-bin, libopenblas0-serial, python3 (>= 3.11), python3-numpy, python3-h5py, python3-matplotlib, \
python3-pandas, python3-scipy, python3-yaml, libjs-three"
)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME culm-dev)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "nonlinear dynamics of slender structures: libraries
 Headers and static libraries of culm, for programs in C++, with their CMake files."
)
# The libraries that culm is built with, but for those of its tests.
execute_process(
  COMMAND ${PROJECT_SOURCE_DIR}/tools/dependencies --list
  OUTPUT_VARIABLE libraries OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY
)
string(REPLACE "\n" ";" libraries "${libraries}")
list(FILTER libraries INCLUDE REGEX "^(lib|zlib).*-dev$")
list(FILTER libraries EXCLUDE REGEX "gtest|gmock|benchmark")
list(JOIN libraries ", " libraries)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "culm (= ${PROJECT_VERSION}), build-essential, cmake, pkg-config, ${libraries}"
)
include(CPack)
