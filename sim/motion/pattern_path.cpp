#include "sim/motion/pattern_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/input_error.h"
#include "sim/motion/pace.h"

namespace sim {
namespace {

constexpr double kCorners_m = 0.05;  // more than the spline cuts corners, and the tests miss
constexpr std::size_t kPatternKnotsPerPace = 4;
constexpr double kSpread = 0.7, kLittleSpread = 0.1;
constexpr double kMaxStride = 1.1;  // along the way, against the mean
constexpr int kSamples = 400, kTries = 3000;
constexpr double kShortestRound_m = 1e-3;

}  // namespace

bool PatternPath::Has(const std::string& preset) {
  for (const char* one : {"xyz", "rpy", "360", "orbit", "loop", "lookaway"}) {
    if (preset == one) return true;
  }
  return false;
}

PatternPath::PatternPath(const Scene& scene, std::uint64_t seed)
    : preset_(PresetOf(scene.motion)), tremor_(preset_, seed), seed_(seed) {
  FindWay(scene);
}

bool PatternPath::IsFree(const Pattern& pattern, const FreeSpace& space) const {
  const double clearance = kCameraClearance_m + tremor_.MaxOffset_m() + kCorners_m;
  for (int i = 0; i < kSamples; ++i) {
    const View view = pattern.At(static_cast<double>(i) / kSamples, 0);
    if (!space.Clear(view.camera_w, clearance)) return false;
  }
  return true;
}

void PatternPath::FindWay(const Scene& scene) {
  const FreeSpace space(scene);
  Random random({0x70617474, seed_});
  for (int i = 0; i < kTries; ++i) {
    // Full size as long as there is hope, then smaller and smaller.
    const double scale = 1 - 0.7 * std::max(0.0, 2.0 * i / kTries - 1);
    const std::shared_ptr<const Pattern> pattern = MakePattern(scene.motion, scale, random);
    const double start = random.Uniform();
    if (!IsFree(*pattern, space)) {
      if (!scene.motion.stations.empty()) break;  // there is but one way
      continue;
    }
    const View view = pattern->At(start, 0);
    if (pattern->FacesTarget() && !space.InSight(view.camera_w, scene.motion.target_w))
      continue;
    pattern_ = pattern;
    place_ = start;
    look_ = random.Uniform();
    round_m_ = 0;
    for (int k = 0; k < kSamples; ++k) {
      const double at = static_cast<double>(k) / kSamples;
      round_m_ +=
          (pattern->At(at + 1.0 / kSamples, 0).camera_w - pattern->At(at, 0).camera_w).norm();
    }
    if (!(round_m_ > kShortestRound_m)) {
      throw io::InputError("motion", "the way of preset '" + scene.motion.preset +
                                         "' has no length; widen azimuth_*_deg, pitch_*_deg or "
                                         "distance_*_m, or move the stations apart");
    }
    for (int k = 0; k < 4; ++k) AddKnot();
    return;
  }
  throw io::InputError("motion", "the way of preset '" + scene.motion.preset +
                                     "' comes within 15 cm of a surface; widen distance_*_m or "
                                     "pitch_*_deg, or move target_m or the stations");
}

Pose PatternPath::At(double time_s) {
  const auto last = static_cast<std::size_t>(time_s / preset_.knot_s) + 3;
  while (knots_.size() <= last) AddKnot();
  return Shaken(time_s);
}

Pose PatternPath::Shaken(double time_s) const {
  const double at = time_s / preset_.knot_s;
  const auto i = static_cast<std::size_t>(at);
  const View view = Blend({knots_[i], knots_[i + 1], knots_[i + 2], knots_[i + 3]},
                          at - static_cast<double>(i));
  Pose T_wc = PoseOf(view);
  const Eigen::Vector3d half = tremor_.Turn_rad(time_s) / 2;
  T_wc.R *= Eigen::Quaterniond(1, half.x(), half.y(), half.z()).normalized().toRotationMatrix();
  T_wc.t += tremor_.Offset_m(time_s);
  return T_wc;
}

void PatternPath::AddKnot() {
  Measure();
  const auto wanted = [&](double rate, double behind) {
    return rate * preset_.knot_s * std::clamp(1 + behind / (rate * 2), 0.1, 3.0);
  };
  // In bursts: of means 1, turns mostly slower and at times thrice as fast.
  Random random({0x6d6f6f64, seed_, knots_.size() / kKnotsPerBurst});
  const double spread = pattern_->GoesUnevenly() ? kLittleSpread : kSpread;
  const double mood = random.Uniform(),
               pace = PaceAt(seed_, knots_.size(), kPatternKnotsPerPace, spread);
  const double turn_pace = pattern_->TurnsUnevenly() ? 1 : 0.12 + 3.52 * mood * mood * mood;
  const double step_m = pace * wanted(preset_.speed_m_s, length_behind_m_);
  const double turn_deg = turn_pace * wanted(preset_.turn_deg_s, turn_behind_deg_);
  const View last = knots_.empty() ? pattern_->At(place_, look_) : knots_.back();

  // The first place that is far enough; where the way turns back, slower, as a hand does.
  constexpr int kSteps = 48;
  const double stride = kMaxStride * step_m / round_m_ / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    place_ += stride;
    if ((pattern_->At(place_, look_).camera_w - last.camera_w).norm() >= step_m) break;
  }
  // The first look that turns by what is wanted, else the one that turns most.
  constexpr int kLooks = 120;
  constexpr double kMaxLook = 0.30;
  const Pose T_last = PoseOf(last);
  double most_deg = -1, best = look_;
  for (int i = 0; i <= kLooks && most_deg < turn_deg; ++i) {
    const double look = look_ + kMaxLook * i / kLooks;
    const double turned_deg = TurnBetween_deg(T_last, PoseOf(pattern_->At(place_, look)));
    if (turned_deg <= most_deg) continue;
    most_deg = turned_deg;
    best = look;
  }
  look_ = best;
  knots_.push_back(pattern_->At(place_, look_));
}

void PatternPath::Measure() {
  if (knots_.size() < 4) return;
  const double known_s = static_cast<double>(knots_.size() - 3) * preset_.knot_s;
  while ((measured_samples_ + 1) * kPresetSample_s < known_s) {
    const Pose T_before = Shaken(measured_samples_ * kPresetSample_s);
    const Pose T_after = Shaken(++measured_samples_ * kPresetSample_s);
    length_behind_m_ += preset_.speed_m_s * kPresetSample_s - (T_after.t - T_before.t).norm();
    turn_behind_deg_ +=
        preset_.turn_deg_s * kPresetSample_s - TurnBetween_deg(T_before, T_after);
  }
}

}  // namespace sim
