#pragma once

#include <cstddef>
#include <cstdint>

namespace slam {

/// A set of pixels of a block: column by column, a bit for each of its size x size. That of a
/// block of 8 x 8 is one word with a column in each byte.
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

}  // namespace slam
