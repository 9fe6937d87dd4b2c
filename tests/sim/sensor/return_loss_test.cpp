#include "sim/sensor/depth/return_loss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>
#include <vector>

#include "sim/scene/surface_light.h"
#include "tests/sim/sensor/sensor_measurements.h"

// Each effect alone, against pencil and paper.
namespace sim {
namespace {

constexpr ReturnLoss kDim{.min_return_per_m2 = 0.012, .spread_ln = 0.2};
constexpr ReturnLoss kSpot{.mirror_spot_rad = 0.05};

/// A Kinect with nothing but what is asked for.
KinectModel LossyKinect(const ReturnLoss& loss, const MatchWindow& window = {}) {
  KinectModel model;
  model.projector_offset_m = 0;
  model.max_depth_m = 20;
  model.max_incidence_rad = 1.57;
  model.noise_scale = model.lateral_scale = 0;
  model.quantise = false;
  model.loss = loss;
  model.window = window;
  return model;
}

Scene Board(double z_m, double theta_rad, double infrared, double gloss = 0) {
  Scene scene = TiltedBoard(z_m, theta_rad);
  for (Material& face : scene.objects[0].faces) {
    face.infrared = infrared;
    face.gloss = gloss;
  }
  return scene;
}

/// 255 where there is no depth.
cv::Mat1b None(const cv::Mat1d& depth) {
  cv::Mat1b none;
  cv::compare(depth, 0.0, none, cv::CMP_EQ);
  return none;
}

cv::Mat1b Missing(const Rendering& rendering, const KinectModel& model, std::uint64_t seed = 3,
                  std::uint64_t frame = 0) {
  return None(MeasureDepth(rendering, model, Camera{}, seed, frame));
}

double Share(const cv::Mat1b& missing) {
  return cv::countNonZero(missing) / static_cast<double>(missing.total());
}

/// Lost of a board that fills a narrow view, mean over frames.
double ShareLost(double z_m, double theta_rad, double infrared, double gloss = 0) {
  const Rendering rendering =
      SensorView(Board(z_m, theta_rad, infrared, gloss), NarrowCamera(), LossyKinect(kDim));
  double sum = 0;
  constexpr int kFrames = 40;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    sum += Share(Missing(rendering, LossyKinect(kDim), 3, frame));
  }
  return sum / kFrames;
}

double Phi(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

TEST(ReturnAtOneMetre, PassesTheGlassOnTheWayInAndOut) {
  for (const double cosine : {1.0, 0.5, 0.2}) {
    for (const double gloss : {0.3, 1.0}) {
      const double below =
          ReturnAtOneMetre(0.4, gloss, cosine) - ReturnAtOneMetre(0.0, gloss, cosine);
      const double through = 1 - gloss * GlassReflection(cosine);
      EXPECT_NEAR(below, 0.4 * cosine * through * through, 1e-12);
    }
  }
}

TEST(ReturnLoss, LosesWhatTheLawSaysByAlbedoDistanceAndAngle) {
  struct Case {
    double z_m, theta_rad, infrared;
  };
  for (const auto& [z, theta, a] :
       {Case{1, 0, 0.012}, Case{1, 0, 0.014}, Case{1, 0, 0.010}, Case{2, 0, 0.048},
        Case{1.5, 1.0, 0.05}, Case{2.5, 0.6, 0.1}}) {
    const double s = a * std::cos(theta) / (z * z);
    // 40 frames of some 300 blobs: 12 000 draws, and rays that are not quite parallel.
    EXPECT_NEAR(ShareLost(z, theta, a), Phi(std::log(0.012 / s) / 0.2), 0.03)
        << z << " " << theta << " " << a;
  }
}

TEST(ReturnLoss, LeavesABrightMattFrontalWallWhole) {
  EXPECT_EQ(ShareLost(1, 0, 0.7), 0.0);
  EXPECT_EQ(ShareLost(2, 1.2, 0.7), 0.0);  // nor at 69 degrees
}

TEST(ReturnLoss, HasTheAngleAtWhichARealBlackDisplayIsLost) {
  const double screen = InfraredOf({.print = Print::kScreen});
  const auto at = [&](double deg) { return ShareLost(0.93, deg * M_PI / 180, screen, 1); };
  EXPECT_LT(at(30), 0.02);
  EXPECT_NEAR(at(37.5), 0.5, 0.2);
  EXPECT_GT(at(45), 0.95);
}

TEST(ReturnLoss, ComesInBlobsOfSomePixels) {
  const Rendering rendering = SensorView(Board(1, 0, 0.012), NarrowCamera(), LossyKinect(kDim));
  double same = 0, count = 0;
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    const cv::Mat1b missing = Missing(rendering, LossyKinect(kDim), 3, frame);
    for (int v = 0; v < missing.rows; ++v) {
      for (int u = 0; u + 5 < missing.cols; ++u, ++count) {
        same += missing(v, u) == missing(v, u + 5);
      }
    }
  }
  // Recordings: correlation 0.44 to 0.61 after 5 px along x, about 0.4 to 0.5 along y.
  EXPECT_NEAR(2 * same / count - 1, 0.48, 0.1);
}

TEST(ReturnLoss, DependsOnSeedAndFrameAlone) {
  const Rendering rendering = SensorView(Board(1, 0, 0.012), NarrowCamera(), LossyKinect(kDim));
  const KinectModel model = RecordedKinect();
  const auto measured = [&](std::uint64_t seed, std::uint64_t frame) {
    return MeasureDepth(rendering, model, NarrowCamera(), seed, frame).clone();
  };
  const cv::Mat1d here = measured(3, 7);
  cv::Mat1d there;
  std::thread([&] { there = measured(3, 7); }).join();
  EXPECT_EQ(cv::norm(here, there, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(here, measured(3, 8), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(here, measured(4, 7), cv::NORM_INF), 0.0);
}

TEST(MirrorSpot, IsWhereTheFaceThrowsTheProjectorsLightAtTheCamera) {
  // A mirror at 1 m, square to the axis: half way between camera and projector, 75 mm apart along x,
  // is 37.5 mm from the axis, 19.7 px; the radius is tan(0.05) m of 525 px / m, 26 px.
  KinectModel model = LossyKinect(kSpot);
  model.projector_offset_m = 0.075;
  const Camera camera;
  const Rendering rendering = SensorView(Board(1, 0, 0.7, 1), camera, model);
  const cv::Mat1b missing = Missing(rendering, model);
  const cv::Moments m = cv::moments(missing, true);
  EXPECT_NEAR(m.m10 / m.m00, camera.cx + 0.0375 * camera.fx, 3);
  EXPECT_NEAR(m.m01 / m.m00, camera.cy, 3);
  EXPECT_NEAR(std::sqrt(m.m00 / M_PI), 0.05 * camera.fx, 4);
}

TEST(MirrorSpot, IsSmallerInProportionToTheGloss) {
  const KinectModel model = LossyKinect(kSpot);
  const Camera camera;
  for (const double gloss : {0.3, 0.6}) {
    const Rendering rendering = SensorView(Board(1, 0, 0.7, gloss), camera, model);
    double pixels = 0;
    constexpr int kFrames = 10;
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
      pixels += cv::countNonZero(Missing(rendering, model, 3, frame)) / double(kFrames);
    }
    // The rim is ragged by a quarter of the radius, about its mean.
    const double radius_px = gloss * 0.05 * camera.fx * std::sqrt(1 + 0.25 * 0.25);
    EXPECT_NEAR(std::sqrt(pixels / M_PI), radius_px, 0.12 * radius_px) << gloss;
  }
}

TEST(MirrorSpot, IsNotOnMattNorOnTurnedFaces) {
  const KinectModel model = LossyKinect(kSpot);
  const Camera camera;
  EXPECT_EQ(Share(Missing(SensorView(Board(1, 0, 0.7, 0), camera, model), model)), 0.0);
  // The view reaches 31 degrees to each side.
  EXPECT_EQ(Share(Missing(SensorView(Board(1, 0.8, 0.7, 1), camera, model), model)), 0.0);
}

TEST(Gloss, ComesFromThePrintUnlessTheMaterialSaysIt) {
  EXPECT_EQ(GlossOf({.print = Print::kScreen}), 1.0);
  EXPECT_EQ(GlossOf({.print = Print::kText}), 0.0);
  EXPECT_EQ(GlossOf({.print = Print::kScreen, .gloss = 0.2}), 0.2);
  EXPECT_EQ(InfraredOf({.print = Print::kText, .infrared = 0.2}), 0.2);
  EXPECT_NEAR(InfraredOf({.colour = {0.3, 0.3, 0.3}}), 0.3, 1e-12);
  // Luminance: green counts most, blue least, to the four digits of BT.709.
  EXPECT_NEAR(InfraredOf({.colour = {1, 0, 0}}), 0.2126, 1e-12);
  EXPECT_NEAR(InfraredOf({.colour = {0, 1, 0}}), 0.7152, 1e-12);
}

/// By area instead of by dots.
constexpr MatchWindow kSharp{.side_px = 9, .min_share = 0.6, .dots = 0, .max_apart_steps = 16};

/// Missing pixels of the middle row of a board of 0.2 m at 1 m before a wall.
int MissingInARow(double z_wall_m, const KinectModel& model) {
  const Camera camera;
  const Rendering rendering = SensorView(BoardBeforeWall(1, z_wall_m), camera, model);
  return cv::countNonZero(Missing(rendering, model).row(camera.height / 2));
}

TEST(MatchWindow, LosesThePixelsThatHaveTooSmallAShareOfIt) {
  // k pixels from a straight edge, 5 + k of 9 columns show the own surface.
  const auto lost = [](double share) {
    return MissingInARow(2, LossyKinect({}, {.side_px = 9, .min_share = share, .dots = 0}));
  };
  EXPECT_EQ(lost(0), 0);
  EXPECT_EQ(lost(0.6), 4);  // two edges, a pixel on both sides of each: 5/9 < 0.6 < 6/9
  EXPECT_EQ(lost(0.7), 8);  // 6/9 < 0.7 < 7/9
  EXPECT_EQ(lost(0.95), 16);
}

TEST(MatchWindow, LosesAsManyAsDotsAtRandomDo) {
  // The row k from an edge has (5 + k) / 9 of the window's area on its own side; nine dots.
  const Camera camera;
  const KinectModel model = LossyKinect({}, kRecordedWindow);
  const Rendering rendering = SensorView(BoardBeforeWall(1, 2), camera, model);
  int top = 0;  // the board's first row
  while (rendering.object_id(top, camera.width / 2) != 2) ++top;
  for (int k = 0; k < 4; ++k) {
    double lost = 0;
    constexpr int kFrames = 60;
    const cv::Rect row(camera.width / 2 - 40, top + k, 80, 1);
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
      lost += Share(Missing(rendering, model, 3, frame)(row)) / kFrames;
    }
    const double share = (5 + k) / 9.0, sd = std::sqrt(share * (1 - share) / 9);
    EXPECT_NEAR(lost, Phi((0.45 - share) / sd), 0.05) << k;
  }
}

// Two rows that meet at an edge share their window but for a line of it: the dots that one
// surface has too few of are the other's, so only one of the two is lost at a place.
TEST(MatchWindow, LosesOneSideOfAnEdgeWhereItSparesTheOther) {
  const Camera camera;
  const KinectModel model = LossyKinect({}, kRecordedWindow);
  const Rendering rendering = SensorView(BoardBeforeWall(1, 2), camera, model);
  int top = 0;  // the board's first row
  while (rendering.object_id(top, camera.width / 2) != 2) ++top;
  int near = 0, far = 0, both = 0;
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    const cv::Mat1b missing = Missing(rendering, model, 3, frame);
    for (int u = camera.width / 2 - 40; u < camera.width / 2 + 40; ++u) {
      near += missing(top, u) != 0;
      far += missing(top - 1, u) != 0;
      both += missing(top, u) != 0 && missing(top - 1, u) != 0;
    }
  }
  EXPECT_GT(near, 160);  // a tenth
  EXPECT_GT(far, 160);
  EXPECT_EQ(both, 0);
}

