#include "sim/motion/pattern_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/input_error.h"
#include "sim/motion/pace.h"

namespace sim {
namespace {

constexpr double kCorners_m = 0.05;  // more than the spline cuts corners at the pace of hands
constexpr double kCheckEvery_m = 0.02;
constexpr int kMaxHalves = 8;
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
    : preset_(PresetOf(scene.motion)), space_(scene), tremor_(preset_, seed), seed_(seed) {
  FindWay(scene);
}

bool PatternPath::IsFree(const Pattern& pattern) const {
  const double clearance = kCameraClearance_m + tremor_.MaxOffset_m() + kCorners_m;
  for (int i = 0; i < kSamples; ++i) {
    const View view = pattern.At(static_cast<double>(i) / kSamples, 0);
    if (!space_.Clear(view.camera_w, clearance)) return false;
  }
  return true;
}

void PatternPath::FindWay(const Scene& scene) {
  Random random({0x70617474, seed_});
  for (int i = 0; i < kTries; ++i) {
    // Full size as long as there is hope, then smaller and smaller.
    const double scale = 1 - 0.7 * std::max(0.0, 2.0 * i / kTries - 1);
    const std::shared_ptr<const Pattern> pattern = MakePattern(scene.motion, scale, random);
    const double start = random.Uniform();
    if (!IsFree(*pattern)) {
      // There is but one way.
      if (scene.motion.preset == "loop" && !scene.motion.stations.empty()) break;
      continue;
    }
    const View view = pattern->At(start, 0);
    if (pattern->FacesTarget() && !space_.InSight(view.camera_w, scene.motion.target_w))
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
  Pose T_wc = PoseOf(Along(knots_, time_s / preset_.knot_s));
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

  // Slower where the spline would cut a corner too near to something; else it waits.
  double place = PlaceAfter(last, step_m);
  for (int halves = 1; !KeepsClear(pattern_->At(place, look_)); ++halves) {
    if (halves > kMaxHalves) return knots_.push_back(last);
    place = PlaceAfter(last, std::ldexp(step_m, -halves));
  }
  place_ = place;
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

/// The first place that is far enough; where the way turns back, slower, as a hand does.
double PatternPath::PlaceAfter(const View& last, double step_m) const {
  constexpr int kSteps = 48;
  const double stride = kMaxStride * step_m / round_m_ / kSteps;
  double place = place_;
  for (int i = 0; i < kSteps; ++i) {
    place += stride;
    if ((pattern_->At(place, look_).camera_w - last.camera_w).norm() >= step_m) break;
  }
  return place;
}

/// The spline up to this knot, and as it would be if the camera came to rest there.
bool PatternPath::KeepsClear(const View& next) const {
  if (knots_.empty()) return true;
  const std::size_t n = knots_.size();
  const auto before = [&](std::size_t i) { return knots_[n - std::min(i, n)]; };
  const std::array<View, 6> knots{before(3), before(2), before(1), next, next, next};
  double longest_m = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    longest_m = std::max(longest_m, (knots[i].camera_w - knots[i - 1].camera_w).norm());
  }
  const double checks = 1 + std::ceil(longest_m / kCheckEvery_m);
  for (std::size_t i = 0; i < 3; ++i) {
    const double first = static_cast<double>(n + i) - 3;  // this part of the spline, in knots
    for (double k = 0; k <= checks; ++k) {
      const View view = Blend({knots[i], knots[i + 1], knots[i + 2], knots[i + 3]}, k / checks);
      const double time_s = std::max(0.0, first + k / checks) * preset_.knot_s;
      if (!space_.Clear(view.camera_w + tremor_.Offset_m(time_s), kCameraClearance_m))
        return false;
    }
  }
  return true;
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
