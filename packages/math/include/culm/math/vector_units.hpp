/// Functions that are compiled for each kind of vector unit.
#pragma once

/// Before a function whose loops gain from wide vectors: it is compiled several times, and the
/// program takes the version for the widest vectors that the processor has. What it calls has to be
/// inlined into it (`gnu::always_inline`), or stays compiled for the least processor. Results
/// differ by rounding from one processor to another.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define CULM_FOR_EACH_VECTOR_UNIT \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define CULM_FOR_EACH_VECTOR_UNIT
#endif