TEST(MatchWindow, LosesAsMuchOfAnEdgeAtTheImagesBorderAsWithin) {
  // The board reaches beyond the image above and below. A window that the border cuts holds fewer
  // pixels, of which as large a share is the own surface's.
  Scene scene = BoardBeforeWall(1, 2);
  scene.objects[1].size.z() = 4;
  const KinectModel model = LossyKinect({}, kSharp);
  const Camera camera;
  const cv::Mat1b missing = Missing(SensorView(scene, camera, model), model);
  for (const int v : {0, 1, 3, camera.height / 2, camera.height - 1}) {
    EXPECT_EQ(cv::countNonZero(missing.row(v)), 4) << v;
  }
}

TEST(MatchWindow, SparesSurfacesThatMatchAsOne) {
  // Disparity at 1 m is 351.3 steps; 16 less is 1.0477 m.
  const KinectModel model = LossyKinect({}, kSharp);
  EXPECT_EQ(MissingInARow(1.045, model), 0);
  EXPECT_EQ(MissingInARow(1.05, model), 4);
}

TEST(MatchWindow, SeesNoDotsInTheProjectorsShadow) {
  KinectModel model = LossyKinect({});
  model.projector_offset_m = 0.075;
  const int shadow = MissingInARow(2, model);
  model.window = kSharp;
  // The shadow's two borders lose a pixel each outside it, the edge without one two.
  EXPECT_GT(shadow, 10);
  EXPECT_EQ(MissingInARow(2, model), shadow + 4);
}

