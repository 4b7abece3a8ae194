/// Start and end of MPI, which a process that nobody launched as one of several does without.
#pragma once

namespace culm::parallel {

/// Whether a launcher (mpiexec, srun, another process manager) started this process as one of a
/// group, by the names of variables that launchers set.
/// @param environment  as `environ`: "NAME=value", closed by a null pointer
bool was_launched(const char* const* environment);

/// Whether MPI has started and not ended.
bool is_mpi_running();

/// Starts MPI, unless it is running. In a process that was not launched Open MPI is told so, for
/// it would start a server and look for networks and devices, which takes longer than a small run:
/// nothing that the user's environment says is changed, but for one thing. Such a process never
/// yields while it asks for messages, as MUMPS does, because nobody can send any.
void start_mpi();

/// The time in which a program may use culm: MPI starts with it in a launched process, in others
/// not before it is needed (Comm::handle()), and what start_mpi() started ends with it.
class MpiSession {
 public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
};

}  // namespace culm::parallel
