#include "sim/sensor/depth/kinect_rows.h"

#include <gtest/gtest.h>

#include <array>

namespace sim {
namespace {

TEST(KinectJitter, IsTheSameToEitherSide) {
  constexpr int kCount = 7;
  std::array<double, kCount> theta{};
  std::array<float, kCount> left{}, right{};
  for (int i = 0; i < kCount; ++i) {
    left[static_cast<std::size_t>(i)] = -0.4f * static_cast<float>(i);
    right[static_cast<std::size_t>(i)] = 0.4f * static_cast<float>(i);
  }
  std::array<int, kCount> du{}, dv{};
  KinectJitter(theta.data(), left.data(), right.data(), 1.0, kCount, du.data(), dv.data());
  // 0.8 px at normal incidence: 0, 0.32, 0.64, 0.96, 1.28, 1.6 and 1.92 px.
  EXPECT_EQ(dv, (std::array<int, kCount>{0, 0, 1, 1, 1, 2, 2}));
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(du[i], -dv[i]) << i;
}

}  // namespace
}  // namespace sim
