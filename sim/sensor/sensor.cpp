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

/// The frame number of what is drawn once a recording.
constexpr std::uint64_t kSession = std::numeric_limits<std::uint64_t>::max();

DepthModel ModelOf(SensorKind kind) {
  switch (kind) {
    case SensorKind::kKinect1:
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
    case SensorKind::kAzure:
      return "azure";
    case SensorKind::kD435:
      return "d435";
    case SensorKind::kIdeal:
      break;
  }
  return "ideal";
}

}  // namespace

Sensor::Sensor(SensorKind kind)
    : name(NameOf(kind)),
      depth(ModelOf(kind)),
      colour(kind == SensorKind::kIdeal ? CleanColour() : ColourModel{}) {}

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
                   return MeasureDepth(rendering, m, camera, noise, PixelNoise(seed, kSession));
                 },
                 [&](const D435Model& m) { return MeasureDepth(rendering, m, camera, noise); }},
      model);
}

}  // namespace sim
