#include "sim/write/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "sim/write/carried_exposure.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

constexpr double kBoard_m = 1.0;  ///< distance of the board
constexpr double kFarWall_m = 3.0;
/// Where nothing hides anything as the camera moves.
constexpr double kNearWall_m = kBoard_m + 0.002;
constexpr double kSpeed_mps = 0.8;  ///< of the camera, along its x

/// A dark board on the left half before a light wall, without shadows: one vertical edge.
Scene OneEdge(double wall_m) {
  Scene scene = OneBoard(wall_m, 20.0, Print::kPlain);
  scene.objects.push_back(BoxObject(2, "box", Role::kRegular, {-1.0, kBoard_m + 0.0005, 0},
                                    {2.0, 0.001, 4.0}, Print::kPlain));
  for (Material& face : scene.objects[1].faces) face.colour = {0.1, 0.1, 0.1};
  scene.sun.intensity = 0;
  return scene;
}

Pose MovingAlongX(double t) {
  Pose T_wc = LookAlongY();
  T_wc.t.x() = kSpeed_mps * t;
  return T_wc;
}

using Way = std::function<cv::Mat3f(const FrameRenderer&, const Exposure&)>;

cv::Mat3f RenderedAgain(const FrameRenderer& renderer, const Exposure& exposure) {
  return ExposeMoving(renderer, exposure, MovingAlongX);
}

cv::Mat3f RenderedOnce(const FrameRenderer& renderer, const Exposure& exposure) {
  Rendering rendering = renderer.Render(MovingAlongX(0));
  CarryExposure(renderer, exposure, MovingAlongX, MovingAlongX(0), rendering);
  return rendering.radiance;
}

/// Light of a row scaled to 0 on the board, 1 on the wall.
std::vector<double> Profile(const cv::Mat3f& radiance, int v) {
  std::vector<double> profile;
  const double dark = static_cast<double>(radiance(v, 2)[1]);
  const double light = static_cast<double>(radiance(v, radiance.cols - 3)[1]);
  for (int u = 0; u < radiance.cols; ++u) {
    profile.push_back((static_cast<double>(radiance(v, u)[1]) - dark) / (light - dark));
  }
  return profile;
}

/// Where the edge is, in pixels: as many pixels are dark as lie left of it.
double EdgeAt(const std::vector<double>& profile) {
  double dark = 0;
  for (const double value : profile) dark += 1.0 - value;
  return dark - 0.5;
}

TEST(StillCamera, SeesTheSameHoweverItExposes) {
  const FrameRenderer renderer(SmallDesk(), SmallCamera());
  const Pose T_wc = SmallArc(1)[0].T_wc;
  const cv::Mat3f still = renderer.Render(T_wc).radiance;
  const cv::Mat3f exposed = ExposeMoving(renderer, {.shutter_s = 0.02, .rolling_s = 0.02},
                                         [&](double) { return T_wc; });
  EXPECT_LT(cv::norm(still, exposed, cv::NORM_INF), 1e-6);
  const cv::Mat3f rolled =
      ExposeMoving(renderer, {.rolling_s = 0.02}, [&](double) { return T_wc; });
  EXPECT_EQ(cv::norm(still, rolled, cv::NORM_INF), 0.0);
}

// An edge at z moves f v T / z pixels while the shutter is open: a ramp of that width about
// where it is at the middle.
void ExpectSmear(const Way& expose, double wall_m, double tolerance) {
  const Camera camera;
  const FrameRenderer renderer(OneEdge(wall_m), camera);
  const double shutter_s = 0.04, way_px = camera.fx * kSpeed_mps * shutter_s / kBoard_m;
  const cv::Mat3f blurred = expose(renderer, {.shutter_s = shutter_s, .shutter_samples = 16});
  const std::vector<double> profile = Profile(blurred, 240);
  EXPECT_NEAR(EdgeAt(profile), camera.cx, 0.15);
  for (int u = 0; u < camera.width; ++u) {
    const double ramp = std::clamp((u - camera.cx) / way_px + 0.5, 0.0, 1.0);
    EXPECT_NEAR(profile[static_cast<std::size_t>(u)], ramp, tolerance) << u;
  }
}

