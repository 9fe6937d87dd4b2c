#include "slam/tracking/motion_filter.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "slam/base/random.h"
#include "tests/support/plane_world.h"
#include "tests/support/shared_data.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

constexpr double kFrame_s = 1.0 / 30;
const MotionEvidence kAll{.of_pose = 1e10 * Matrix6d::Identity()};  // to 10 micrometres
const MotionEvidence kNothing;

TEST(MotionFilter, KnowsNothingBeforeTheFirstFrame) {
  MotionFilter filter{{}};
  EXPECT_FALSE(filter.Predict(0.0));
  filter.Observe(0.0, Pose{}, kAll);
  EXPECT_TRUE(filter.Predict(kFrame_s));
  filter.Forget();
  EXPECT_FALSE(filter.Predict(kFrame_s));
}

TEST(MotionFilter, GoesOnAtTheSpeedThatWasSeen) {
  MotionFilter filter{{}};
  const Pose step{ExpSo3({0.002, -0.004, 0.001}), {0.004, 0.0, -0.006}};
  Pose T_cw;
  for (int i = 0; i < 30; ++i, T_cw = step * T_cw) filter.Observe(i * kFrame_s, T_cw, kAll);
  // In a frame the speed loses 2 %, of 7 mm.
  EXPECT_THAT(filter.Predict(30 * kFrame_s)->T_cw, PoseNear(T_cw, 1e-3, 1e-3));
}

TEST(MotionFilter, KnowsAFirstPoseAsWellAsItWasSeen) {
  MotionFilter filter{{}};
  filter.Observe(0.0, Pose{}, kNothing);  // the world's own
  EXPECT_LT(filter.Predict(1e-6)->covariance.diagonal().maxCoeff(), 1e-9);
  filter.Forget();
  const double sigma = 0.02;
  filter.Observe(0.0, Pose{}, {.of_pose = Matrix6d::Identity() / (sigma * sigma)});
  EXPECT_NEAR(std::sqrt(filter.Predict(1e-6)->covariance(0, 0)), sigma, 1e-4);
}

TEST(MotionFilter, SaysTheSpeed) {
  MotionFilter filter{{}};
  EXPECT_TRUE(filter.Speed(0.0).mean.isZero());
  const Vector6d speed = (Vector6d() << 0.1, 0, -0.3, 0, 0.2, 0).finished();
  for (int i = 0; i < 30; ++i) filter.Observe(i * kFrame_s, Exp(i * kFrame_s * speed), kAll);
  EXPECT_LT((filter.Speed(30 * kFrame_s).mean - speed).norm(),
            0.1 * speed.norm());  // it loses 2 %
  EXPECT_LT(filter.Speed(10.0).mean.norm(), 0.1 * speed.norm());
  filter.Forget();
  EXPECT_TRUE(filter.Speed(3.0).mean.isZero());
}

TEST(MotionFilter, GoesOnAsTheCameraSeesItselfWhereTheMapIsTurnedUnderIt) {
  const Pose step{ExpSo3({0.002, -0.004, 0.001}), {0.004, 0.0, -0.006}};
  MotionEvidence uneven = kAll;
  uneven.of_pose.diagonal() << 1e4, 1e6, 1e8, 1e6, 1e7, 1e8;
  MotionFilter filter{{}};
  Pose T_cw{ExpSo3({0.3, -0.2, 0.4}), {1, 2, 3}};
  for (int i = 0; i < 30; ++i) filter.Observe(i * kFrame_s, T_cw = step * T_cw, uneven);
  const auto before = filter.Predict(30 * kFrame_s);
  const Pose moved{ExpSo3({0.5, 1.0, -0.7}), {-1, 0.5, 2}};  // of the map
  filter.Correct(T_cw * moved);
  const auto after = filter.Predict(30 * kFrame_s);
  EXPECT_THAT(after->T_cw, PoseNear(before->T_cw * moved, 1e-9, 1e-9));
  EXPECT_LT((after->covariance - before->covariance).norm(), 1e-9 * before->covariance.norm());
}

