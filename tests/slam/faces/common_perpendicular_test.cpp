#include "slam/faces/common_perpendicular.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/shared_data.h"

namespace slam {
namespace {

constexpr double kRoundOff_m = 1e-12;  // coordinates below 10 m, angles above 0.1 rad
const Line kAlongX{{1, 2, 0}, {1, 0, 0}};
const Line kSkew{{3, -1, 0.5}, {0, 0.6, 0.8}};

PerpendicularFeet Feet(const Line& a, const Line& b) {
  return CommonPerpendicular(a, b, 1e-3).value();
}

TEST(CommonPerpendicularEq2, FootLiesOnTheSecondLine) {
  const Eigen::Vector3d d = Feet(kAlongX, kSkew).on_j - kSkew.P;
  EXPECT_NEAR(d.cross(kSkew.V).norm(), 0.0, kRoundOff_m);
}

TEST(CommonPerpendicularEq3, FootIsTheProjectionOntoTheFirstLine) {
  const PerpendicularFeet feet = Feet(kAlongX, kSkew);
  EXPECT_NEAR((feet.on_i - kAlongX.P).cross(kAlongX.V).norm(), 0.0, kRoundOff_m);
  EXPECT_NEAR((feet.on_i - feet.on_j).dot(kAlongX.V), 0.0, kRoundOff_m);
}

TEST(CommonPerpendicularEq3, AsPrintedMissesTheFoot) {
  const PerpendicularFeet feet = Feet(kAlongX, kSkew);
  const Eigen::Vector3d printed =
      kAlongX.P + (feet.on_j - kAlongX.P).dot(kAlongX.P) * kAlongX.V;  // . P_i, not . V_i
  EXPECT_GT((printed - feet.on_i).norm(), 0.1);
}

TEST(CommonPerpendicularEq5, SegmentIsOrthogonalToBothLines) {
  const PerpendicularFeet feet = Feet(kAlongX, kSkew);
  EXPECT_NEAR((feet.on_i - feet.on_j).dot(kSkew.V), 0.0, kRoundOff_m);
}

TEST(CommonPerpendicularEq5, TakesDirectionsOfAnyLength) {
  const PerpendicularFeet unit = Feet(kAlongX, kSkew);
  const PerpendicularFeet scaled =
      Feet({kAlongX.P, 1e-3 * kAlongX.V}, {kSkew.P, -50.0 * kSkew.V});
  EXPECT_NEAR((unit.on_i - scaled.on_i).norm(), 0.0, kRoundOff_m);
  EXPECT_NEAR((unit.on_j - scaled.on_j).norm(), 0.0, kRoundOff_m);
}

TEST(CommonPerpendicularEq5, HasNoAnswerForParallelLines) {
  EXPECT_FALSE(CommonPerpendicular(kAlongX, {{0, 0, 1}, {-1, 0, 0}}, 1e-3).has_value());
}

TEST(CommonPerpendicularEq5, HasNoAnswerWithoutADirection) {
  EXPECT_FALSE(CommonPerpendicular(kAlongX, {{0, 0, 1}, {0, 0, 0}}, 1e-3).has_value());
  const double nan = std::nan("");
  EXPECT_FALSE(CommonPerpendicular(kAlongX, {{0, 0, 1}, {nan, 0, 1}}, 1e-3).has_value());
  EXPECT_FALSE(CommonPerpendicular({{nan, 0, 0}, {1, 0, 0}}, kSkew, 1e-3).has_value());
}

Eigen::Vector3d Vector(const nlohmann::json& j) {
  return Eigen::Vector3d(j[0].get<double>(), j[1].get<double>(), j[2].get<double>());
}

TEST(CommonPerpendicularEq5, AgreesWithTheReferenceFigures) {
  const auto path = test_support::SharedFolder() / "golden/common_perpendicular.json";
  SKIP_WITHOUT(path);
  const nlohmann::json cases = nlohmann::json::parse(std::ifstream(path))["line_line"];
  int compared = 0;
  for (const nlohmann::json& c : cases) {
    const double sine = c["sin_angle"];
    const auto result = CommonPerpendicular({Vector(c["p1"]), Vector(c["d1"])},
                                            {Vector(c["p2"]), Vector(c["d2"])}, 1e-4);
    EXPECT_EQ(result.has_value(), sine > 1e-4) << c["tag"];
    if (!result) continue;
    const double scale = 1.0 + Vector(c["p1"]).norm() + Vector(c["foot1"]).norm();
    const double tolerance = 1e-14 * scale / (sine * sine) + 1e-13 * scale;
    EXPECT_LT((result.value().on_i - Vector(c["foot1"])).norm(), tolerance) << c["tag"];
    EXPECT_LT((result.value().on_j - Vector(c["foot2"])).norm(), tolerance) << c["tag"];
    ++compared;
  }
  EXPECT_GT(compared, 3);
}

}  // namespace
}  // namespace slam
