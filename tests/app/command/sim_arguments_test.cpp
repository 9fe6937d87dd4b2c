#include "app/sim/sim_arguments.h"

#include <gtest/gtest.h>

#include "sim/families/twin.h"
#include "sim/scene/write_scene.h"
#include "sim/sensor/read_sensor.h"
#include "tests/support/program.h"

namespace app {
namespace {

/// A scene that says how fast the camera moves and turns, and where it goes.
class SceneOfArguments : public testing::Test {
 protected:
  SceneOfArguments() {
    in_file_ = sim::MakeTwin("fr3-loh", 3);
    sim::WriteScene(in_file_, folder_ / "scene.yaml");
    arguments_.scene = folder_ / "scene.yaml";
  }
  sim::Motion Moved() const { return SceneOf(arguments_).motion; }

  program::TemporaryFolder folder_;
  sim::Scene in_file_;
  SimArguments arguments_;
};

TEST_F(SceneOfArguments, MovesAsItsFileSays) {
  ASSERT_GT(in_file_.motion.speed_m_s, 0);
  ASSERT_GT(in_file_.motion.turn_deg_s, 0);
  ASSERT_FALSE(in_file_.motion.stations.empty());
  EXPECT_EQ(Moved().preset, in_file_.motion.preset);
  EXPECT_EQ(Moved().speed_m_s, in_file_.motion.speed_m_s);
  EXPECT_EQ(Moved().turn_deg_s, in_file_.motion.turn_deg_s);
  EXPECT_EQ(Moved().stations.size(), in_file_.motion.stations.size());
}

TEST_F(SceneOfArguments, HasThePaceOfAnotherMotionThatIsNamed) {
  arguments_.motion = "fast";
  EXPECT_EQ(Moved().preset, "fast");
  EXPECT_EQ(Moved().speed_m_s, 0);  // the preset's
  EXPECT_EQ(Moved().turn_deg_s, 0);
  EXPECT_TRUE(Moved().stations.empty());
  arguments_.motion = "loop";
  EXPECT_EQ(Moved().stations.size(), in_file_.motion.stations.size());
}

TEST_F(SceneOfArguments, HasThePaceThatIsNamedWhateverTheMotion) {
  for (const bool another : {false, true}) {
    if (another) arguments_.motion = "xyz";
    arguments_.speed_m_s = 0.123;
    arguments_.turn_deg_s.reset();
    EXPECT_EQ(Moved().speed_m_s, 0.123);
    EXPECT_EQ(Moved().turn_deg_s, another ? 0 : in_file_.motion.turn_deg_s);
    arguments_.turn_deg_s = 45;
    EXPECT_EQ(Moved().turn_deg_s, 45);
  }
}

TEST(OptionsOfArguments, HaveTheSensorsLensUnlessOneIsTold) {
  SimArguments arguments;
  arguments.sensor = "kinect1";
  const auto lens = [&] { return OptionsOf(arguments, sim::Scene{}).rig.camera.lens; };
  EXPECT_FALSE(lens().IsNone());
  arguments.lens = {0, 0, 0, 0, 0};
  EXPECT_TRUE(lens().IsNone());
  arguments.lens = {0.01, 0, 0, 0, 0};
  EXPECT_EQ(lens().k1, 0.01);
}

TEST_F(SceneOfArguments, KeepsTheLensThatItsFileTellsZerosToo) {
  const auto lens_of = [&](const sim::Scene& scene) {
    sim::WriteScene(scene, arguments_.scene);
    return OptionsOf(arguments_, SceneOf(arguments_)).rig.camera.lens;
  };
  arguments_.sensor = "kinect1";
  EXPECT_TRUE(lens_of(sim::MakeTwin("fr3-loh", 3)).IsNone());
  EXPECT_EQ(lens_of(sim::MakeTwin("fr2-xyz", 3)).k1, 0.2312);
  const sim::Lens of_fr1 = lens_of(sim::MakeTwin("fr1-xyz", 3));
  EXPECT_EQ(of_fr1.k1, 0.2624);
  EXPECT_EQ(of_fr1.k3, 1.1633);
  // Left out: the sensor's, with a `capture` that is silent about it and without one.
  sim::Scene silent = sim::MakeTwin("fr3-loh", 3);
  silent.capture->distortion.reset();
  EXPECT_EQ(lens_of(silent).k1, sim::SensorByName("kinect1").lens.k1);
  silent.capture.reset();
  EXPECT_EQ(lens_of(silent).k1, sim::SensorByName("kinect1").lens.k1);
}

}  // namespace
}  // namespace app
