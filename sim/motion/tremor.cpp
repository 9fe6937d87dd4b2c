#include "sim/motion/tremor.h"

#include <cmath>

#include "sim/base/angle.h"
#include "sim/base/random.h"

namespace sim {
namespace {

constexpr int kWavesPerBand = 6;
constexpr double kBandEdges_hz[3] = {1, 4, 12};
constexpr double kWider[2] = {1.2599210498948732, 1.2009369551760027};  // 4^(1/6), 3^(1/6)

Eigen::Vector3d UnitVector(Random& random) {
  while (true) {
    const double x = random.Between(-1, 1), y = random.Between(-1, 1);
    const Eigen::Vector3d v(x, y, random.Between(-1, 1));
    const double norm = v.norm();
    if (norm > 0.1 && norm <= 1) return v / norm;
  }
}

}  // namespace

Tremor::Tremor(const MotionPreset& preset, std::uint64_t seed) {
  Random random({0x7472656d, seed});
  const auto add_band = [&](int band, double sd, bool steep, std::vector<Wave>& waves,
                            double& bound) {
    std::vector<Wave> added;
    const double low = kBandEdges_hz[band], high = kBandEdges_hz[band + 1];
    double variance = 0, edge_hz = low;
    for (int i = 0; i < kWavesPerBand; ++i) {
      // Where much of the power is in the lowest, each next part of the band is wider.
      const double u = random.Uniform();
      const double frequency = steep ? edge_hz * (1 + (kWider[band] - 1) * u)
                                     : low + (high - low) * (i + u) / kWavesPerBand;
      edge_hz *= kWider[band];
      const double fall = steep ? frequency * frequency * frequency * frequency : frequency;
      added.push_back({frequency, random.Uniform(), UnitVector(random) / fall});
      variance += added.back().amplitude.squaredNorm() / 2;
    }
    for (Wave& wave : added) {
      wave.amplitude *= sd / std::sqrt(variance);
      bound += wave.amplitude.norm();
      waves.push_back(wave);
    }
  };
  add_band(0, preset.slow_tremor_mm / 1000, true, offset_m_, max_offset_m_);
  add_band(1, preset.fast_tremor_mm / 1000, true, offset_m_, max_offset_m_);
  add_band(0, DegToRad(preset.slow_tremor_deg), false, turn_rad_, max_turn_rad_);
  add_band(1, DegToRad(preset.fast_tremor_deg), false, turn_rad_, max_turn_rad_);
}

Eigen::Vector3d Tremor::Sum(const std::vector<Wave>& waves, double time_s) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Wave& wave : waves) {
    const double turns = wave.frequency_hz * time_s + wave.phase_turns;
    sum += wave.amplitude * SinCosDeg(360 * (turns - std::floor(turns))).sin;
  }
  return sum;
}

Eigen::Vector3d Tremor::Offset_m(double time_s) const { return Sum(offset_m_, time_s); }
Eigen::Vector3d Tremor::Turn_rad(double time_s) const { return Sum(turn_rad_, time_s); }

}  // namespace sim
