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

namespace slam {

/// Eight numbers that one instruction works on where the processor can, and four doubles. They
/// are read and written anywhere in an array (no alignment), by Lanes(p).
inline constexpr int kLanes = 8;
using FloatLanes = float __attribute__((vector_size(32), aligned(4), may_alias));
using IntLanes = int __attribute__((vector_size(32), aligned(4), may_alias));
using DoubleLanes = double __attribute__((vector_size(32), aligned(8), may_alias));

/// For what SLAM_LANES functions call: built with each of them.
#define SLAM_INLINE [[gnu::always_inline]] inline

inline FloatLanes& Lanes(float* p) { return *reinterpret_cast<FloatLanes*>(p); }
inline const FloatLanes& Lanes(const float* p) {
  return *reinterpret_cast<const FloatLanes*>(p);
}
inline IntLanes& Lanes(int* p) { return *reinterpret_cast<IntLanes*>(p); }
inline const IntLanes& Lanes(const int* p) { return *reinterpret_cast<const IntLanes*>(p); }
inline DoubleLanes& Lanes(double* p) { return *reinterpret_cast<DoubleLanes*>(p); }
inline const DoubleLanes& Lanes(const double* p) {
  return *reinterpret_cast<const DoubleLanes*>(p);
}

}  // namespace slam
