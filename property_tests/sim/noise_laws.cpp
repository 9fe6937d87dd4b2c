#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <opencv2/core.hpp>

#include "property_tests/sim/render_worlds.h"
#include "sim/sensor/sensor.h"

namespace sim {
namespace {

bool Equal(const cv::Mat1d& a, const cv::Mat1d& b) { return Same(a, b); }

std::uint64_t AnySeed() { return *rc::gen::arbitrary<std::uint64_t>(); }

RC_GTEST_PROP(PixelNoise, IsTheSameInAnyOrder, ()) {
  const std::uint64_t seed = AnySeed(), frame = AnySeed() % 100000;
  const PixelNoise noise(seed, frame);
  const int u = *rc::gen::inRange(-2, 700), v = *rc::gen::inRange(-2, 500);
  const auto draw = *rc::gen::inRange<std::uint32_t>(0, 16);
  const double first = noise.Normal(u, v, draw);
  noise.Normal(*rc::gen::inRange(0, 700), 3, 1);
  RC_ASSERT(PixelNoise(seed, frame).Normal(u, v, draw) == first);
}

RC_GTEST_PROP(PixelNoise, DiffersBetweenSeedsFramesPixelsAndDraws, ()) {
  const std::uint64_t seed = AnySeed(), frame = AnySeed() % 100000;
  const int u = *rc::gen::inRange(0, 700), v = *rc::gen::inRange(0, 500);
  const double x = PixelNoise(seed, frame).Uniform(u, v, 0);
  RC_ASSERT(PixelNoise(seed + 1, frame).Uniform(u, v, 0) != x);
  RC_ASSERT(PixelNoise(seed, frame + 1).Uniform(u, v, 0) != x);
  RC_ASSERT(PixelNoise(seed, frame).Uniform(v, u + 701, 0) != x);
  RC_ASSERT(PixelNoise(seed, frame).Uniform(u, v, 1) != x);
}

RC_GTEST_PROP(MeasuredDepth, IsDecidedBySeedAndFrameAlone, ()) {
  const Rendering rendering =
      FrameRenderer(AnyScene(), SmallCamera())
          .Render(AnyView(), {.colour = false, .projector_offset_m = 0.075});
  const std::uint64_t seed = AnySeed();
  const cv::Mat1d a = MeasureDepth(rendering, {}, PixelNoise(seed, 3));
  MeasureDepth(rendering, {}, PixelNoise(seed, 2));
  RC_ASSERT(Equal(MeasureDepth(rendering, {}, PixelNoise(seed, 3)), a));
}

RC_GTEST_PROP(MeasuredDepth, IsExactWithEveryEffectSwitchedOff, ()) {
  const Rendering rendering =
      FrameRenderer(AnyScene(), SmallCamera()).Render(AnyView(), {.colour = false});
  const KinectModel off{.min_depth_m = 0,
                        .max_depth_m = 1e9,
                        .max_incidence_rad = 4,
                        .noise_scale = 0,
                        .lateral_scale = 0,
                        .quantise = false};
  RC_ASSERT(Equal(MeasureDepth(rendering, off, PixelNoise(AnySeed(), 0)), rendering.depth_m));
}

RC_GTEST_PROP(MeasuredDepth, IsNeverInventedWhereNothingIsSeen, ()) {
  const Rendering rendering =
      FrameRenderer(AnyScene(), SmallCamera()).Render(AnyView(), {.colour = false});
  const cv::Mat1d z = MeasureDepth(rendering, {}, PixelNoise(AnySeed(), 0));
  for (int v = 0; v < z.rows; ++v) {
    for (int u = 0; u < z.cols; ++u) {
      if (rendering.depth_m(v, u) == 0) RC_ASSERT(z(v, u) == 0);
      RC_ASSERT(std::isfinite(z(v, u)) && z(v, u) >= 0);
    }
  }
}

DepthModel AnySensor() {
  return Sensor(*rc::gen::element(SensorKind::kIdeal, SensorKind::kKinect1,
                                  SensorKind::kKinect1Clean, SensorKind::kAzure,
                                  SensorKind::kD435))
      .depth;
}

RC_GTEST_PROP(EverySensor, IsDecidedBySeedAndFrameAndInventsNothing, ()) {
  const DepthModel model = AnySensor();
  const Camera camera = SmallCamera();
  const Rendering rendering =
      FrameRenderer(AnyScene(), camera)
          .Render(AnyView(), {.colour = false, .projector_offset_m = SecondEyeOffset(model)});
  const std::uint64_t seed = AnySeed();
  const cv::Mat1d z = MeasureDepth(rendering, model, camera, seed, 3);
  MeasureDepth(rendering, model, camera, seed, 2);
  RC_ASSERT(Equal(MeasureDepth(rendering, model, camera, seed, 3), z));
  bool any = false;
  for (int v = 0; v < z.rows; ++v) {
    for (int u = 0; u < z.cols; ++u) {
      RC_ASSERT(std::isfinite(z(v, u)) && z(v, u) >= 0);
      if (rendering.depth_m(v, u) == 0) RC_ASSERT(z(v, u) == 0);
      any = any || z(v, u) > 0;
    }
  }
  const bool ideal = std::holds_alternative<IdealModel>(model);
  const bool differs = !Equal(MeasureDepth(rendering, model, camera, seed + 1, 3), z);
  RC_ASSERT(differs == (any && !ideal));
}

/// A model with everything switched off that its header says can be.
DepthModel AnySwitchedOff() {
  const KinectModel kinect{.min_depth_m = 0,
                           .max_depth_m = 1e9,
                           .max_incidence_rad = 4,
                           .noise_scale = 0,
                           .lateral_scale = 0,
                           .quantise = false};
  AzureModel azure{.min_depth_m = 0, .max_depth_m = 1e9, .noise_scale = 0, .lateral_px = 0};
  azure.flying_pixels = azure.hexagon = false;
  azure.multipath_m = azure.multipath_loss = azure.wiggle_m = azure.session_offset_m = 0;
  azure.rounding_m = 0;
  D435Model d435{.baseline_m = 0, .subpixel_px = 0, .grid_px = 0, .ripple_px = 0};
  d435.fattening_px = 0;
  d435.min_share = d435.min_depth_m = d435.rounding_m = 0;
  d435.max_depth_m = 1e9;
  switch (AnyInt(0, 2)) {
    case 0:
      return kinect;
    case 1:
      return azure;
    default:
      return d435;
  }
}

RC_GTEST_PROP(EverySensor, SwitchedOffGivesTheExactDepthBack, ()) {
  const Rendering rendering =
      FrameRenderer(AnyScene(), SmallCamera()).Render(AnyView(), {.colour = false});
  const DepthModel off = AnySwitchedOff();
  RC_ASSERT(
      Equal(MeasureDepth(rendering, off, SmallCamera(), AnySeed(), 0), rendering.depth_m));
}

}  // namespace
}  // namespace sim
