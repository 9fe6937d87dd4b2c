#include "sim/sensor/sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sim {
namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

// What a recording of the first Kinect has besides noise.
/// Colour is read row by row over the whole frame: at 30 frames/s, its sensor (MT9M112) reads
/// without a pause.
constexpr double kRolling_s = 0.030;
constexpr double kIndoorShutter_s = 0.015;    // our choice: half a frame, under lamps
constexpr double kAutoExposure_stops = 0.25;  // our choice
constexpr double kDropRatio = 0.04;           // gaps over 45 ms in TUM fr1/desk: 4.0 %
constexpr double kRepeatRatio = 0.005;        // our choice
/// In TUM fr1/desk depth and colour are 11.7 ms apart (median), 19.7 ms at most.
constexpr double kDepthOffset_s = 0.015;
constexpr double kRegistration_px = 1.5;    // our choice: usual calibrations leave 1 to 2 px
constexpr double kIntrinsicsError = 0.003;  // our choice: between calibrations of one device
/// As calibrated for TUM fr1 (Sturm et al., IROS 2012).
constexpr Lens kCalibratedLens{
    .k1 = 0.2624, .k2 = -0.9531, .p1 = -0.0054, .p2 = 0.0026, .k3 = 1.1633};

/// The frame number of what is drawn once a recording.
constexpr std::uint64_t kSession = std::numeric_limits<std::uint64_t>::max();

DepthModel ModelOf(SensorKind kind) {
  switch (kind) {
    case SensorKind::kKinect1:
      return RecordedKinect();
    case SensorKind::kKinect1Clean:
      return KinectModel{};
    case SensorKind::kAzure:
      return AzureModel{};
    case SensorKind::kD435:
      return D435Model{};
    case SensorKind::kIdeal:
      break;
  }
  return IdealModel{};
}

const char* NameOf(SensorKind kind) {
  switch (kind) {
    case SensorKind::kKinect1:
      return "kinect1";
    case SensorKind::kKinect1Clean:
      return "kinect1-clean";
    case SensorKind::kAzure:
      return "azure";
    case SensorKind::kD435:
      return "d435";
    case SensorKind::kIdeal:
      break;
  }
  return "ideal";
}

DepthBend BendOf(const DepthModel& model) {
  return std::visit(Overloaded{[](const IdealModel&) { return DepthBend{}; },
                               [](const auto& m) { return m.bend; }},
                    model);
}

/// What a device that bends sees instead.
Rendering Bent(const Rendering& rendering, const DepthBend& bend, const Camera& camera,
               std::uint64_t seed, std::uint64_t frame) {
  if (bend.rms == 0) return rendering;
  const BendField field(bend, camera, seed, frame);
  std::vector<float> p(static_cast<std::size_t>(rendering.depth_m.cols));
  Rendering bent = rendering;  // images are shared
  bent.depth_m = rendering.depth_m.clone();
  for (int v = 0; v < bent.depth_m.rows; ++v) {
    field.Row(v, p);
    double* z = bent.depth_m[v];
    for (std::size_t u = 0; u < p.size(); ++u) z[u] *= 1.0 + static_cast<double>(p[u]);
  }
  return bent;
}

}  // namespace

Sensor::Sensor(SensorKind kind)
    : base(NameOf(kind)),
      name(base),
      depth(ModelOf(kind)),
      colour(kind == SensorKind::kIdeal ? CleanColour() : ColourModel{}) {
  if (kind != SensorKind::kKinect1) return;
  // As recorded: what the recordings of the first Kinect have (docs/sensors.md).
  colour.reflections = 1;
  exposure = {.shutter_s = kIndoorShutter_s,
              .rolling_s = kRolling_s,
              .drift_stops = kAutoExposure_stops};
  timing = {
      .drop_ratio = kDropRatio, .repeat_ratio = kRepeatRatio, .depth_offset_s = kDepthOffset_s};
  calibration = {.registration_px = kRegistration_px, .intrinsics = kIntrinsicsError};
  lens = kCalibratedLens;
}

std::uint64_t DeviceOf(const DepthModel& model, std::uint64_t seed) {
  const DepthBend bend = BendOf(model);
  return bend.device != 0 ? static_cast<std::uint64_t>(bend.device) : seed;
}

cv::Mat1f DevicePattern(const DepthModel& model, const Camera& camera, std::uint64_t seed) {
  const DepthBend bend = BendOf(model);
  if (bend.rms == 0) return {};
  return DevicePattern(bend, camera, seed);
}

double SecondEyeOffset(const DepthModel& model) {
  return std::visit(Overloaded{[](const IdealModel&) { return 0.0; },
                               [](const KinectModel& m) { return m.projector_offset_m; },
                               [](const AzureModel&) { return 0.0; },
                               [](const D435Model& m) { return m.baseline_m; }},
                    model);
}

double DepthSigma(const DepthModel& model, double z_m, double theta_rad) {
  return std::visit(
      Overloaded{
          [](const IdealModel&) { return 0.0; },
          [&](const KinectModel& m) { return m.noise_scale * AxialSigma(z_m, theta_rad); },
          [&](const AzureModel& m) {
            return m.noise_scale * AzureSigma(z_m, std::cos(theta_rad), m.reflectivity);
          },
          [&](const D435Model& m) { return D435Sigma(z_m, m); }},
      model);
}

double DepthStep(const DepthModel& model, double z_m) {
  return std::visit(Overloaded{[](const IdealModel&) { return 0.0; },
                               [&](const KinectModel& m) {
                                 return m.quantise ? z_m * z_m / m.disparity_m_steps : 0.0;
                               },
                               [](const AzureModel& m) { return m.rounding_m; },
                               [&](const D435Model& m) {
                                 return std::max(m.rounding_m,
                                                 z_m * z_m * m.grid_px / m.focal_baseline_px_m);
                               }},
                    model);
}

double DepthBias(const DepthModel& model, double z_m) {
  const auto wave = [](double turns) { return std::sin(2.0 * std::numbers::pi * turns); };
  return std::visit(
      Overloaded{
          [](const IdealModel&) { return 0.0; }, [](const KinectModel&) { return 0.0; },
          [&](const AzureModel& m) { return m.wiggle_m * wave(z_m / m.wiggle_period_m); },
          [&](const D435Model& m) {
            const double disparity = m.focal_baseline_px_m / z_m;
            return m.focal_baseline_px_m / (disparity + m.ripple_px * wave(disparity)) - z_m;
          }},
      model);
}

cv::Mat1d MeasureDepth(const Rendering& rendering, const DepthModel& model,
                       const Camera& camera, std::uint64_t seed, std::uint64_t frame) {
  const PixelNoise noise(seed, frame);
  return std::visit(
      Overloaded{[&](const IdealModel&) { return rendering.depth_m; },
                 [&](const KinectModel& m) {
                   if (m.bend.rms == 0) return MeasureDepth(rendering, m, noise);
                   const BendField bend(m.bend, camera, seed, frame);
                   return MeasureDepth(rendering, m, noise, &bend);
                 },
                 [&](const AzureModel& m) {
                   return MeasureDepth(Bent(rendering, m.bend, camera, seed, frame), m, camera,
                                       noise, PixelNoise(seed, kSession));
                 },
                 [&](const D435Model& m) {
                   return MeasureDepth(Bent(rendering, m.bend, camera, seed, frame), m, camera,
                                       noise);
                 }},
      model);
}

}  // namespace sim
