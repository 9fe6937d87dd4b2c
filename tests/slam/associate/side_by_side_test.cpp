// Frame planes that lie side by side: is there a step, are they two objects?
#include "slam/associate/side_by_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "slam/associate/frame_relations.h"
#include "tests/support/cameras.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

const Pose kOver = LookAt({0.1, -0.9, 0.8}, {0, 0, 0});

/// Two boards on one level side by side, the right one `step_m` higher.
SeenWorld TwoBoards(double step_m, double depth_noise, double gap_m = 0.01,
                    const Pose& T_cw = kOver) {
  PlaneWorld world;
  world.Add({-0.2 - gap_m / 2, 0, 0}, {0.2, 0, 0}, {0, 0.2, 0}, "");
  world.Add({0.2 + gap_m / 2, 0, step_m}, {0.2, 0, 0}, {0, 0.2, 0}, "");
  return See(world, T_cw, HalfCamera(), {.depth_noise = depth_noise}, Random{7});
}

/// The step onto the right board, measured.
std::optional<StepBetween> Measured(const SeenWorld& seen) {
  const std::size_t right = seen.truth.at(0) == 1 ? 0 : 1;
  return SideBySide(seen.frame, HalfCamera()).Between(right, 1 - right);
}

/// What a sensor may do to all of a picture: depth bends by `most_m` from its middle to its
/// sides.
void Bend(Frame& frame, float most_m) {
  for (int v = 0; v < frame.depth_m.rows; ++v) {
    for (int u = 0; u < frame.depth_m.cols; ++u) {
      const float x = 2.0f * static_cast<float>(u) / static_cast<float>(frame.depth_m.cols) - 1;
      if (frame.depth_m(v, u) > 0) frame.depth_m(v, u) += most_m * x * x;
    }
  }
}

/// Two boards that face the camera, left and right of a gap in the middle of the picture; the right
/// one is 10 mm nearer.
Frame FacingBoards(const Camera& camera, int gap_px) {
  Frame frame;
  frame.depth_m = cv::Mat1f(camera.height, camera.width, 0.0f);
  frame.plane_labels = cv::Mat1b(camera.height, camera.width, static_cast<unsigned char>(0));
  const int width_px = (camera.width - gap_px) / 2;
  for (const int f : {0, 1}) {
    const double z_m = f == 0 ? 1.0 : 0.99;
    const cv::Rect board(f * (camera.width - width_px), 0, width_px, camera.height);
    frame.depth_m(board).setTo(z_m);
    frame.plane_labels(board).setTo(f + 1);
    FramePlane plane;
    plane.index = f;
    plane.pi_c = {-Eigen::Vector3d::UnitZ(), z_m};
    frame.planes.push_back(plane);
  }
  return frame;
}

TEST(StepBetweenPlanes, IsExactOnExactDepth) {
  // A camera that is rolled sees depth change along a row, too.
  for (const double roll_rad : {0.0, 0.4, -0.9}) {
    const Pose rolled{ExpSo3(roll_rad * Eigen::Vector3d::UnitZ()), Eigen::Vector3d::Zero()};
    for (const double step_m : {-0.03, -0.004, 0.0, 0.004, 0.03}) {
      const auto step = Measured(TwoBoards(step_m, 0.0, 0.01, rolled * kOver));
      ASSERT_TRUE(step) << roll_rad << " " << step_m;
      EXPECT_NEAR(step->step_m, step_m, 1e-6) << roll_rad;
    }
  }
}

// The last tile of a row is cut off: what lies beyond it is the next row's other end.
TEST(StepBetweenPlanes, IsExactWhereTheImageEndsWithinATile) {
  Camera camera = HalfCamera();
  camera.width = 316, camera.cx = 157.5;
  const Plane wall{Eigen::Vector3d(0.5, 0.1, -0.8).normalized(), 1.0};
  Frame frame;
  frame.depth_m = cv::Mat1f(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u)
      frame.depth_m(v, u) =
          static_cast<float>(-wall.d / wall.n.dot(camera.Backproject({u, v}, 1.0)));
  }
  frame.plane_labels = cv::Mat1b(camera.height, camera.width, std::uint8_t{1});
  frame.plane_labels(cv::Rect(100, 0, 200, camera.height)).setTo(2);
  frame.planes.resize(2);
  frame.planes[0].pi_c = frame.planes[1].pi_c = wall;
  const auto step = SideBySide(frame, camera).Between(0, 1);
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->step_m, 0.0, 1e-5);
}

