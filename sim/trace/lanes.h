#pragma once

/// Before a function: built for AVX2 and for any x86-64, whichever the processor has is called.
/// IEEE operations on the same numbers, never fused (-ffp-contract=off), so the bits are the
/// same. For sources that CMake's pas_lanes names. Sanitizers cannot start with such functions.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SIM_LANES
#endif
#endif
#if !defined(SIM_LANES)
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SIM_LANES __attribute__((target_clones("avx2", "default")))
#else
#define SIM_LANES
#endif
#endif
