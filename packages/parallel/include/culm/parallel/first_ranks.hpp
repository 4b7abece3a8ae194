#pragma once

#include <culm/parallel/comm.hpp>

namespace culm::parallel {

/// The first ranks of all that were started together, where others belong to another program.
/// Called by these ranks only. Throws UsageError if there are not so many, or all of them.
Comm first_ranks(int count);

}  // namespace culm::parallel
