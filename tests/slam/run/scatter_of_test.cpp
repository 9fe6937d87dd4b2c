#include "slam/run/scatter_of.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "io/input_error.h"

namespace slam {
namespace {

namespace fs = std::filesystem;

TEST(ScatterOf, RealRecordingsTellFirstKinects) {
  const char* shared = std::getenv("PAS_SHARED_DIR");
  const fs::path data = fs::path(shared ? shared : PAS_SOURCE_DIR "/../shared") / "data";
  const fs::path kitchen = data / "real_kitchen_first300", tum = data / "tum_fr1_xyz_first37";
  if (!fs::exists(kitchen) || !fs::exists(tum)) GTEST_SKIP() << "no recordings in " << data;
  EXPECT_EQ(ScatterOf(kitchen, "").TellSensor(), DepthSensor::kKinect1);
  EXPECT_EQ(ScatterOf(tum, "tum1").TellSensor(), DepthSensor::kKinect1);
}

TEST(ScatterOf, RefusesWhatIsNoRecording) {
  EXPECT_THROW(ScatterOf("nowhere", ""), io::InputError);
}

}  // namespace
}  // namespace slam
