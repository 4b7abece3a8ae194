#include <culm/parallel/comm.hpp>
#include <culm/parallel/mpi_session.hpp>

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

namespace culm::parallel {
namespace {

TEST(MpiSession, LaunchersLeaveTheirMarks) {
  for (const char* mark : {"OMPI_COMM_WORLD_SIZE=1", "PMIX_RANK=0", "PMI_RANK=3", "PMI_FD=5",
                           "OMPI_MCA_orte_ess_num_procs=2", "SLURM_STEP_ID=0"}) {
    const char* environment[] = {"HOME=/root", mark, nullptr};
    EXPECT_TRUE(was_launched(environment)) << mark;
  }
}

TEST(MpiSession, OptionsOfUsersAndBatchJobsAreNone) {
  const char* environment[] = {"HOME=/root",
                               "OMPI_MCA_btl=self",
                               "OMPI_ALLOW_RUN_AS_ROOT=1",
                               "SLURM_JOB_ID=17",
                               "SLURM_PROCID=0",
                               "MY_PMIX_RANK_IS=12",
                               nullptr};
  EXPECT_FALSE(was_launched(environment));
}

// mpi_main.cpp starts MPI in this program, as culm does.
TEST(MpiSession, IsIsolatedWhereThereIsNoLauncher) {
  ASSERT_TRUE(is_mpi_running());
  const char* isolated = std::getenv("OMPI_MCA_ess_singleton_isolated");
  EXPECT_EQ(isolated != nullptr, Comm().size() == 1);
}

TEST(MpiSession, NeverYields) {
  if (was_launched(environ)) GTEST_SKIP() << "one of several";
  EXPECT_STREQ(std::getenv("OMPI_MCA_mpi_yield_when_idle"), "0");
}

}  // namespace
}  // namespace culm::parallel
