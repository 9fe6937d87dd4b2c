#include "sim/trace/prints/print_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

std::vector<float> Growing(Random& random, std::size_t count, double low, double high) {
  std::vector<float> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back(static_cast<float>(random.Between(low, high)));
  }
  std::sort(places.begin(), places.end());
  return places;
}

std::vector<float> Even(std::size_t count, float first, float step) {
  std::vector<float> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back(first + (static_cast<float>(i) + 0.5F) * step);
  }
  return places;
}

/// What Flecks stands for: every ellipse of the nine cells about the place, none left out.
float AllFlecks(float x_m, float y_m, const FleckPattern& pattern, std::uint64_t seed) {
  const float qx = x_m / (pattern.pitch_m * pattern.stretch), qy = y_m / pattern.pitch_m;
  const int x = FloorOf(qx), y = FloorOf(qy);
  const float fx = qx - static_cast<float>(x), fy = qy - static_cast<float>(y);
  float inside = -1;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const CellDraw draw(x + i, y + j, seed);
      if (!(draw[0] < pattern.density)) continue;
      const float dx = fx - static_cast<float>(i) - draw[1];
      const float dy = fy - static_cast<float>(j) - draw[2];
      inside = std::max(inside, 0.16F + 0.3F * draw[3] - std::sqrt(dx * dx + dy * dy));
    }
  }
  return std::clamp(inside / 0.12F + 0.5F, 0.0F, 1.0F);
}

struct Shares {
  int bare = 0, soft = 0, covered = 0;
};

void ExpectAllFlecks(const PrintGrid& grid, const FleckPattern& pattern, std::uint64_t seed,
                     Shares& shares) {
  const std::vector<float> found = Flecks(grid, pattern, seed);
  ASSERT_EQ(found.size(), grid.size());
  std::size_t i = 0;
  for (const float y_m : grid.y_m) {
    for (const float x_m : grid.x_m) {
      ASSERT_EQ(found[i], AllFlecks(x_m, y_m, pattern, seed))
          << x_m << " " << y_m << " seed " << seed;
      (found[i] == 0 ? shares.bare : found[i] == 1 ? shares.covered : shares.soft) += 1;
      ++i;
    }
  }
}

// The very bits, of a texture's even places and of any others.
TEST(Flecks, AreThoseOfAllCellsAbout) {
  Shares shares;
  Random random{0x666c65636b};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const FleckPattern pattern{static_cast<float>(random.Between(0.005, 0.09)),
                               static_cast<float>(random.Between(0.1, 0.5)),
                               static_cast<float>(random.Between(1, 3))};
    const auto x_m = Even(150, 0, 0.00076F), y_m = Even(16, 0.3F, 0.00076F);
    ExpectAllFlecks({x_m, y_m}, pattern, seed, shares);
    const auto any_x_m = Growing(random, 60, -0.5, 0.5), any_y_m = Growing(random, 9, -1, 1);
    ExpectAllFlecks({any_x_m, any_y_m}, pattern, seed, shares);
  }
  for (const int count : {shares.bare, shares.soft, shares.covered}) EXPECT_GT(count, 5000);
}

TEST(Flecks, OfNoPlaceAreNone) {
  const std::vector<float> none, one{0.1F};
  EXPECT_TRUE(Flecks({none, one}, {0.01F, 0.3F, 1.0F}, 1).empty());
  EXPECT_TRUE(Flecks({one, none}, {0.01F, 0.3F, 1.0F}, 1).empty());
}

// A place has one value, whatever the grid it is asked in.
TEST(PrintPatterns, HangOnThePlaceAlone) {
  Random random{0x706c616365};
  const auto x_m = Growing(random, 40, 0, 0.3), y_m = Growing(random, 30, 0, 0.3);
  const PrintGrid grid{x_m, y_m};
  const auto noise = ValueNoise(grid, {60.0F, 500.0F}, 7);
  const auto ink = TextInk(grid, 0.02F, 0.3F, 7);
  EXPECT_GT(std::count(ink.begin(), ink.end(), 1.0F), 50);
  std::size_t i = 0;
  for (const float& y : y_m) {
    for (const float& x : x_m) {
      const PrintGrid place{{&x, 1}, {&y, 1}};
      ASSERT_EQ(noise[i], ValueNoise(place, {60.0F, 500.0F}, 7)[0]);
      ASSERT_EQ(ink[i], TextInk(place, 0.02F, 0.3F, 7)[0]);
      ++i;
    }
  }
}

}  // namespace
}  // namespace sim
