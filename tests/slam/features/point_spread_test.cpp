#include "slam/features/point_spread.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/base/random.h"

namespace slam {
namespace {

std::vector<cv::KeyPoint> Scattered(int count, float width, float height) {
  Random random{3};
  std::vector<cv::KeyPoint> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(static_cast<float>(random.Uniform()) * width,
                        static_cast<float>(random.Uniform()) * height, 7.0f, -1.0f,
                        static_cast<float>(random.Below(200)));
  }
  return points;
}

TEST(PointSpread, KeepsAllWhenThereAreFew) {
  EXPECT_EQ(SpreadEvenly(Scattered(10, 100, 100), {0, 0, 100, 100}, 20).size(), 10u);
}

TEST(PointSpread, GivesTheNumberWantedOrTwoMore) {
  for (const int count : {1, 7, 100, 333}) {
    const auto kept = SpreadEvenly(Scattered(2000, 600, 400), {0, 0, 600, 400}, count);
    EXPECT_GE(static_cast<int>(kept.size()), count);
    EXPECT_LE(static_cast<int>(kept.size()), count + 2);
  }
}

TEST(PointSpread, IsTheSameWhereverTheAreaLies) {
  const auto kept = [](float x, float y) {
    std::vector<cv::KeyPoint> points = Scattered(1500, 600, 400);
    for (std::size_t k = 0; k < 300; ++k) points[k].pt.x *= 0.2f;  // a crowd on the left
    for (cv::KeyPoint& point : points) point.pt += cv::Point2f(x, y);
    auto spread =
        SpreadEvenly(points, {static_cast<int>(x), static_cast<int>(y), 600, 400}, 100);
    for (cv::KeyPoint& point : spread) point.pt -= cv::Point2f(x, y);
    return spread;
  };
  const auto here = kept(0, 0), there = kept(512, 256);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_LT(cv::norm(here[k].pt - there[k].pt), 1e-3) << k;
  }
}

TEST(PointSpread, ThinsOutACrowdAndLeavesTheLonelyOnes) {
  std::vector<cv::KeyPoint> points = Scattered(500, 50, 50);  // a crowd in one corner
  points.emplace_back(390.0f, 390.0f, 7.0f, -1.0f, 1.0f);
  points.emplace_back(390.0f, 10.0f, 7.0f, -1.0f, 1.0f);
  const auto kept = SpreadEvenly(points, {0, 0, 400, 400}, 20);
  const auto lonely = std::count_if(kept.begin(), kept.end(),
                                    [](const cv::KeyPoint& k) { return k.pt.x > 300; });
  EXPECT_EQ(lonely, 2);
}

TEST(PointSpread, KeepsTheStrongestOfACell) {
  std::vector<cv::KeyPoint> points = Scattered(300, 100, 100);
  const auto strongest =
      std::max_element(points.begin(), points.end(),
                       [](const auto& a, const auto& b) { return a.response < b.response; });
  strongest->response = 999;
  const auto kept = SpreadEvenly(points, {0, 0, 100, 100}, 10);
  EXPECT_TRUE(std::any_of(kept.begin(), kept.end(),
                          [](const cv::KeyPoint& k) { return k.response == 999; }));
}

TEST(PointSpread, EndsWhenAllCandidatesAreAtOnePlace) {
  const std::vector<cv::KeyPoint> points(50, cv::KeyPoint(3, 3, 7));
  EXPECT_EQ(SpreadEvenly(points, {0, 0, 100, 100}, 20).size(), 1u);
}

TEST(PointSpread, GivesNothingForNothing) {
  EXPECT_TRUE(SpreadEvenly({}, {0, 0, 100, 100}, 20).empty());
  EXPECT_TRUE(SpreadEvenly(Scattered(5, 10, 10), {0, 0, 0, 0}, 20).empty());
  EXPECT_TRUE(SpreadEvenly(Scattered(5, 10, 10), {0, 0, 10, 10}, 0).empty());
}

}  // namespace
}  // namespace slam