TEST(MotionFilter, BeginsAsAnotherFoundThatThePathDoes) {
  const Vector6d speed = (Vector6d() << 0.1, 0, -0.3, 0, 0.2, 0).finished();
  MotionFilter first{{}};
  first.Observe(5.0, Pose{}, kAll);
  EXPECT_FALSE(first.at_start());
  first.Observe(5.0 + kFrame_s, Exp(kFrame_s * speed), kAll);
  ASSERT_TRUE(first.at_start());
  const StartSpeed found = *first.at_start();
  EXPECT_EQ(found.timestamp_s, 5.0);
  EXPECT_LT((found.speed.mean - speed).norm(), 0.1 * speed.norm());
  // What comes later says nothing of it any more.
  first.Observe(5.0 + 2 * kFrame_s, Pose{}, kAll);
  EXPECT_EQ(first.at_start()->speed.mean, found.speed.mean);

  MotionFilter second{{}};
  second.StartAt(found);
  EXPECT_TRUE(second.Speed(4.9).mean.isZero());  // of another frame nothing is known
  EXPECT_EQ(second.Speed(5.0).mean, found.speed.mean);
  EXPECT_EQ(second.Speed(5.0).covariance, found.speed.covariance);
  second.Observe(5.0, Pose{}, kAll);
  EXPECT_THAT(second.Predict(5.0 + kFrame_s)->T_cw,
              PoseNear(Exp(kFrame_s * speed), 1.5e-3, 1.5e-3));
  // A camera that was lost begins at rest.
  second.Forget();
  second.Observe(6.0, Pose{}, kAll);
  EXPECT_THAT(second.Predict(6.0 + kFrame_s)->T_cw, PoseNear(Pose{}, 1e-9, 1e-9));
}

TEST(MotionFilter, SaysNothingOfHowAPathBeganThatWasLostAtOnce) {
  MotionFilter filter{{}};
  filter.Observe(0.0, Pose{}, kAll);
  filter.Forget();
  for (int i = 1; i < 5; ++i) filter.Observe(i * kFrame_s, Pose{}, kAll);
  EXPECT_FALSE(filter.at_start());
}

TEST(MotionFilter, KnowsHowWellItKnowsHowAPathBegan) {
  // Hands in steps of a millisecond; after a short way and after a long one.
  const MotionFilterConfig config;
  for (const int way_ms : {33, 200}) {
    constexpr int kHands = 1000;
    constexpr double kStep_s = 1e-3;
    double nees = 0.0;
    for (int hand = 0; hand < kHands; ++hand) {
      Random random{12, static_cast<std::uint64_t>(hand)};
      const double began = config.speed_mps * Normal(random);
      double x = 0.0, speed = began;
      for (int i = 0; i < way_ms; ++i) {
        x += kStep_s * speed;
        speed -= kStep_s / config.memory_s * speed;
        speed += config.speed_mps * std::sqrt(2.0 * kStep_s / config.memory_s) * Normal(random);
      }
      MotionFilter filter{config};
      filter.Observe(0.0, Pose{}, kAll);
      filter.Observe(way_ms * kStep_s, Pose{Eigen::Matrix3d::Identity(), {x, 0, 0}}, kAll);
      const UncertainSpeed& found = filter.at_start()->speed;
      nees += std::pow(found.mean[0] - began, 2) / found.covariance(0, 0) / kHands;
    }
    EXPECT_NEAR(nees, 1.0, 0.15) << way_ms;  // three standard errors
  }
}

TEST(MotionFilter, KnowsTheSpeedTwiceAsWellOnceThePoseIsFound) {
  // Hands in steps of a millisecond, seen 30 times a second.
  const MotionFilterConfig config;
  constexpr double kStep_s = 1e-3;
  double predicted2 = 0.0, found2 = 0.0;
  for (int hand = 0; hand < 200; ++hand) {
    Random random{11, static_cast<std::uint64_t>(hand)};
    MotionFilter filter{config};
    double x = 0.0, speed = config.speed_mps * Normal(random);
    filter.Observe(0.0, Pose{}, kAll);
    for (int i = 1; i <= 330; ++i) {
      x += kStep_s * speed;
      speed -= kStep_s / config.memory_s * speed;
      speed += config.speed_mps * std::sqrt(2.0 * kStep_s / config.memory_s) * Normal(random);
      if (i % 33 != 0) continue;
      const Pose T_cw{Eigen::Matrix3d::Identity(), {x, 0, 0}};
      const double now_s = i * kStep_s;
      const Vector6d found = filter.SpeedAt(now_s)->At(T_cw);
      if (i > 100) {
        predicted2 += std::pow(filter.Speed(now_s).mean[0] - speed, 2);
        found2 += std::pow(found[0] - speed, 2);
      }
      filter.Observe(now_s, T_cw, kAll);
      EXPECT_NEAR(filter.Speed(now_s + 1e-9).mean[0], found[0], 1e-6);
    }
  }
  EXPECT_LT(std::sqrt(found2), 0.6 * std::sqrt(predicted2));
}