TEST(DepthLoss, IsOffUnlessAskedFor) {
  const Camera camera = SmallCamera();
  const KinectModel plain;
  Rendering rendering = SensorView(Board(1, 0.3, 0.001, 1), camera, plain);
  const cv::Mat1d with = MeasureDepth(rendering, plain, camera, 1, 2).clone();
  rendering.infrared.release();
  const cv::Mat1d without = MeasureDepth(rendering, plain, camera, 1, 2);
  EXPECT_EQ(cv::norm(with, without, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::countNonZero(with), 0);
}

TEST(DepthLoss, OfAnAzureIsThatOfItsRange) {
  // The maker's range of 3.86 m holds for reflectivities of 15 % and more.
  AzureModel model;
  model.loss = {.min_return_per_m2 = 0.01};
  model.hexagon = false;
  const auto share = [&](double infrared) {
    const Rendering rendering = SensorView(Board(3.8, 0, infrared), NarrowCamera(), model);
    const cv::Mat1b none = None(MeasureDepth(rendering, model, NarrowCamera(), 1, 0));
    return Share(none);
  };
  EXPECT_LT(share(0.3), 0.01);
  EXPECT_NEAR(share(0.01 * 3.8 * 3.8), 0.5, 0.15);
  EXPECT_GT(share(0.05), 0.99);
}

}  // namespace
}  // namespace sim
