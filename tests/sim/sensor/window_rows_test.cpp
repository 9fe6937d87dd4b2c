#include "sim/sensor/depth/window_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/base/random.h"

namespace sim {
namespace {

constexpr int kReach = 4, kWidth = 29, kHeight = 17;

/// Few surfaces, disparities near each other's and holes, so that every comparison goes both ways.
struct RandomView {
  explicit RandomView(std::uint64_t seed) {
    Random random{0x77696e, seed};
    view.stride = kWidth + 2 * kReach + WindowCounts::kWindows;
    view.max_apart_steps = 16;
    steps.assign(static_cast<std::size_t>(view.stride * (kHeight + 2 * kReach)), 0.0F);
    surface.assign(steps.size(), 0);
    const std::ptrdiff_t first = kReach * view.stride + kReach;
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const auto at = static_cast<std::size_t>(first + v * view.stride + u);
        if (random.Chance(0.2)) continue;
        steps[at] = static_cast<float>(200 + 4 * random.Below(12));
        surface[at] = random.Below(3) == 0 ? -7 : random.Below(4);
      }
    }
    view.steps = steps.data() + first;
    view.surface = surface.data() + first;
  }
  std::vector<float> steps;
  std::vector<std::int32_t> surface;
  MatchView view;
};

TEST(CountWindows, CountsWhatALoopOverEachWindowDoes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const RandomView random(seed);
    const MatchView& view = random.view;
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const std::ptrdiff_t own = v * view.stride + u;
        int same = 0, nearer = 0;
        for (int y = std::max(v - kReach, 0); y <= std::min(v + kReach, kHeight - 1); ++y) {
          for (int x = std::max(u - kReach, 0); x <= std::min(u + kReach, kWidth - 1); ++x) {
            const std::ptrdiff_t at = y * view.stride + x;
            const float apart = view.steps[at] - view.steps[own];
            const bool match = view.surface[at] == view.surface[own] || std::abs(apart) <= 16;
            same += view.steps[at] > 0 && match ? 1 : 0;
            nearer += apart > 16 ? 1 : 0;
          }
        }
        const int first = u / WindowCounts::kWindows * WindowCounts::kWindows;
        const WindowCounts counts = CountWindows(view, first, v, kReach);
        const auto i = static_cast<std::size_t>(u - first);
        ASSERT_EQ(counts.same[i], same) << "seed " << seed << ", " << u << " " << v;
        ASSERT_EQ(counts.nearer[i], nearer) << "seed " << seed << ", " << u << " " << v;
      }
    }
  }
}

TEST(MarkApart, TellsBordersOfSurfacesAndOfHoles) {
  const float steps[] = {100, 116, 117, 0, 0, 300, 300};
  const std::int32_t surface[] = {1, 2, 3, 4, 5, 6, 6};
  const MatchView view{steps, surface, 0, 16};
  std::uint8_t apart[6] = {};
  MarkApart(view, 0, 1, 6, apart);
  EXPECT_EQ(apart[0], 0);  // 16 steps match as one
  EXPECT_EQ(apart[1], 0);
  EXPECT_EQ(apart[2], 255);  // a hole's rim
  EXPECT_EQ(apart[3], 0);    // both show nothing
  EXPECT_EQ(apart[4], 255);
  EXPECT_EQ(apart[5], 0);
  MarkApart(view, 0, 2, 1, apart);
  EXPECT_EQ(apart[0], 255);  // 17 steps do not
  MarkApart(view, 0, 1, 1, apart);
  EXPECT_EQ(apart[0], 255);  // what is marked stays so
}

}  // namespace
}  // namespace sim
