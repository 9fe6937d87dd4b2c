#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/random.h"

namespace sim {

/// What prints are made of: random patterns that hang on a place and a seed alone, worked out for
/// the places of a grid at once, row by row. Lengths are metres on the face.

/// Places on a face: each x with each y, both growing.
struct PrintGrid {
  std::span<const float> x_m, y_m;
  std::size_t size() const { return x_m.size() * y_m.size(); }
};

/// Four uniform numbers in [0, 1) of a grid cell.
struct CellDraw {
  explicit CellDraw(int x, int y, std::uint64_t seed)
      : bits(MixBits(MixBits(seed + 1) ^
                     ((static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
                      static_cast<std::uint32_t>(y)) *
                         kGoldenRatio)) {}
  float operator[](int i) const {
    return static_cast<float>(bits >> (16 * i) & 0xFFFF) * (1.0F / 65536.0F);
  }
  std::uint64_t bits;
};

/// The whole number below x, which an int must hold.
inline int FloorOf(float x) {
  const int whole = static_cast<int>(x);
  return static_cast<float>(whole) > x ? whole - 1 : whole;
}

/// Smooth value noise in [0, 1], `cells_per_m` bumps a metre along x and y.
std::vector<float> ValueNoise(const PrintGrid& grid, const Eigen::Vector2f& cells_per_m,
                              std::uint64_t seed);

/// Random flecks: in each cell of `pitch_m` one ellipse with probability `density`, `stretch` times
/// as long in x as in y.
struct FleckPattern {
  float pitch_m, density, stretch;
};

/// Coverage by flecks, in [0, 1].
std::vector<float> Flecks(const PrintGrid& grid, const FleckPattern& pattern,
                          std::uint64_t seed);

/// A made-up letter: whether a stroke covers `q` of the unit square; bits choose the strokes.
bool Glyph(const Eigen::Vector2f& q, std::uint64_t bits);

/// Ink of running text: lines of words of letters, with ragged ends and paragraphs. 0 or 1.
std::vector<float> TextInk(const PrintGrid& grid, float line_m, float width_m,
                           std::uint64_t seed);

}  // namespace sim
