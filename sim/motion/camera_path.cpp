#include "sim/motion/camera_path.h"

#include <algorithm>
#include <cmath>

#include "io/input_error.h"
#include "sim/base/angle.h"
#include "sim/motion/pace.h"

namespace sim {
namespace {

constexpr double kLeadIn_s = 8;  // the first frame is in the middle of the motion
constexpr double kChecksPerSegment = 16;
constexpr double kBetweenChecks_m = 0.02;  // more than the way between two checks
constexpr std::size_t kPathKnotsPerPace = 8;
constexpr double kPaceSpread = 0.5;
constexpr double kRounding = 1e-9;  // metres, radians
constexpr int kStartTries = 20000, kCandidates = 240, kRetreats = 4;

/// Half the room that a limit leaves, but no more than `margin`.
double Margin(double low, double high, double margin) {
  return std::min(margin, (high - low) / 4);
}

double PitchBelowHorizon_rad(const Eigen::Vector3d& forward_w) {
  return AsinRad(-forward_w.z() / forward_w.norm());
}

double Azimuth_rad(const Eigen::Vector3d& forward_w) {
  return Atan2Rad(-forward_w.x(), forward_w.y());
}

/// From what is looked at to the camera.
Eigen::Vector3d Backward(double azimuth_rad, double pitch_rad) {
  const SinCos azimuth = SinCosDeg(RadToDeg(azimuth_rad)),
               pitch = SinCosDeg(RadToDeg(pitch_rad));
  return {azimuth.sin * pitch.cos, -azimuth.cos * pitch.cos, pitch.sin};
}

/// Hands turn in bursts: mostly slower than the mean, at times more than twice as fast.
double TurnPace(std::uint64_t seed, std::size_t knot) {
  const double mood = Random({0x6d6f6f64, seed, knot / kKnotsPerBurst}).Uniform();
  return 0.25 + 2.25 * mood * mood;  // mean 1
}

Eigen::Vector3d InUnitBall(Random& random) {
  while (true) {
    const double x = random.Between(-1, 1), y = random.Between(-1, 1);
    Eigen::Vector3d v(x, y, random.Between(-1, 1));
    if (v.squaredNorm() <= 1) return v;
  }
}

}  // namespace

CameraPath::CameraPath(const Scene& scene, std::uint64_t seed)
    : motion_(scene.motion),
      preset_(PresetOf(scene.motion)),
      space_(scene),
      tremor_(preset_, seed),
      seed_(seed) {
  FindStart();
}

Pose CameraPath::At(double time_s) {
  const double path_time_s = kLeadIn_s + time_s;
  const auto last = static_cast<std::size_t>(path_time_s / preset_.knot_s) + 3;
  while (knots_.size() <= last) AddKnot();
  return Shaken(path_time_s);
}

View CameraPath::Smooth(double path_time_s) const {
  return Along(knots_, path_time_s / preset_.knot_s);
}

Pose CameraPath::Shaken(double path_time_s) const {
  Pose T_wc = PoseOf(Smooth(path_time_s));
  const Eigen::Vector3d half = tremor_.Turn_rad(path_time_s) / 2;
  T_wc.R *= Eigen::Quaterniond(1, half.x(), half.y(), half.z()).normalized().toRotationMatrix();
  T_wc.t += tremor_.Offset_m(path_time_s);
  return T_wc;
}

bool CameraPath::KnotFits(const View& view) const {
  const Eigen::Vector3d way = view.gaze_w - view.camera_w;
  const auto within = [](double x, double low, double high, double margin) {
    const double m = Margin(low, high, margin);
    return x >= low + m - kRounding && x <= high - m + kRounding;
  };
  const double azimuth_rad = Azimuth_rad(way);
  return within(way.norm(), motion_.distance_min_m, motion_.distance_max_m, 0.03) &&
         within(azimuth_rad, motion_.azimuth_min_rad, motion_.azimuth_max_rad, 0.02) &&
         within(PitchBelowHorizon_rad(way), motion_.pitch_min_rad, motion_.pitch_max_rad,
                tremor_.MaxTurn_rad() + 0.01) &&
         (view.gaze_w - motion_.target_w).norm() <= motion_.target_spread_m &&
         std::abs(view.roll_deg) <= preset_.max_roll_deg;
}

bool CameraPath::SegmentIsSafe(const Segment& segment) const {
  const double clearance = kCameraClearance_m + tremor_.MaxOffset_m() + kBetweenChecks_m;
  const double low = motion_.pitch_min_rad, high = motion_.pitch_max_rad;
  // Limits too narrow for a moving hand are kept by the knots alone.
  const double margin = Margin(low, high, tremor_.MaxTurn_rad());
  const double slack = std::max(0.0, DegToRad(1.5) - (high - low) / 4);
  for (double i = 0; i <= kChecksPerSegment; ++i) {
    const View view = Blend(segment, i / kChecksPerSegment);
    const double pitch = PitchBelowHorizon_rad(view.gaze_w - view.camera_w);
    if (!(pitch >= low + margin - slack && pitch <= high - margin + slack)) return false;
    if (!space_.Clear(view.camera_w, clearance)) return false;
  }
  return true;
}

bool CameraPath::IsSafe(const View& next) const {
  const std::size_t n = knots_.size();
  const View &a = knots_[n - 3], &b = knots_[n - 2], &c = knots_[n - 1];
  return SegmentIsSafe({a, b, c, next}) && SegmentIsSafe({b, c, next, next}) &&
         SegmentIsSafe({c, next, next, next});
}

void CameraPath::FindStart() {
  if (motion_.target_spread_m == 0 && motion_.distance_min_m == motion_.distance_max_m &&
      motion_.azimuth_min_rad == motion_.azimuth_max_rad &&
      motion_.pitch_min_rad == motion_.pitch_max_rad) {
    throw io::InputError("motion",
                         "leaves the camera no way: every limit has no width; widen "
                         "distance_*_m, azimuth_*_deg, pitch_*_deg or target_spread_m");
  }
  Random random({0x7374617274, seed_});
  for (int i = 0; i < kStartTries; ++i) {
    const double azimuth_rad = random.Between(motion_.azimuth_min_rad, motion_.azimuth_max_rad);
    const double pitch_rad = random.Between(motion_.pitch_min_rad, motion_.pitch_max_rad);
    const double distance = random.Between(motion_.distance_min_m, motion_.distance_max_m);
    View view;
    view.gaze_w =
        motion_.target_w + 0.5 * motion_.target_spread_m *
                               InUnitBall(random).cwiseProduct(Eigen::Vector3d(1, 1, 0));
    view.camera_w = view.gaze_w + distance * Backward(azimuth_rad, pitch_rad);
    if (!SegmentIsSafe({view, view, view, view})) continue;
    if (!space_.InSight(view.camera_w, view.gaze_w)) continue;
    knots_.assign(4, view);
    return;
  }
  throw io::InputError(
      "motion",
      "leaves the camera no place 15 cm from every surface; widen distance_*_m, "
      "azimuth_*_deg or pitch_*_deg, or move target_m");
}

View CameraPath::Nearby(double step_m, double turn_deg, double swerve, Random& random) const {
  const View& last = knots_.back();
  const View& before = knots_[knots_.size() - 2];
  const auto onward = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const double norm = (to - from).norm();
    const Eigen::Vector3d heading =
        norm > 1e-6 ? Eigen::Vector3d((to - from) / norm) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d direction = heading + swerve * InUnitBall(random);
    return Eigen::Vector3d(direction / std::max(direction.norm(), 1e-3));
  };
  View view = last;
  view.camera_w += step_m * onward(before.camera_w, last.camera_w);
  const Eigen::Vector3d gaze = onward(before.gaze_w, last.gaze_w);
  const double way_m = (last.gaze_w - last.camera_w).norm();
  const double reach_m = std::max(1.6 * step_m, 2.2 * DegToRad(turn_deg) * way_m);
  view.gaze_w += reach_m * random.Uniform() * gaze.cwiseProduct(Eigen::Vector3d(1, 1, 0));
  const double roll_step = random.Between(-1, 1) * turn_deg * 0.8;
  view.roll_deg += 0.7 * (last.roll_deg - before.roll_deg) + roll_step;
  return Held(view);
}

