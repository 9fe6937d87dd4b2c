#include "slam/faces/line_support.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/base/random.h"

namespace slam {
namespace {

/// Points about a line, and some exactly as far from it as the strip goes.
std::vector<Eigen::Vector2d> Points(int count, Random& random) {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < count; ++k) {
    const double y = k % 5 == 0 ? 12.0 : 10.0 + 4.0 * (random.Uniform() - 0.5);
    points.emplace_back(100.0 * random.Uniform(), k % 7 == 0 ? 40.0 : y);
  }
  return points;
}

TEST(LineSupport, IsWhatPointByPointIsFound) {
  Random random{1};
  const LineStrip level{3.0, 10.0, 1.0, 0.0, 2.0};  // y from 8 to 12, both excluded
  const LineStrip slanted{50.0, 10.0, std::cos(0.1), std::sin(0.1), 1.0};
  for (int count = 0; count < 150; ++count) {
    const std::vector<Eigen::Vector2d> points = Points(count, random);
    PointColumns columns;
    columns.Set(points);
    for (const LineStrip& strip : {level, slanted}) {
      std::vector<int> expected, near{7};
      for (int k = 0; k < count; ++k) {
        const Eigen::Vector2d d =
            points[static_cast<std::size_t>(k)] - Eigen::Vector2d(strip.p_x, strip.p_y);
        if (std::abs(strip.v_x * d.y() - strip.v_y * d.x()) < strip.max_distance)
          expected.push_back(k);
      }
      FindNear(columns, strip, near);
      EXPECT_EQ(near, expected);
      const int support = static_cast<int>(expected.size());
      for (int beat = 0; beat <= count; ++beat) {
        const int counted = CountUnlessFewer(columns, strip, beat);
        if (support > beat) {
          EXPECT_EQ(counted, support) << "of " << count << ", to beat " << beat;
        } else {
          EXPECT_LE(counted, beat) << "of " << count << ", to beat " << beat;
        }
      }
    }
  }
}

}  // namespace
}  // namespace slam
