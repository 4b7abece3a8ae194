/// A process that nobody launched as one of several.
#pragma once

namespace culm::parallel {

/// Whether a launcher (mpiexec, srun, another process manager) started this process as one of a
/// group, by the names of variables that launchers set.
/// @param environment  as `environ`: "NAME=value", closed by a null pointer
bool was_launched(const char* const* environment);

/// To be called before MPI starts. Open MPI gives a process that was not launched a server of its
/// own and looks for networks and devices, which takes longer than a small run; alone it needs
/// none. Does nothing in a launched process, and nothing that the user's environment says
/// otherwise, but for one thing: it never yields while it asks for messages, as MUMPS does, because
/// nobody can send any.
void expect_single_process();

}  // namespace culm::parallel
