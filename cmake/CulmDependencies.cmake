# Everything culm takes from outside, each as one target culm_external::<Name>. Packages name them
# in EXTERNAL or PRIVATE. The targets are imported, so their headers count as system headers; the
# file is also installed and read by culmConfig.cmake, so users find exactly the same things.

find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Spectra 1.0 REQUIRED NO_MODULE)
find_package(Boost REQUIRED)  # headers only
set(MPI_CXX_SKIP_MPICXX ON)  # the C++ bindings left the standard; their headers only cost time
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(LibXml2 REQUIRED)
find_package(muparser REQUIRED)
find_package(ZLIB REQUIRED)
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(Trilinos REQUIRED COMPONENTS Teuchos Kokkos Tpetra NOX Amesos2 Anasazi Belos)

# METIS and MUMPS bring no CMake files.
find_path(CULM_METIS_INCLUDE_DIR metis.h REQUIRED)
find_library(CULM_METIS_LIBRARY metis REQUIRED)
find_path(CULM_MUMPS_INCLUDE_DIR dmumps_c.h REQUIRED)
find_library(CULM_MUMPS_LIBRARY dmumps REQUIRED)
mark_as_advanced(
  CULM_METIS_INCLUDE_DIR CULM_METIS_LIBRARY CULM_MUMPS_INCLUDE_DIR CULM_MUMPS_LIBRARY
)

function(culm_external name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "INCLUDE;LINK")
  if(NOT TARGET culm_external::${name})
    add_library(culm_external::${name} INTERFACE IMPORTED GLOBAL)
    target_include_directories(culm_external::${name} INTERFACE ${arg_INCLUDE})
    target_link_libraries(culm_external::${name} INTERFACE ${arg_LINK})
  endif()
endfunction()

culm_external(fmt LINK fmt::fmt)
culm_external(spdlog LINK spdlog::spdlog)
culm_external(Eigen LINK Eigen3::Eigen)
culm_external(Spectra LINK Spectra::Spectra)
culm_external(Boost LINK Boost::headers)
culm_external(MPI LINK MPI::MPI_CXX)
culm_external(LibXml2 LINK LibXml2::LibXml2)
culm_external(muparser LINK muparser::muparser)
culm_external(ZLIB LINK ZLIB::ZLIB)
# Debian's shared HDF5 brings curl, Kerberos and LDAP, which culm never calls. So programs, which start often,
# take its archive where there is one; that cannot be part of a shared object.
get_filename_component(culm_hdf5_folder "${HDF5_C_LIBRARY_hdf5}" DIRECTORY)
find_library(CULM_HDF5_ARCHIVE libhdf5.a PATHS ${culm_hdf5_folder} NO_DEFAULT_PATH)
mark_as_advanced(CULM_HDF5_ARCHIVE)
set(culm_hdf5 hdf5::hdf5)
if(CULM_HDF5_ARCHIVE AND HDF5_C_LIBRARY_sz)
  set(culm_program "$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>")
  set(culm_hdf5 "$<$<NOT:${culm_program}>:hdf5::hdf5>" "$<${culm_program}:${CULM_HDF5_ARCHIVE}>"
      "$<${culm_program}:${HDF5_C_LIBRARY_sz}>" "$<${culm_program}:ZLIB::ZLIB>"
  )
endif()
culm_external(HDF5 INCLUDE ${HDF5_C_INCLUDE_DIRS} LINK ${culm_hdf5} MPI::MPI_CXX)
culm_external(METIS INCLUDE ${CULM_METIS_INCLUDE_DIR} LINK ${CULM_METIS_LIBRARY})
culm_external(MUMPS INCLUDE ${CULM_MUMPS_INCLUDE_DIR} LINK ${CULM_MUMPS_LIBRARY} MPI::MPI_CXX)

# The targets of Trilinos carry no include directories. --as-needed keeps the many libraries that
# they name, but a program never calls, out of its start-up.
set(culm_trilinos_include ${Trilinos_INCLUDE_DIRS} ${Trilinos_TPL_INCLUDE_DIRS})
list(REMOVE_ITEM culm_trilinos_include /usr/include)
culm_external(
  Teuchos
  INCLUDE ${culm_trilinos_include}
  LINK -Wl,--as-needed trilinos_teuchosparameterlist trilinos_teuchosparser trilinos_teuchoscore
)
culm_external(Tpetra LINK culm_external::Teuchos trilinos_tpetra MPI::MPI_CXX)
culm_external(Amesos2 LINK culm_external::Tpetra trilinos_amesos2)
culm_external(NOX LINK culm_external::Tpetra trilinos_nox)
culm_external(Anasazi LINK culm_external::Tpetra trilinos_anasazitpetra trilinos_anasazi)
culm_external(Belos LINK culm_external::Tpetra trilinos_belostpetra trilinos_belos)
