#include "app/bench/epipolar.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "eval/formats/pose/pose_file.h"
#include "eval/trajectory/statistics.h"
#include "sim/families/families.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"
#include "tests/support/pipeline.h"

namespace app {
namespace {

/// A desk recorded for a second, with its true poses.
class RecordedDesk : public ::testing::Test {
 protected:
  RecordedDesk() {
    pipeline::Recording recording;
    recording.frames = 30;
    recording.sensor = sim::SensorKind::kIdeal;
    pipeline::Record(sim::MakeScene("desk", 971), recording, folder_ / "seq");
    truth_ = eval::ReadPoseFile(folder_ / "seq" / "groundtruth.txt").poses;
  }

  std::vector<std::vector<double>> Distances(const std::vector<eval::Trajectory>& of,
                                             const EpipolarRules& rules = kRules) const {
    const slam::Camera camera = slam::ChooseCamera("", folder_ / "seq").camera;
    slam::SequenceReader frames(folder_ / "seq", camera);
    return EpipolarDistances(frames, camera, of, rules);
  }

  static constexpr EpipolarRules kRules{.apart = 10, .every = 5, .min_baseline_m = 0.01};
  pipeline::TemporaryFolder folder_;
  eval::Trajectory truth_;
};

TEST_F(RecordedDesk, ShowsTheTrueLinesToAFractionOfAPixelAndOthersFartherOff) {
  // The other one turns by 0.2 degrees a frame more: 10 frames apart by 2 degrees about the view.
  eval::Trajectory turning = truth_;
  for (std::size_t i = 0; i < turning.size(); ++i) {
    const double more_rad = 0.2 * M_PI / 180 * static_cast<double>(i);
    turning[i].T_wc.R *= Eigen::AngleAxisd(more_rad, Eigen::Vector3d::UnitZ()).matrix();
  }
  const auto distances = Distances({truth_, turning});
  ASSERT_GT(distances[0].size(), 100U);
  ASSERT_EQ(distances[0].size(), distances[1].size());
  const double of_truth_px = eval::Quantile(distances[0], 0.5);
  EXPECT_LT(of_truth_px, 0.5);
  EXPECT_GT(eval::Quantile(distances[1], 0.5), 3 * of_truth_px);
}

TEST_F(RecordedDesk, DoesNotDependOnTheWorldNorOnTheLengthOfTheWay) {
  // Epipolar lines know neither: another world, twice as large.
  eval::Trajectory elsewhere = truth_;
  const eval::Pose T{Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix(),
                     Eigen::Vector3d(1, -2, 3)};
  for (eval::StampedPose& pose : elsewhere) {
    pose.T_wc = T * pose.T_wc;
    pose.T_wc.t *= 2;
  }
  const auto distances = Distances({truth_, elsewhere});
  ASSERT_FALSE(distances[0].empty());
  for (std::size_t i = 0; i < distances[0].size(); ++i)
    EXPECT_NEAR(distances[0][i], distances[1][i], 1e-6);
}

TEST_F(RecordedDesk, ComparesTheFramesAloneThatAllHave) {
  eval::Trajectory late = truth_;
  for (eval::StampedPose& pose : late) pose.stamp_s += 0.015;  // of no image
  EXPECT_TRUE(Distances({truth_, late})[0].empty());
  const eval::Trajectory half(truth_.begin(), truth_.begin() + 16);  // pairs 0-10 and 5-15
  const auto of_half = Distances({truth_, half}), of_all = Distances({truth_});
  EXPECT_FALSE(of_half[0].empty());
  EXPECT_LT(of_half[0].size(), of_all[0].size());
  EXPECT_TRUE(Distances({truth_}, {.apart = 10, .every = 5, .min_baseline_m = 9.0})[0].empty());
}

}  // namespace
}  // namespace app