TEST(StepBetweenPlanes, IsAsExactWherePixelsAreNotMeasured) {
  SeenWorld seen = TwoBoards(0.004, 0.0);
  for (int v = 0; v < seen.frame.depth_m.rows; ++v)
    for (int u = v % 3; u < seen.frame.depth_m.cols; u += 3) seen.frame.depth_m(v, u) = 0.0f;
  const auto step = Measured(seen);
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->step_m, 0.004, 1e-6);
}

TEST(StepBetweenPlanes, LiesWithinItsSigmaUnderNoise) {
  double sum_chi2 = 0.0;
  constexpr int kDraws = 40;
  PlaneWorld world;
  world.Add({-0.2, 0, 0}, {0.2, 0, 0}, {0, 0.2, 0}, "");
  world.Add({0.2, 0, 0.006}, {0.2, 0, 0}, {0, 0.2, 0}, "");
  for (int draw = 0; draw < kDraws; ++draw) {
    const SeenWorld seen = See(world, kOver, HalfCamera(), {.depth_noise = 1.0},
                               Random{static_cast<std::uint64_t>(100 + draw)});
    const auto step = Measured(seen);
    ASSERT_TRUE(step);
    EXPECT_LT(step->sigma_m, 0.001);
    sum_chi2 += std::pow((step->step_m - 0.006) / step->sigma_m, 2);
  }
  // The mean of 40 squares of unit normals: 1 with a standard deviation of 0.22.
  EXPECT_GT(sum_chi2 / kDraws, 0.4);
  EXPECT_LT(sum_chi2 / kDraws, 1.9);
}

TEST(StepBetweenPlanes, HasTheSigmaOfItsErrorsHoweverFewTilesTellIt) {
  // Six tiles each, whose heights err independently by 1 mm.
  const Camera camera = CameraOfSize(32, 24);
  const Frame exact = FacingBoards(camera, 0);
  Random random{5};
  double errors_m2 = 0.0, variances_m2 = 0.0;
  constexpr int kDraws = 600;
  for (int draw = 0; draw < kDraws; ++draw) {
    Frame frame = exact;
    frame.depth_m = exact.depth_m.clone();
    for (int v = 0; v < camera.height; v += 8) {
      for (int u = 0; u < camera.width; u += 8) {
        frame.depth_m(cv::Rect(u, v, 8, 8)) += 0.001 * Normal(random);
      }
    }
    const auto step = SideBySide(frame, camera).Between(1, 0);
    ASSERT_TRUE(step);
    errors_m2 += std::pow(step->step_m - 0.01, 2);
    variances_m2 += std::pow(step->sigma_m, 2);
  }
  // The ratio is known to 6 %: the errors' by 600 draws, the variances' by 600 of 8 tiles each.
  EXPECT_NEAR(errors_m2 / variances_m2, 1.0, 0.25);
}

TEST(StepBetweenPlanes, IsHardlyMovedByWhatTheSensorDoesToBoth) {
  SeenWorld level = TwoBoards(0.0, 0.0), stepped = TwoBoards(0.006, 0.0);
  Bend(level.frame, 0.02f);
  Bend(stepped.frame, 0.02f);
  EXPECT_NEAR(Measured(level)->step_m, 0.0, 0.001);
  EXPECT_NEAR(Measured(stepped)->step_m, 0.006, 0.001);
}

TEST(StepBetweenPlanes, IsNotKnownOfPlanesThatAreFarApart) {
  EXPECT_TRUE(Measured(TwoBoards(0.01, 0.0, 0.02)));
  EXPECT_FALSE(Measured(TwoBoards(0.01, 0.0, 0.4)));
}

TEST(StepBetweenPlanes, IsKnownAcrossTheSameGapAtAnyResolution) {
  for (const int width : {320, 640, 1280}) {
    SCOPED_TRACE(width);
    const Camera camera = CameraOfSize(width, width * 3 / 4);
    // 24 and 48 pixels at a width of 640.
    const Frame near = FacingBoards(camera, width * 24 / 640);
    const Frame apart = FacingBoards(camera, width * 48 / 640);
    const auto step = SideBySide(near, camera).Between(1, 0);
    ASSERT_TRUE(step);
    EXPECT_NEAR(step->step_m, 0.01, 1e-6);
    EXPECT_FALSE(SideBySide(apart, camera).Between(1, 0));
  }
}

