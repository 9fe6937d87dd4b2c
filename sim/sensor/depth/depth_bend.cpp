#include "sim/sensor/depth/depth_bend.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <vector>

#include "sim/base/random.h"
#include "sim/sensor/noise.h"

namespace sim {
namespace {

// The spectrum that gives DepthBend's autocorrelation, in pixels of the camera in which it was
// measured. Along x: cos(2 pi x / wave) exp(-|x| / reach), a Cauchy line; along y a Matern field
// of order 3/2, whose spectrum is Student's t with three degrees of freedom.
constexpr double kMeasuredFocal_px = 525;
constexpr double kWaveX_px = 212, kReachX_px = 158, kReachY_px = 68;
constexpr double kMinWave_px = 24;  // our choice: shorter ones are lost in noise
constexpr int kWaves = 96;  // the field of a device is Gaussian to a per cent in its moments
constexpr double kDrift_frames = 60;  // our choice: the drifting part is new after some 2 s

/// Between knots p is linear: a sixth of the shortest wave, to 2 % of the rms.
int KnotOf(const Camera& camera) {
  constexpr double kKnot_px = 4;  // of the measured camera
  const double scale = std::min(camera.fx, camera.fy) / kMeasuredFocal_px;
  return std::clamp(static_cast<int>(std::lround(kKnot_px * scale)), 1, 4);
}

constexpr double kTurn = 2 * std::numbers::pi;

/// sin(2 pi x), to 1e-7: Taylor's series about 0 after folding to a quarter turn. No libm, so
/// the same bits with every C library.
double SinOfTurns(double turns) {
  double x = turns - std::floor(turns + 0.5);  // [-1/2, 1/2)
  if (x > 0.25) x = 0.5 - x;
  if (x < -0.25) x = -0.5 - x;
  const double a = kTurn * x, b = a * a;
  return a * (1 - b / 6 * (1 - b / 20 * (1 - b / 42 * (1 - b / 72 * (1 - b / 110)))));
}
double CosOfTurns(double turns) { return SinOfTurns(turns + 0.25); }

struct Wave {
  double u = 0, v = 0;   ///< turns a pixel of the measured camera
  double phase = 0;      ///< turns
  double frequency = 0;  ///< turns a frame
};

/// A wave of the spectrum above.
Wave DrawWave(Random& random) {
  Wave wave;
  do {
    // Half turns stay clear of the tangent's poles.
    const double half = 0.5 * (0.999 * random.Uniform() + 0.0005);
    const double cauchy = -CosOfTurns(half) / SinOfTurns(half);
    wave.u = 1 / kWaveX_px + cauchy / (kTurn * kReachX_px);
    const double n = NormalDraw(random), a = NormalDraw(random), b = NormalDraw(random),
                 c = NormalDraw(random);
    wave.v = n / std::sqrt((a * a + b * b + c * c) / 3) / (kTurn * kReachY_px);
  } while (wave.u * wave.u + wave.v * wave.v > 1 / (kMinWave_px * kMinWave_px));
  wave.phase = random.Uniform();
  wave.frequency = NormalDraw(random) / kDrift_frames;
  return wave;
}

std::array<Wave, kWaves> Waves(std::uint64_t key, std::uint64_t part) {
  Random random{key, 0xBE4Dull, part};
  std::array<Wave, kWaves> waves;
  for (Wave& wave : waves) wave = DrawWave(random);
  return waves;
}

/// Adds the waves to knots `step` pixels apart, the first at pixel (0, 0).
void AddWaves(const std::array<Wave, kWaves>& waves, double rms, double frame,
              const Camera& camera, int step, cv::Mat1f& knots) {
  const double amplitude = rms * std::sqrt(2.0 / kWaves);
  const double scale_u = kMeasuredFocal_px / camera.fx, scale_v = kMeasuredFocal_px / camera.fy;
  std::vector<float> cos_u(static_cast<std::size_t>(knots.cols)), sin_u(cos_u.size());
  for (const Wave& wave : waves) {
    for (int i = 0; i < knots.cols; ++i) {
      const double turns = wave.u * scale_u * (step * i - camera.cx);
      cos_u[static_cast<std::size_t>(i)] = static_cast<float>(CosOfTurns(turns));
      sin_u[static_cast<std::size_t>(i)] = static_cast<float>(SinOfTurns(turns));
    }
    for (int j = 0; j < knots.rows; ++j) {
      const double turns =
          wave.v * scale_v * (step * j - camera.cy) + wave.phase + wave.frequency * frame;
      const auto c = static_cast<float>(amplitude * CosOfTurns(turns));
      const auto s = static_cast<float>(amplitude * SinOfTurns(turns));
      float* row = knots[j];
      for (int i = 0; i < knots.cols; ++i) {
        const auto at = static_cast<std::size_t>(i);
        row[i] += c * cos_u[at] - s * sin_u[at];  // cos(a + b)
      }
    }
  }
}

double DeviceRms(const DepthBend& bend) { return bend.rms * std::sqrt(1 - bend.drift_share); }

std::array<Wave, kWaves> DeviceWaves(const DepthBend& bend, std::uint64_t seed) {
  const bool named = bend.device != 0;
  return Waves(named ? static_cast<std::uint64_t>(bend.device) : seed, named ? 1 : 2);
}

/// The device's part of the knots. All frames of a recording share it: each thread keeps its last.
const cv::Mat1f& DeviceKnots(const DepthBend& bend, const Camera& camera, std::uint64_t seed) {
  using Key =
      std::tuple<double, double, int, std::uint64_t, int, int, double, double, double, double>;
  const Key key{bend.rms,      bend.drift_share, bend.device, seed,      camera.width,
                camera.height, camera.fx,        camera.fy,   camera.cx, camera.cy};
  thread_local std::optional<Key> made_for;
  thread_local cv::Mat1f knots;
  if (made_for != key) {
    const int knot_px = KnotOf(camera);
    knots = cv::Mat1f(camera.height / knot_px + 2, camera.width / knot_px + 2, 0.0F);
    AddWaves(DeviceWaves(bend, seed), DeviceRms(bend), 0, camera, knot_px, knots);
    made_for = key;
  }
  return knots;
}

}  // namespace

BendField::BendField(const DepthBend& bend, const Camera& camera, std::uint64_t seed,
                     std::uint64_t frame)
    : knot_px_(KnotOf(camera)), knots_(DeviceKnots(bend, camera, seed).clone()) {
  AddWaves(Waves(seed, 3), bend.rms * std::sqrt(bend.drift_share), static_cast<double>(frame),
           camera, knot_px_, knots_);
}

void BendField::Row(int v, std::span<float> p) const {
  const auto knot = static_cast<float>(knot_px_);
  const auto part_v = static_cast<float>(v % knot_px_) / knot;
  const float* above = knots_[v / knot_px_];
  const float* below = knots_[v / knot_px_ + 1];
  for (std::size_t u = 0; u < p.size(); ++u) {
    const std::size_t i = u / static_cast<std::size_t>(knot_px_);
    const float left = above[i] + part_v * (below[i] - above[i]);
    const float right = above[i + 1] + part_v * (below[i + 1] - above[i + 1]);
    p[u] = left +
           static_cast<float>(u % static_cast<std::size_t>(knot_px_)) / knot * (right - left);
  }
}

cv::Mat1f DevicePattern(const DepthBend& bend, const Camera& camera, std::uint64_t seed) {
  cv::Mat1f pattern(camera.height, camera.width, 0.0F);
  AddWaves(DeviceWaves(bend, seed), DeviceRms(bend), 0, camera, 1, pattern);
  return pattern;
}

}  // namespace sim
