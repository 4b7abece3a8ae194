#include <culm/parallel/mpi_session.hpp>

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace culm::parallel {
namespace {

// Whether MPI was started here and not by the program that culm is a part of.
bool& is_ours() {
  static bool ours = false;
  return ours;
}

void expect_single_process() {
  constexpr int keep = 0;
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
  ::setenv("OMPI_MCA_pml", "ob1", keep);
  ::setenv("OMPI_MCA_btl", "self", keep);
  // displays and PCI devices, and how messages of many would best be gathered, need not be known
  ::setenv("HWLOC_COMPONENTS", "-gl,-pci,-linuxio,-x86", keep);
  ::setenv("HWLOC_PLUGINS_PATH", "/nonexistent", keep);
  ::setenv("OMPI_MCA_coll", "^adapt,han,monitoring,sm,sync,tuned", keep);
  // all such processes would share one folder, and the first to end would remove it
  ::setenv("OMPI_MCA_orte_create_session_dirs", "0", keep);
  // made for many processes; each call would wait for a turn on a busy machine
  constexpr int replace = 1;
  ::setenv("OMPI_MCA_mpi_yield_when_idle", "0", replace);
}

}  // namespace

bool was_launched(const char* const* environment) {
  // mpiexec of Open MPI and what speaks PMIx; MPICH, Intel MPI and what speaks PMI; srun. The step
  // tells srun from the script of a batch job, which is a process like any other.
  constexpr std::array<std::string_view, 5> marks = {"OMPI_COMM_WORLD_", "PMIX_", "PMI_",
                                                     "OMPI_MCA_orte_ess_", "SLURM_STEP_ID="};
  for (; *environment != nullptr; ++environment) {
    const std::string_view variable = *environment;
    if (std::ranges::any_of(marks, [&](auto mark) { return variable.starts_with(mark); })) {
      return true;
    }
  }
  return false;
}

bool is_mpi_running() {
  int has_started = 0, has_ended = 0;
  MPI_Initialized(&has_started);
  MPI_Finalized(&has_ended);
  return has_started != 0 && has_ended == 0;
}

void start_mpi() {
  if (is_mpi_running()) return;
  if (!was_launched(environ)) expect_single_process();
  MPI_Init(nullptr, nullptr);
  is_ours() = true;
}

MpiSession::MpiSession() {
  if (was_launched(environ)) start_mpi();
}

MpiSession::~MpiSession() {
  if (std::exchange(is_ours(), false) && is_mpi_running()) MPI_Finalize();
}

}  // namespace culm::parallel