TEST(MotionFilter, SaysHowFarAHandCanHaveGone) {
  // 4,000 hands, in steps of a millisecond, of which nothing is seen after the first frame.
  const MotionFilterConfig config;
  constexpr int kHands = 4000;
  constexpr double kStep_s = 1e-3;
  for (const double after_s : {0.1, 1.0}) {
    double sum = 0.0;
    for (int hand = 0; hand < kHands; ++hand) {
      Random random{7, static_cast<std::uint64_t>(hand)};
      double x = 0.0, speed = config.speed_mps * Normal(random);
      for (int i = 0; i < std::lround(after_s / kStep_s); ++i) {
        x += kStep_s * speed;
        speed -= kStep_s / config.memory_s * speed;
        speed += config.speed_mps * std::sqrt(2 * kStep_s / config.memory_s) * Normal(random);
      }
      sum += x * x;
    }
    MotionFilter filter{config};
    filter.Observe(0.0, Pose{}, kAll);
    const double said = filter.Predict(after_s)->covariance(0, 0);
    EXPECT_NEAR(said * kHands / sum, 1.0, 0.1) << after_s;  // four standard deviations
  }
}

TEST(MotionFilter, IsTheSameInOneStepAndInMany) {
  MotionFilter once{{}}, often{{}};
  const Pose start{ExpSo3({0.1, 0.2, 0.3}), {1, 2, 3}};
  for (MotionFilter* filter : {&once, &often}) {
    filter->Observe(0.0, start, kAll);
    filter->Observe(kFrame_s, Pose{ExpSo3({0, 0.01, 0}), {0.01, 0, 0}} * start, kAll);
  }
  for (int i = 2; i < 12; ++i) {
    often.Observe(i * kFrame_s, often.Predict(i * kFrame_s)->T_cw, kNothing);
  }
  const UncertainPose a = *once.Predict(12 * kFrame_s), b = *often.Predict(12 * kFrame_s);
  EXPECT_THAT(a.T_cw, PoseNear(b.T_cw, 1e-4, 1e-4));  // turned by 2 degrees meanwhile
  EXPECT_LT((a.covariance - b.covariance).norm(), 1e-9 * a.covariance.norm());
}

TEST(MotionFilter, GrowsUncertainOnlyWhereNothingIsSeen) {
  MotionFilter filter{{}};
  filter.Observe(0.0, Pose{}, kAll);
  MotionEvidence but_y = kAll;
  but_y.of_pose(1, 1) = 0.0;
  double sigma_m = 0.0;
  for (int i = 1; i < 30; ++i) {
    filter.Observe(i * kFrame_s, Pose{}, but_y);
    const Matrix6d covariance = filter.Predict((i + 1) * kFrame_s)->covariance;
    EXPECT_GT(std::sqrt(covariance(1, 1)), sigma_m);
    sigma_m = std::sqrt(covariance(1, 1));
    // What a hand does in one frame.
    EXPECT_LT(std::sqrt(covariance(0, 0)), 0.02);
    EXPECT_LT(std::sqrt(covariance(3, 3)), 0.04);
  }
  EXPECT_GT(sigma_m, 0.2);
}

TEST(MotionFilter, KnowsNoMoreOfAnUnseenHeightForACameraThatTurns) {
  const auto height_sigma_m = [](double turn_rad_per_s) {
    MotionFilter filter{{}};
    double sigma_m = 0.0;
    for (int i = 0; i < 60; ++i) {
      const double turn = turn_rad_per_s * i * kFrame_s;
      const Pose T_cw{ExpSo3({0.5 * turn, 0.2 * turn, turn}), {0, 0, 0}};
      const Eigen::Vector3d up_c = T_cw.R * Eigen::Vector3d::UnitY();
      if (i > 1) {
        const Matrix6d covariance = filter.Predict(i * kFrame_s)->covariance;
        sigma_m = std::sqrt(up_c.dot(covariance.topLeftCorner<3, 3>() * up_c));
      }
      MotionEvidence but_height = kAll;
      if (i > 0) {
        but_height.of_pose.topLeftCorner<3, 3>() =
            1e10 * (Eigen::Matrix3d::Identity() - up_c * up_c.transpose());
      }
      filter.Observe(i * kFrame_s, T_cw, but_height);
    }
    return sigma_m;
  };
  EXPECT_GT(height_sigma_m(0.0), 0.2);
  EXPECT_NEAR(height_sigma_m(0.5), height_sigma_m(0.0), 0.02 * height_sigma_m(0.0));
}