View CameraPath::Held(View view) const {
  const Motion& m = motion_;
  if (m.target_spread_m == 0) view.gaze_w = m.target_w;
  const bool distance = m.distance_min_m == m.distance_max_m;
  const bool azimuth = m.azimuth_min_rad == m.azimuth_max_rad;
  const bool pitch = m.pitch_min_rad == m.pitch_max_rad;
  if (!distance && !azimuth && !pitch) return view;
  const Eigen::Vector3d way = view.gaze_w - view.camera_w;
  view.camera_w =
      view.gaze_w + (distance ? m.distance_min_m : way.norm()) *
                        Backward(azimuth ? m.azimuth_min_rad : Azimuth_rad(way),
                                 pitch ? m.pitch_min_rad : PitchBelowHorizon_rad(way));
  return view;
}

std::vector<View> CameraPath::Candidates(double step_m, double turn_deg, Random& random) const {
  const View& last = knots_.back();
  const Pose T_last = PoseOf(last);
  const Eigen::Vector3d heading = last.camera_w - knots_[knots_.size() - 2].camera_w;
  const double distance_range = motion_.distance_max_m - motion_.distance_min_m;
  const double wanted_distance = WantedDistance_m();

  std::vector<std::pair<double, View>> scored;
  for (int i = 0; i < kCandidates; ++i) {
    const double swerve = 0.4 + 3.0 * i / kCandidates;  // from nearly straight to a turn back
    const View view = Nearby(step_m, turn_deg, swerve, random);
    if (!KnotFits(view)) continue;
    const double off = TurnBetween_deg(T_last, PoseOf(view)) / std::max(turn_deg, 1e-3) - 1;
    const Eigen::Vector3d way = view.camera_w - last.camera_w;
    const double bend = 1 - way.dot(heading) / std::max(way.norm() * heading.norm(), 1e-9);
    const double astray = std::abs((view.gaze_w - view.camera_w).norm() - wanted_distance) /
                          std::max(distance_range, 1e-3);
    scored.emplace_back(1.5 * std::abs(off) + 6 * bend + 0.5 * astray + 0.1 * random.Uniform(),
                        view);
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<View> views;
  views.reserve(scored.size());
  for (const auto& [score, view] : scored) views.push_back(view);
  return views;
}

double CameraPath::WantedDistance_m() const {
  constexpr double kPeriods_s[2] = {11, 29};
  Random random({0x6e656172, seed_});
  double wave = 0;
  for (const double period_s : kPeriods_s) {
    const double turns =
        static_cast<double>(knots_.size()) * preset_.knot_s / period_s + random.Uniform();
    wave += SinCosDeg(360 * (turns - std::floor(turns))).sin / 2;
  }
  return motion_.distance_min_m +
         (motion_.distance_max_m - motion_.distance_min_m) * (0.5 + 0.5 * wave);
}

void CameraPath::AddKnot() {
  Measure();
  Random random({0x6b6e6f74, seed_, knots_.size()});
  const double pace = PaceAt(seed_, knots_.size(), kPathKnotsPerPace, kPaceSpread);
  const auto wanted = [&](double rate, double behind) {
    // Makes up what is missing within about two seconds.
    return rate * preset_.knot_s * std::clamp(1 + behind / (rate * 2), 0.4, 2.5);
  };
  double step_m = pace * wanted(preset_.speed_m_s, length_behind_m_);
  const double turn_deg =
      TurnPace(seed_, knots_.size()) * wanted(preset_.turn_deg_s, turn_behind_deg_);
  for (int retreat = 0; retreat < kRetreats; ++retreat, step_m /= 2) {
    for (const View& view : Candidates(step_m, turn_deg, random)) {
      if (!IsSafe(view)) continue;
      knots_.push_back(view);
      return;
    }
  }
  knots_.push_back(View(knots_.back()));  // waits; safe by construction
}

void CameraPath::Measure() {
  // A second, so that a long wait is not made up for ever.
  constexpr double kForgetting = 0.995;
  const double known_s = static_cast<double>(knots_.size() - 3) * preset_.knot_s;
  while ((measured_samples_ + 1) * kPresetSample_s < known_s) {
    const Pose T_before = Shaken(measured_samples_ * kPresetSample_s);
    const Pose T_after = Shaken(++measured_samples_ * kPresetSample_s);
    const double forget = 1 - (1 - kForgetting) * kPresetSample_s;
    length_behind_m_ = length_behind_m_ * forget + preset_.speed_m_s * kPresetSample_s -
                       (T_after.t - T_before.t).norm();
    turn_behind_deg_ = turn_behind_deg_ * forget + preset_.turn_deg_s * kPresetSample_s -
                       TurnBetween_deg(T_before, T_after);
  }
}

}  // namespace sim
