#pragma once

/// Before a function: built for AVX2 and for any x86-64; whichever the processor has is called.
/// IEEE operations on the same numbers, never fused (-ffp-contract=off), so the bits are the
/// same. For sources that CMake's pas_lanes names. Clang builds for any x86-64 alone, as it
/// wants such functions declared so too; sanitizers cannot start with them.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SLAM_LANES __attribute__((target_clones("avx2", "default")))
#else
#define SLAM_LANES
#endif

/// For what SLAM_LANES functions call: built with each of them.
#define SLAM_INLINE [[gnu::always_inline]] inline
