// Where vertical panels fill the image no plane tells the height, and every error of a normal pulls
// at it.
#include <gtest/gtest.h>

#include "sim/families/twin.h"
#include "tests/support/pipeline.h"

namespace {

TEST(WhitePanels, GiveNoHeightThatNoPlaneTells) {
  const pipeline::TemporaryFolder folder("panels");
  pipeline::Record(
      sim::MakeTwin("fr3-snn", 3),
      {.frames = 90, .sensor = sim::SensorKind::kKinect1, .detector = sim::DetectorKind::kNone},
      folder / "seq");
  pipeline::Run(folder / "seq", folder / "run");
  const nlohmann::json trajectory =
      pipeline::Score(folder / "run", folder / "seq").at("trajectory");
  EXPECT_EQ(trajectory.at("tracked").get<int>(), 88);
  // Panels that are believed lift the camera by 0.7 m. Of eight twins none is off by more than 0.03 m.
  EXPECT_LT(trajectory.at("ate_origin").at("max_m").get<double>(), 0.05);
}

}  // namespace
