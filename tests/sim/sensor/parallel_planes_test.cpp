// What the project is about: two parallel planes a few millimetres apart. How well a single
// pixel tells them apart is d' = gap / (sqrt(2) sd), for every sensor.
#include <gtest/gtest.h>

#include "tests/sim/sensor/sensor_measurements.h"

namespace sim {
namespace {

/// The sensor without what a narrow view of a wall cannot show.
DepthModel Bare(SensorKind kind) {
  DepthModel model = Sensor(kind).depth;
  if (auto* azure = std::get_if<AzureModel>(&model)) azure->session_offset_m = 0;
  if (auto* d435 = std::get_if<D435Model>(&model)) d435->baseline_m = 0;
  return model;
}

auto WallAt(const DepthModel& model, double z) {
  const Camera camera = NarrowCamera();
  const Rendering rendering = SensorView(OneBoard(z), camera, model);
  return MeasureErrors(rendering, camera, model, 12, [](double, double) { return 1.0; });
}

class TwoPlanes : public testing::TestWithParam<SensorKind> {};

TEST_P(TwoPlanes, AreToldApartAsTheirGapAndThePublishedSdSay) {
  const DepthModel model = Bare(GetParam());
  constexpr double kZ = 1.0;
  const auto far = WallAt(model, kZ);
  for (const double gap : {0.002, 0.005, 0.01, 0.02}) {
    const auto near = WallAt(model, kZ - gap);
    const double measured_gap = (kZ + far.mean) - (kZ - gap + near.mean);
    const double measured = measured_gap / std::sqrt(near.sd * near.sd + far.sd * far.sd);
    const double stated_gap = gap + DepthBias(model, kZ) - DepthBias(model, kZ - gap);
    const double stated = stated_gap / (std::sqrt(2.0) * DepthSigma(model, kZ, 0));
    // 5 % of the sd, 3 % of a sd for the means (those of smooth noise hold few numbers).
    EXPECT_NEAR(measured, stated, 0.05 * std::abs(stated) + 0.04) << gap;
  }
}

TEST_P(TwoPlanes, AreTwoPeaksOnceTheirGapIsFiveSds) {
  const DepthModel model = Bare(GetParam());
  const double gap = 5 * DepthSigma(model, 1.0, 0);
  const Camera camera = NarrowCamera();
  int wrong = 0, all = 0;
  for (const double z : {1.0, 1.0 - gap}) {
    const cv::Mat1d depth =
        MeasureDepth(SensorView(OneBoard(z), camera, model), model, camera, 5, 0);
    const double middle = 1.0 - gap / 2 + DepthBias(model, 1.0);
    for (const double measured : depth) {
      ++all;
      wrong += (measured > middle) != (z == 1.0) ? 1 : 0;
    }
  }
  // A Gaussian is beyond 2.5 sds in 0.6 %; steps and waves add to it.
  EXPECT_LT(wrong, 0.02 * all);
  EXPECT_GT(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Sensors, TwoPlanes,
                         testing::Values(SensorKind::kKinect1Clean, SensorKind::kAzure,
                                         SensorKind::kD435));

}  // namespace
}  // namespace sim
