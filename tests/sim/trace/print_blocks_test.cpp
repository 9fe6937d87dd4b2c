#include "sim/trace/prints/print_blocks.h"

#include <gtest/gtest.h>

namespace sim {
namespace {

std::vector<float> Middles(int count, float step_m) {
  std::vector<float> places_m;
  for (int i = 0; i < count; ++i) places_m.push_back((static_cast<float>(i) + 0.5F) * step_m);
  return places_m;
}

/// By place of the grid: the bits of its block's draw, 0 where there is none.
std::vector<std::uint64_t> BlockOfEach(const PrintGrid& grid,
                                       const std::vector<PrintBlock>& blocks) {
  std::vector<std::uint64_t> of_place(grid.size(), 0);
  for (const PrintBlock& block : blocks) {
    block.ForEachPlace(grid, [&](std::size_t own, std::size_t place) {
      EXPECT_EQ(of_place[place], 0u) << "in two blocks";
      of_place[place] = block.draw.bits;
      const float x_m = block.x_m[own % block.x_m.size()],
                  y_m = block.y_m[own / block.x_m.size()];
      EXPECT_TRUE(x_m >= 0 && x_m < block.size_m.x());
      EXPECT_TRUE(y_m >= 0 && y_m < block.size_m.y());
    });
  }
  return of_place;
}

TEST(PrintBlocks, HoldEachPlaceOnce) {
  const auto x_m = Middles(200, 0.001F), y_m = Middles(280, 0.001F);
  const PrintGrid grid{x_m, y_m};
  const auto blocks = BlocksOf(grid, {0.2F, 0.28F}, 0.03F, 5);
  EXPECT_GT(blocks.size(), 3u);
  for (const std::uint64_t bits : BlockOfEach(grid, blocks)) EXPECT_NE(bits, 0u);
}

// Textures are baked band by band.
TEST(PrintBlocks, OfARowAreThoseOfTheWholeFace) {
  const auto x_m = Middles(200, 0.001F), y_m = Middles(280, 0.001F);
  const PrintGrid grid{x_m, y_m};
  const auto whole = BlockOfEach(grid, BlocksOf(grid, {0.2F, 0.28F}, 0.03F, 5));
  for (std::size_t v = 0; v < y_m.size(); v += 7) {
    const PrintGrid row{x_m, {&y_m[v], 1}};
    const auto alone = BlockOfEach(row, BlocksOf(row, {0.2F, 0.28F}, 0.03F, 5));
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(),
                           whole.begin() + static_cast<std::ptrdiff_t>(v * x_m.size())));
  }
}

TEST(PrintBlocks, InsideOfARimLeaveItOut) {
  const auto x_m = Middles(100, 0.001F), y_m = Middles(60, 0.001F);
  const PrintGrid grid{x_m, y_m};
  const auto of_place = BlockOfEach(grid, BlocksInside(grid, {0.1F, 0.06F}, 0.012F, 0.06F, 9));
  for (std::size_t i = 0; i < of_place.size(); ++i) {
    const std::size_t u = i % 100, v = i / 100;
    const bool inside = u >= 12 && u < 88 && v >= 12 && v < 48;
    EXPECT_EQ(of_place[i] != 0, inside) << u << " " << v;
  }
  EXPECT_TRUE(BlocksInside({{x_m.data(), 5}, y_m}, {0.1F, 0.06F}, 0.012F, 0.06F, 9).empty());
}

}  // namespace
}  // namespace sim