TEST(MotionFilter, ComesToRestWhereNothingIsSeen) {
  MotionFilter filter{{}};
  for (int i = 0; i < 10; ++i) {
    filter.Observe(i * kFrame_s, Pose{Eigen::Matrix3d::Identity(), {0.01 * i, 0, 0}}, kAll);
  }
  // 0.3 m/s for two seconds.
  EXPECT_NEAR(filter.Predict(60.0)->T_cw.t.x(), 0.09 + 0.6, 0.03);
}

struct TimedTruth {
  double timestamp_s;
  Pose T_cw;
};

/// The truth of a hand-held recording, 100 times a second.
std::vector<TimedTruth> RealHand() {
  std::ifstream file(test_support::TumRecording() / "groundtruth_full.txt");
  std::vector<TimedTruth> truth;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    double t_s = 0.0, x = 0.0, y = 0.0, z = 0.0, qx = 0.0, qy = 0.0, qz = 0.0, qw = 0.0;
    if (!(words >> t_s >> x >> y >> z >> qx >> qy >> qz >> qw)) continue;
    const Pose T_wc{Eigen::Quaterniond(qw, qx, qy, qz).normalized().toRotationMatrix(),
                    {x, y, z}};
    truth.push_back({t_s, Inverse(T_wc)});
  }
  return truth;
}

TEST(MotionFilter, KnowsARealHand) {
  SKIP_WITHOUT(test_support::TumRecording());
  const std::vector<TimedTruth> truth = RealHand();
  // Seen every 30 ms. True speeds are those of 20 ms before and after.
  MotionFilter filter{{}};
  Vector6d nees = Vector6d::Zero();
  int frames = 0;
  for (std::size_t i = 2; i + 2 < truth.size(); i += 3) {
    const TimedTruth &now = truth[i], &before = truth[i - 2], &after = truth[i + 2];
    const Vector6d speed =
        Log(after.T_cw * Inverse(before.T_cw)) / (after.timestamp_s - before.timestamp_s);
    if (const auto by_pose = filter.SpeedAt(now.timestamp_s); by_pose && i > 30) {
      const Vector6d left = by_pose->At(now.T_cw) - speed;
      nees += left.cwiseAbs2().cwiseQuotient(by_pose->covariance.diagonal());
      ++frames;
    }
    filter.Observe(now.timestamp_s, now.T_cw, kAll);
  }
  // Neither much surer of a hand's speed than it can be, nor much less.
  nees /= frames;
  EXPECT_GT(nees.minCoeff(), 0.1);
  EXPECT_LT(nees.maxCoeff(), 5.0);
}

TEST(MotionFilter, KnowsHowFarARealHandGoesUnseen) {
  SKIP_WITHOUT(test_support::TumRecording());
  const std::vector<TimedTruth> truth = RealHand();
  for (const double ahead_s : {0.1, 0.33, 1.0}) {
    const auto ahead = static_cast<std::size_t>(std::lround(100 * ahead_s));
    MotionFilter filter{{}};
    Vector6d nees = Vector6d::Zero();
    int frames = 0;
    for (std::size_t i = 0; i + ahead < truth.size(); i += 3) {
      filter.Observe(truth[i].timestamp_s, truth[i].T_cw, kAll);
      if (i <= 30) continue;
      const UncertainPose predicted = *filter.Predict(truth[i + ahead].timestamp_s);
      const Vector6d off = Log(truth[i + ahead].T_cw * Inverse(predicted.T_cw));
      nees += off.cwiseAbs2().cwiseQuotient(predicted.covariance.diagonal());
      ++frames;
    }
    nees /= frames;
    EXPECT_GT(nees.minCoeff(), 0.1) << ahead_s;
    EXPECT_LT(nees.maxCoeff(), 4.0) << ahead_s;
  }
}

TEST(MotionFilter, PredictsNothingWhereNoTimeHasPassed) {
  MotionFilter filter{{}};
  filter.Observe(1.0, Pose{}, kAll);
  EXPECT_FALSE(filter.Predict(1.0));
  EXPECT_FALSE(filter.Predict(0.9));
}

}  // namespace
}  // namespace slam
