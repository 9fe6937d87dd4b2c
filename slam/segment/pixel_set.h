#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace slam {

/// A set of pixels of a block: column by column, a bit for each of its size x size. That of a
/// block of 8 x 8, the usual, is one word with a column in each byte.
using PixelSet = std::uint64_t*;
using ConstPixelSet = const std::uint64_t*;

constexpr std::size_t WordsOfSet(int size) {
  return (static_cast<std::size_t>(size * size) + 63) / 64;
}

inline bool IsInSet(ConstPixelSet set, int size, int u, int v) {
  const auto k = static_cast<unsigned>(u * size + v);
  return (set[k / 64] >> (k % 64) & 1) != 0;
}

inline void PutInSet(PixelSet set, int size, int u, int v) {
  const auto k = static_cast<unsigned>(u * size + v);
  set[k / 64] |= std::uint64_t{1} << (k % 64);
}

inline bool IsEmpty(ConstPixelSet set, std::size_t words) {
  std::uint64_t any = set[0];
  for (std::size_t k = 1; k < words; ++k) any |= set[k];
  return any == 0;
}

/// Whether two sets share a pixel.
inline bool Meet(ConstPixelSet a, ConstPixelSet b, std::size_t words) {
  std::uint64_t both = a[0] & b[0];
  for (std::size_t k = 1; k < words; ++k) both |= a[k] & b[k];
  return both != 0;
}

inline void Copy(ConstPixelSet from, PixelSet to, std::size_t words) {
  to[0] = from[0];
  for (std::size_t k = 1; k < words; ++k) to[k] = from[k];
}

/// Takes the pixels of one set out of another.
inline void TakeOut(ConstPixelSet what, PixelSet from, std::size_t words) {
  from[0] &= ~what[0];
  for (std::size_t k = 1; k < words; ++k) from[k] &= ~what[k];
}

inline int CountOf(ConstPixelSet set, std::size_t words) {
  int count = std::popcount(set[0]);
  for (std::size_t k = 1; k < words; ++k) count += std::popcount(set[k]);
  return count;
}

inline int CountOfBoth(ConstPixelSet a, ConstPixelSet b, std::size_t words) {
  int count = std::popcount(a[0] & b[0]);
  for (std::size_t k = 1; k < words; ++k) count += std::popcount(a[k] & b[k]);
  return count;
}

}  // namespace slam
