#include "slam/run/scatter_of.h"

#include <gtest/gtest.h>

#include "io/input_error.h"
#include "tests/support/shared_data.h"

namespace slam {
namespace {

TEST(ScatterOf, RealRecordingsTellFirstKinects) {
  const std::filesystem::path tum = test_support::TumRecording(),
                              kitchen = tum.parent_path() / "real_kitchen_first300";
  SKIP_WITHOUT(tum);
  SKIP_WITHOUT(kitchen);
  EXPECT_EQ(ScatterOf(kitchen, "").TellSensor(), DepthSensor::kKinect1);
  EXPECT_EQ(ScatterOf(tum, "tum1").TellSensor(), DepthSensor::kKinect1);
}

TEST(ScatterOf, RefusesWhatIsNoRecording) {
  EXPECT_THROW(ScatterOf("nowhere", ""), io::InputError);
}

}  // namespace
}  // namespace slam
