/// What becomes of memory that is not needed any more.
#pragma once

namespace culm {

enum class FreedMemory {
  given_back,  ///< to the system, so that what is needed once, to build a model, is not kept
  kept,        ///< for the next who asks, as in steps, of which each needs what the last one did
};

/// From now on, for large pieces of the whole program.
void set_freed_memory(FreedMemory use);

}  // namespace culm
