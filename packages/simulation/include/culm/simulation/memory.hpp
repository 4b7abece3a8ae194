/// How much memory a run may take.
#pragma once

#include <culm/parallel/comm.hpp>

#include <string>

namespace culm::simulation {

/// The memory of this machine, or what the operating system leaves of it to so many processes that
/// have the same limits [B].
double machine_memory(int processes = 1);

/// Reads --max-memory: a number with kB, MB, GB or TB; machine_memory(processes) if the text is
/// empty. Throws UsageError.
double read_memory(const std::string& text, int processes = 1);

/// The least that any rank may take, on all of them: what is decided by memory is decided alike
/// where machines or limits differ; collective. @param bytes  of this rank [B]
double least_memory(double bytes, const parallel::Comm& comm);

/// Lets what would take more memory fail in this process with std::bad_alloc, before the system
/// begins to end processes; the limit is 1 GB at least. @param bytes  [B]
void limit_memory(double bytes);

}  // namespace culm::simulation
