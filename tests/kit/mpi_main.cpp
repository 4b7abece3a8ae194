// Entry point of unit tests that may use MPI, on one process or, under mpiexec, on several.

#include <culm/parallel/mpi_session.hpp>

#include <gtest/gtest.h>
#include <mpi.h>

// Only packages that link Tpetra see its headers; it starts Kokkos as well.
#if __has_include(<Tpetra_Core.hpp>)
#include <Tpetra_Core.hpp>
#endif

int main(int argc, char** argv) {
  const culm::parallel::MpiSession session;
  culm::parallel::start_mpi();
  ::testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);

  int failed = 0;
  {
#if __has_include(<Tpetra_Core.hpp>)
    const Tpetra::ScopeGuard scope(&argc, &argv);
#endif
    if (rank != 0) {
      // One report is enough; a failure elsewhere still names its rank and ends the run.
      ::testing::GTEST_FLAG(brief) = true;
    }
    failed = RUN_ALL_TESTS();
  }
  int failed_anywhere = 0;
  MPI_Allreduce(&failed, &failed_anywhere, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return failed_anywhere;
}