TEST(StepBetweenPlanes, IsNotKnownWithoutDepthOrLabels) {
  SeenWorld seen = TwoBoards(0.01, 0.0);
  seen.frame.plane_labels.release();
  EXPECT_FALSE(SideBySide(seen.frame, HalfCamera()).Between(0, 1));
  seen = TwoBoards(0.01, 0.0);
  seen.frame.depth_m.setTo(0.0f);
  EXPECT_FALSE(SideBySide(seen.frame, HalfCamera()).Between(0, 1));
}

TEST(PiecesOfOneSurface, HaveNoStepWhereTheyMeet) {
  const AssociationConfig config;
  const auto pieces = [&](const SeenWorld& seen) {
    const PieceTable table = RelateFramePlanes(seen.frame, HalfCamera(), config).pieces;
    EXPECT_EQ(table[0][1], table[1][0]);
    return table[0][1];
  };
  EXPECT_EQ(pieces(TwoBoards(0.0, 1.0)), Pieces::kOfOne);
  EXPECT_EQ(pieces(TwoBoards(0.006, 1.0)), Pieces::kUnsure);
  EXPECT_EQ(pieces(TwoBoards(0.2, 1.0)), Pieces::kOfTwo);
  // Six millimetres that only planes extended to each other could tell.
  EXPECT_EQ(pieces(TwoBoards(0.006, 1.0, 0.6)), Pieces::kOfOne);
}

TEST(PiecesOfOneSurface, MayDifferByWhatNeighboursHaveInCommonHoweverLittleNoiseThereIs) {
  AssociationConfig config;
  const auto steps = [&](double step_m) {
    const SeenWorld seen = TwoBoards(step_m, 0.0);
    const FrameRelations related = RelateFramePlanes(seen.frame, HalfCamera(), config);
    EXPECT_EQ(related.pieces[0][1], related.steps.empty() ? Pieces::kOfOne : Pieces::kUnsure);
    return related.steps.size();
  };
  // Half of the floor is in common to neighbours: 0.6 mm, of which four are certain.
  config.offset_floor_m = 0.0012;
  EXPECT_EQ(steps(0.0005), 0u);
  EXPECT_EQ(steps(0.002), 0u);
  EXPECT_EQ(steps(0.003), 1u);
  config.offset_floor_m = 0.0008;
  EXPECT_EQ(steps(0.002), 1u);
}

/// Two planes, each linked to its own box.
bool AreTwo(const std::string& class_0, const Box& box_0, const std::string& class_1,
            const Box& box_1) {
  std::vector<Detection> detections(2);
  detections[0].class_name = class_0, detections[0].box_px = box_0;
  detections[1].class_name = class_1, detections[1].box_px = box_1;
  FramePlane one, other;
  one.detection = 0, other.detection = 1;
  EXPECT_EQ(OnTwoObjects(one, other, detections), OnTwoObjects(other, one, detections));
  return OnTwoObjects(one, other, detections);
}

TEST(PlanesOnTwoObjects, HaveBoxesThatAgreeIll) {
  const Box laptop{{375, 103}, {513, 238}}, book_before_it{{434, 161}, {494, 179}};
  const Box jittered{{371, 108}, {509, 243}}, beside{{520, 103}, {600, 200}};
  EXPECT_TRUE(AreTwo("laptop", laptop, "book", book_before_it));
  EXPECT_TRUE(AreTwo("laptop", laptop, "laptop", beside));
  EXPECT_FALSE(AreTwo("laptop", laptop, "tv", jittered)) << "a double of another class";
  EXPECT_FALSE(AreTwo("laptop", laptop, "laptop", jittered));
  EXPECT_FALSE(AreTwo("book", laptop, "book", book_before_it)) << "a box of a part";
}

TEST(PlanesOnTwoObjects, BothHaveABox) {
  std::vector<Detection> detections(1);
  detections[0].box_px = {{0, 0}, {10, 10}};
  FramePlane one, other;
  EXPECT_FALSE(OnTwoObjects(one, other, detections));
  one.detection = 0;
  EXPECT_FALSE(OnTwoObjects(one, other, detections));
  other.detection = 0;
  EXPECT_FALSE(OnTwoObjects(one, other, detections)) << "one box of both";
}

}  // namespace
}  // namespace slam
