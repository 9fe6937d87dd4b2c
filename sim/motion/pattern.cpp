#include "sim/motion/pattern.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/base/angle.h"

namespace sim {
namespace {

double Sine(double turns) { return SinCosDeg(360 * (turns - std::floor(turns))).sin; }
double Cosine(double turns) { return SinCosDeg(360 * (turns - std::floor(turns))).cos; }

/// To and fro twice, from rest to rest; u in [0, 1], values in (-1, 1), C2 with zeros around
/// it.
double Burst(double u) {
  const double window = Sine(u / 2);
  return window * window * Sine(2 * u);
}

/// Which of three bursts it is, and how far into it.
struct Turn3 {
  int axis;
  double part;
};
Turn3 ThreeBursts(double round) {
  const double at = 3 * (round - std::floor(round));
  const int axis = std::min(static_cast<int>(at), 2);
  return {axis, at - axis};
}

/// What the camera looks along: azimuth 0 looks to +y, 90 to -x (as from +x); pitch below the
/// horizon.
struct Direction {
  double azimuth_deg = 0, pitch_deg = 0;
  Eigen::Vector3d Vector() const {
    const SinCos a = SinCosDeg(azimuth_deg),
                 p = SinCosDeg(std::clamp(pitch_deg, -kSteepest_deg, kSteepest_deg));
    return {-a.sin * p.cos, a.cos * p.cos, -p.sin};
  }
};

Direction DirectionOf(const Eigen::Vector3d& way) {
  return {RadToDeg(Atan2Rad(-way.x(), way.y())), RadToDeg(AsinRad(-way.z() / way.norm()))};
}

View Looking(const Eigen::Vector3d& camera_w, const Direction& direction, double roll_deg) {
  return {camera_w, camera_w + direction.Vector(), roll_deg};
}

/// Turned a little off the way it looks, never twice the same.
View Wobbled(const Eigen::Vector3d& camera_w, const Eigen::Vector3d& gaze_w, double look,
             double amplitude_deg) {
  Direction direction = DirectionOf(gaze_w - camera_w);
  direction.azimuth_deg += amplitude_deg * Sine(look);
  direction.pitch_deg += 0.7 * amplitude_deg * Sine(1.618 * look);
  return Looking(camera_w, direction, 0.8 * amplitude_deg * Sine(0.732 * look));
}

/// A view that the motion block allows.
struct Home {
  Home(const Motion& motion, Random& random) {
    direction.azimuth_deg =
        RadToDeg(random.Between(motion.azimuth_min_rad, motion.azimuth_max_rad));
    direction.pitch_deg = RadToDeg(random.Between(motion.pitch_min_rad, motion.pitch_max_rad));
    const double distance = random.Between(motion.distance_min_m, motion.distance_max_m);
    camera_w = motion.target_w - distance * direction.Vector();
  }
  Direction direction;
  Eigen::Vector3d camera_w;
};

/// A pattern that stays about one place.
class AtHome : public Pattern {
 public:
  AtHome(const Motion& motion, double reach_m, Random& random)
      : home_(motion, random), reach_m_(reach_m) {}