TEST(MotionBlur, SmearsAnEdgeOverTheWayItMoves) {
  ExpectSmear(RenderedAgain, kFarWall_m, 1.5 / 16);
  ExpectSmear(RenderedAgain, kNearWall_m, 1.5 / 16);
  ExpectSmear(RenderedOnce, kNearWall_m, 0.06);  // one of 17 taps
}

// The board goes as the camera does: beside it nothing moves, row by row and while the shutter is
// open.
TEST(MotionBlur, LeavesSharpWhatMovesAlongWithTheCamera) {
  const Camera camera;
  Scene scene = OneEdge(kNearWall_m);
  constexpr double kMiddle_s = 1.0;
  const Eigen::Vector3d middle_w = scene.objects[1].center_w;
  for (const double t : {-1.0, 1.0}) {
    scene.objects[1].way.push_back(
        {kMiddle_s + t, middle_w + Eigen::Vector3d(kSpeed_mps * t, 0, 0), 0.0});
  }
  scene.objects[1].center_w = scene.objects[1].way[0].center_w;
  const FrameRenderer renderer(scene, camera);
  const cv::Mat3f seen =
      ExposeMoving(renderer, {.shutter_s = 0.04, .shutter_samples = 8, .rolling_s = 0.03},
                   MovingAlongX, kMiddle_s);
  for (int v = 0; v < camera.height; v += 40) {
    const std::vector<double> profile = Profile(seen, v);
    EXPECT_NEAR(EdgeAt(profile), camera.cx, 0.3) << v;
    for (int u = 0; u < camera.width; ++u) {
      if (std::abs(u - camera.cx) < 2.0) continue;
      EXPECT_NEAR(profile[static_cast<std::size_t>(u)], u < camera.cx ? 0.0 : 1.0, 0.05) << u;
    }
  }
}

// Row v is seen rolling (v / 479 - 1/2) later: its edge lies f V t / z further left.
void ExpectSlant(const Way& expose, double wall_m, double tolerance_px) {
  const Camera camera;
  const FrameRenderer renderer(OneEdge(wall_m), camera);
  const double rolling_s = 0.03;
  const cv::Mat3f slanted = expose(renderer, {.rolling_s = rolling_s});
  const double px_per_s = camera.fx * kSpeed_mps / kBoard_m;
  for (int v = 0; v < camera.height; v += 7) {
    const double expected = camera.cx - px_per_s * rolling_s * (v / 479.0 - 0.5);
    EXPECT_NEAR(EdgeAt(Profile(slanted, v)), expected, tolerance_px) << v;
  }
}

TEST(RollingShutter, SlantsAnEdgeAsTheRowsTimesSay) {
  constexpr double kFourRays_px = 0.26;  // a quarter of a pixel
  constexpr double kHalfBand_px = 4.0 / 479 * 0.03 * 525 * kSpeed_mps / kBoard_m;
  constexpr double kWholePixels_px = 0.5;  // depth is looked up at whole pixels
  ExpectSlant(RenderedAgain, kFarWall_m, kFourRays_px + kHalfBand_px);
  ExpectSlant(RenderedOnce, kNearWall_m, kFourRays_px);
  ExpectSlant(RenderedOnce, kFarWall_m, kFourRays_px + kWholePixels_px);
}

TEST(ExposureDrift, StaysWithinItsStopsAndMovesSmoothly) {
  const Exposure drift{.drift_stops = 0.5};
  double lowest = 9, highest = 0, last = ExposureGain(drift, 3, 0);
  for (double t = 0; t < 200; t += 1 / 30.0) {
    const double gain = ExposureGain(drift, 3, t);
    EXPECT_LE(std::abs(std::log2(gain)), 0.5 + 1e-12);
    // At most 1.5 (smoothstep's steepest) x 2 x 0.5 stops a knot of 1.5 s.
    EXPECT_LE(std::abs(std::log2(gain / last)), 1.5 * 2 * 0.5 / 1.5 / 30.0 + 1e-9);
    lowest = std::min(lowest, gain);
    highest = std::max(highest, gain);
    last = gain;
  }
  EXPECT_GT(highest / lowest, 1.5);
  EXPECT_EQ(ExposureGain({}, 3, 1.0), 1.0);
  EXPECT_NE(ExposureGain(drift, 4, 1.0), ExposureGain(drift, 3, 1.0));
}

}  // namespace
}  // namespace sim