 protected:
  Home home_;
  double reach_m_;
};

/// Along x, y and z in turn.
class Sweeps : public AtHome {
 public:
  Sweeps(const Motion& motion, double scale, Random& random)
      : AtHome(motion, 0.5 * scale, random) {}
  View At(double place, double look) const override {
    const Turn3 burst = ThreeBursts(place);
    const SinCos a = SinCosDeg(home_.direction.azimuth_deg);
    const Eigen::Vector3d axes[3] = {{a.cos, a.sin, 0}, {-a.sin, a.cos, 0}, {0, 0, 1}};
    const Eigen::Vector3d camera_w =
        home_.camera_w + reach_m_ * Burst(burst.part) * axes[burst.axis];
    return Wobbled(camera_w, camera_w + home_.direction.Vector(), look, 9);
  }
  bool GoesUnevenly() const override { return true; }
};

/// About the camera's own axes in turn, nearly on the spot.
class Turns : public AtHome {
 public:
  Turns(const Motion& motion, double scale, Random& random)
      : AtHome(motion, 0.05 * scale, random) {}
  View At(double place, double look) const override {
    const Turn3 burst = ThreeBursts(look);
    const double swing_deg = 28 * Burst(burst.part);
    Direction direction = home_.direction;
    if (burst.axis == 1) direction.pitch_deg += 0.7 * swing_deg;
    if (burst.axis == 2) direction.azimuth_deg += swing_deg;
    const Eigen::Vector3d sway(Cosine(place), Sine(place), 0.5 * Sine(2 * place));
    return Looking(home_.camera_w + reach_m_ * sway, direction,
                   burst.axis == 0 ? swing_deg : 0.0);
  }
  bool TurnsUnevenly() const override { return true; }
};

/// Round itself.
class Panorama : public AtHome {
 public:
  Panorama(const Motion& motion, double scale, Random& random)
      : AtHome(motion, 0.25 * scale, random) {}
  View At(double place, double look) const override {
    const Direction direction{home_.direction.azimuth_deg + 360 * look,
                              home_.direction.pitch_deg + 6 * Sine(3 * look)};
    const Eigen::Vector3d sway(Cosine(place), Sine(place), 0.3 * Sine(3 * place));
    return Looking(home_.camera_w + reach_m_ * sway, direction, 4 * Sine(2 * look));
  }
  bool FacesTarget() const override { return false; }
};

/// Round the target, wholly when the azimuth is free, else to and fro.
class Orbit : public Pattern {
 public:
  Orbit(const Motion& motion, double scale, Random& random)
      : motion_(motion), scale_(scale), phase_(random.Uniform()) {}
  View At(double place, double look) const override {
    const Motion& m = motion_;
    const double low_deg = RadToDeg(m.azimuth_min_rad), high_deg = RadToDeg(m.azimuth_max_rad);
    const auto within = [&](double low, double high, double wave) {
      return (low + high) / 2 + 0.4 * scale_ * (high - low) * wave;
    };
    Direction direction;
    direction.azimuth_deg =
        high_deg - low_deg > 359 ? 360 * place : within(low_deg, high_deg, 1.1 * Sine(place));
    direction.pitch_deg =
        RadToDeg(within(m.pitch_min_rad, m.pitch_max_rad, Sine(3 * place + phase_)));
    const double distance =
        within(m.distance_min_m, m.distance_max_m, Sine(2 * place + 2 * phase_));
    const Eigen::Vector3d gaze_w =
        m.target_w + 0.3 * m.target_spread_m * Eigen::Vector3d(Sine(2 * place), 0, 0);
    return Wobbled(gaze_w - distance * direction.Vector(), gaze_w, look, 5);
  }

 protected:
  Motion motion_;
  double scale_, phase_;
};

/// An orbit that turns its back on the target every other while.
class LooksAway : public Orbit {
 public:
  using Orbit::Orbit;
  View At(double place, double look) const override {
    constexpr double kAway_deg = 110, kStays = 0.5;
    const double round = look - std::floor(look);
    // Three wobbles while it stays, and one excursion, alternately to either side.
    View facing = Orbit::At(place, 6 * look);
    if (round < kStays) return facing;
    const double out = Sine((round - kStays) / (1 - kStays) / 2);
    const bool left = static_cast<long long>(std::floor(look)) % 2 == 0;
    Direction direction = DirectionOf(facing.gaze_w - facing.camera_w);
    direction.azimuth_deg += (left ? 1 : -1) * kAway_deg * out * out;
    return Looking(facing.camera_w, direction, facing.roll_deg);
  }
};

/// Round the stations, each a control point of a closed cubic B-spline.
class Stations : public Pattern {
 public:
  explicit Stations(const Motion& motion) {
    for (const Station& station : motion.stations) {
      views_.push_back({station.camera_w, station.gaze_w, 0});
    }
  }
  View At(double place, double look) const override {
    const std::size_t n = views_.size();
    const double at = (place - std::floor(place)) * static_cast<double>(n);
    const auto i = std::min(static_cast<std::size_t>(at), n - 1);
    const View view =
        Blend({views_[(i + n - 1) % n], views_[i], views_[(i + 1) % n], views_[(i + 2) % n]},
              at - static_cast<double>(i));
    return Wobbled(view.camera_w, view.gaze_w, look, 9);
  }
  bool FacesTarget() const override { return false; }

 private:
  std::vector<View> views_;
};

}  // namespace

std::unique_ptr<Pattern> MakePattern(const Motion& motion, double scale, Random& random) {
  const std::string& name = motion.preset;
  if (name == "xyz") return std::make_unique<Sweeps>(motion, scale, random);
  if (name == "rpy") return std::make_unique<Turns>(motion, scale, random);
  if (name == "360") return std::make_unique<Panorama>(motion, scale, random);
  if (name == "orbit") return std::make_unique<Orbit>(motion, scale, random);
  if (name == "lookaway") return std::make_unique<LooksAway>(motion, scale, random);
  if (name == "loop" && !motion.stations.empty()) return std::make_unique<Stations>(motion);
  if (name == "loop") return std::make_unique<Orbit>(motion, scale, random);
  throw std::invalid_argument("motion preset " + name + " follows no pattern");
}

}  // namespace sim
