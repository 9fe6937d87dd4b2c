#include "slam/places/place_guesses.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace slam {
namespace {

/// Planes that face the same way.
struct Direction {
  Eigen::Vector3d n = Eigen::Vector3d::Zero();  ///< unit, their mean
  double weight = 0.0;
};
using Three = std::array<Eigen::Vector3d, 3>;

constexpr double kDifferent_m = 0.05,
                 kDifferent_rad = 0.05;               // below, a check comes to one place
constexpr double kGuess_m = 0.05, kGuess_rad = 0.05;  // how far a guess may be off
constexpr double kMinDeterminant = 0.3;               // three directions that tell a place

class DirectionList {
 public:
  explicit DirectionList(double max_angle_rad) : min_cosine_(std::cos(max_angle_rad)) {}

  void Add(const Eigen::Vector3d& n, double weight) {
    for (Direction& direction : list_) {
      if (direction.n.dot(n) < min_cosine_) continue;
      direction.n = (direction.weight * direction.n + weight * n).normalized();
      direction.weight += weight;
      return;
    }
    list_.push_back({n, weight});
  }

  /// The heaviest first.
  std::vector<Direction> Sorted(std::size_t at_most) && {
    std::stable_sort(list_.begin(), list_.end(),
                     [](const auto& a, const auto& b) { return a.weight > b.weight; });
    list_.resize(std::min(list_.size(), at_most));
    return std::move(list_);
  }

 private:
  double min_cosine_;
  std::vector<Direction> list_;
};

double Determinant(const Three& n) {
  return (Eigen::Matrix3d() << n[0], n[1], n[2]).finished().determinant();
}

/// Three directions of the frame that are not in one plane, the heaviest first.
std::vector<Three> ThreeDirections(const std::vector<Direction>& seen) {
  constexpr std::size_t kTried = 3;  // one of the planes may be new
  std::vector<std::pair<double, Three>> threes;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = i + 1; j < seen.size(); ++j) {
      for (std::size_t k = j + 1; k < seen.size(); ++k) {
        const Three three{seen[i].n, seen[j].n, seen[k].n};
        if (std::abs(Determinant(three)) < kMinDeterminant) continue;
        threes.emplace_back(seen[i].weight + seen[j].weight + seen[k].weight, three);
      }
    }
  }
  std::stable_sort(threes.begin(), threes.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  threes.resize(std::min(threes.size(), kTried));
  std::vector<Three> out;
  out.reserve(threes.size());
  for (const auto& [weight, three] : threes) out.push_back(three);
  return out;
}

/// All rotations that bring the three directions onto directions of the map.
std::vector<Eigen::Matrix3d> Rotations(const Three& seen_c, const std::vector<Direction>& map,
                                       double max_angle_rad) {
  const double handed = Determinant(seen_c);
  const auto alike = [&](std::size_t a, std::size_t b, const auto& m_a, const auto& m_b) {
    return std::abs(Angle(seen_c[a], seen_c[b]) - Angle(m_a, m_b)) < 2 * max_angle_rad;
  };
  std::vector<Eigen::Matrix3d> out;
  for (const Direction& m0 : map) {
    for (const Direction& m1 : map) {
      if (!alike(0, 1, m0.n, m1.n)) continue;
      for (const Direction& m2 : map) {
        if (!alike(0, 2, m0.n, m2.n) || !alike(1, 2, m1.n, m2.n)) continue;
        if (handed * Determinant({m0.n, m1.n, m2.n}) <= 0) continue;
        const Eigen::Matrix3d sum = m0.n * seen_c[0].transpose() +
                                    m1.n * seen_c[1].transpose() + m2.n * seen_c[2].transpose();
        out.push_back(Normalised(Pose{sum, Eigen::Vector3d::Zero()}).R);
      }
    }
  }
  return out;
}

/// How far the camera is along a direction of the world, as pairs of planes that face it say: the
/// values on which most frame planes agree.
std::vector<double> Distances(const Eigen::Vector3d& m_w, const Eigen::Matrix3d& R_wc,
                              const Frame& frame, const std::vector<KnownPlane>& known,
                              const PlanePlaceConfig& config) {
  constexpr std::size_t kTried = 5;
  const double min_cosine = std::cos(2 * config.max_angle_rad);
  // Each frame plane that shows a landmark says where the camera is.
  struct Vote {
    double at_m;
    int plane;
    double weight;
  };
  std::vector<Vote> votes;
  for (const FramePlane& plane : frame.planes) {
    const Eigen::Vector3d n_w = R_wc * plane.pi_c.n;
    if (plane.bad || n_w.dot(m_w) < min_cosine) continue;
    const double behind_m = m_w.dot(R_wc * plane.centroid_c);
    for (const KnownPlane& other : known) {
      if (other.pi_w.n.dot(m_w) < min_cosine) continue;
      const double at_m = m_w.dot(other.centroid_w) - behind_m;
      votes.push_back({at_m, plane.index, Weight(plane)});
    }
  }
  std::stable_sort(votes.begin(), votes.end(),
                   [](const Vote& a, const Vote& b) { return a.at_m < b.at_m; });
  // Of the votes about each value, one counts a frame plane.
  struct Value {
    double at_m, weight;
  };
  std::vector<Value> values;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    Value value{0.0, 0.0};
    std::vector<int> counted;
    for (std::size_t k = i;
         k < votes.size() && votes[k].at_m < votes[i].at_m + 2 * config.max_offset_m; ++k) {
      if (std::find(counted.begin(), counted.end(), votes[k].plane) != counted.end()) continue;
      counted.push_back(votes[k].plane);
      value.at_m += votes[k].weight * votes[k].at_m;
      value.weight += votes[k].weight;
    }
    value.at_m /= value.weight;
    values.push_back(value);
  }
  std::stable_sort(values.begin(), values.end(),
                   [](const Value& a, const Value& b) { return a.weight > b.weight; });
  std::vector<double> out;
  for (const Value& value : values) {
    if (out.size() == kTried) break;
    if (std::none_of(out.begin(), out.end(), [&](double other_m) {
          return std::abs(other_m - value.at_m) < config.max_offset_m;
        })) {
      out.push_back(value.at_m);
    }
  }
  return out;
}

/// By planes that face three ways: the angles between them give rotations, and their distances
/// along each direction the place.
void GuessByDistances(const Frame& frame, const std::vector<KnownPlane>& known,
                      const PlanePlaceConfig& config, std::vector<UncertainPose>& guesses) {
  constexpr std::size_t kSeen = 6, kKnown = 24;  // bounds the work
  DirectionList seen(2 * config.max_angle_rad), in_map(2 * config.max_angle_rad);
  for (const FramePlane& plane : frame.planes) {
    if (!plane.bad) seen.Add(plane.pi_c.n, Weight(plane));
  }
  for (const KnownPlane& plane : known) in_map.Add(plane.pi_w.n, std::sqrt(plane.area_m2));
  const std::vector<Direction> of_map = std::move(in_map).Sorted(kKnown);
  for (const Three& three : ThreeDirections(std::move(seen).Sorted(kSeen))) {
    for (const Eigen::Matrix3d& R_wc : Rotations(three, of_map, config.max_angle_rad)) {
      std::array<std::vector<double>, 3> at_m;
      Eigen::Matrix3d axes;
      for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        axes.row(k) = (R_wc * three[at]).transpose();
        at_m[at] = Distances(axes.row(k).transpose(), R_wc, frame, known, config);
      }
      const Eigen::Matrix3d place = axes.inverse();
      for (const double x : at_m[0]) {
        for (const double y : at_m[1]) {
          for (const double z : at_m[2]) {
            guesses.push_back({Inverse({R_wc, place * Eigen::Vector3d(x, y, z)}),
                               IsotropicCovariance(kGuess_m, kGuess_rad)});
          }
        }
      }
    }
  }
}

/// The pose that brings four corners onto four, in order; none where sides or planes differ.
std::optional<UncertainPose> PoseByCorners(const FramePlane& plane, const MapPlane& landmark,
                                           int shift, bool reversed,
                                           const PlanePlaceConfig& config) {
  constexpr int kCorners = static_cast<int>(kFaceCorners);
  Eigen::Matrix<double, 3, kCorners> seen_c, known_w;
  for (int k = 0; k < kCorners; ++k) {
    const int other = ((reversed ? -k : k) + shift + kCorners) % kCorners;
    seen_c.col(k) = plane.vertices_c[Index(k)].p_c;
    known_w.col(k) = landmark.vertices_w[Index(other)];
  }
  for (int k = 0; k < kCorners; ++k) {
    const int next = (k + 1) % kCorners;
    const double side_m = (known_w.col(next) - known_w.col(k)).norm();
    const double seen_m = (seen_c.col(next) - seen_c.col(k)).norm();
    if (std::abs(seen_m - side_m) > config.max_side_share * side_m + config.max_offset_m / 2)
      return std::nullopt;
  }
  const Eigen::Matrix4d T = Eigen::umeyama(known_w, seen_c, false);
  UncertainPose guess{{T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()}, Matrix6d::Zero()};
  if (Angle(guess.T_cw.R * landmark.pi_w.n, plane.pi_c.n) > config.max_angle_rad)
    return std::nullopt;
  // What the corners say: each errs by its own covariance and by as much in the map.
  Matrix6d information = Matrix6d::Zero();
  for (int k = 0; k < kCorners; ++k) {
    Eigen::Matrix<double, 3, 6> J;
    J << Eigen::Matrix3d::Identity(), -Hat(seen_c.col(k));
    const double floor_m = config.max_offset_m / 4;
    const Eigen::Matrix3d covariance = 2 * plane.vertices_c[Index(k)].covariance_c +
                                       floor_m * floor_m * Eigen::Matrix3d::Identity();
    information += J.transpose() * covariance.inverse() * J;
  }
  guess.covariance = information.inverse();
  return guess;
}

/// By faces: four corners give a pose by themselves, whichever way the others face.
void GuessByFaces(const Frame& frame, const std::vector<KnownPlane>& known,
                  const PlanePlaceConfig& config, std::vector<UncertainPose>& guesses) {
  for (const FramePlane& plane : frame.planes) {
    if (plane.bad || plane.vertices_c.size() != kFaceCorners) continue;
    for (const KnownPlane& other : known) {
      if (other.landmark->vertices_w.size() != kFaceCorners) continue;
      for (const bool reversed : {false, true}) {
        for (int shift = 0; shift < static_cast<int>(kFaceCorners); ++shift) {
          if (const auto guess = PoseByCorners(plane, *other.landmark, shift, reversed, config))
            guesses.push_back(*guess);
        }
      }
    }
  }
}

}  // namespace

double Weight(const FramePlane& plane) {
  return std::sqrt(static_cast<double>(plane.pixel_count));
}

std::vector<KnownPlane> KnownPlanes(const Map& map) {
  std::vector<KnownPlane> known;
  for (const MapPlane& plane : map.planes) {
    if (plane.status != LandmarkStatus::kLandmark) continue;
    KnownPlane one{plane.pi_w, plane.centroid_w, 0.0, plane.area_m2, &plane};
    for (const Eigen::Vector3d& p_w : plane.hull_w)
      one.reach_m = std::max(one.reach_m, (p_w - plane.centroid_w).norm());
    known.push_back(one);
  }
  return known;
}

bool ClassesAllow(const FramePlane& plane, const KnownPlane& known) {
  const std::string& class_name = known.landmark->class_name;
  return plane.class_name.empty() || class_name.empty() || plane.class_name == class_name;
}

const KnownPlane* NearestLike(const FramePlane& plane, const std::vector<KnownPlane>& known,
                              const Pose& T_cw, const PlanePlaceConfig& config) {
  const Pose T_wc = Inverse(T_cw);
  const Eigen::Vector3d n_w = T_wc.R * plane.pi_c.n, centroid_w = T_wc * plane.centroid_c;
  const double min_cosine = std::cos(config.max_angle_rad);
  double nearest_m = 3 * (config.max_offset_m + plane.OffsetSigma_m());
  const KnownPlane* nearest = nullptr;
  for (const KnownPlane& other : known) {
    if (other.pi_w.n.dot(n_w) < min_cosine || !ClassesAllow(plane, other) ||
        (centroid_w - other.centroid_w).norm() > other.reach_m + kGuess_m) {
      continue;
    }
    const double off_m = std::abs(SignedDistance(other.pi_w, centroid_w));
    if (off_m < nearest_m) nearest = &other, nearest_m = off_m;
  }
  return nearest;
}

std::vector<UncertainPose> GuessPlaces(const Frame& frame, const std::vector<KnownPlane>& known,
                                       const PlanePlaceConfig& config) {
  std::vector<UncertainPose> guesses;
  GuessByFaces(frame, known, config, guesses);  // first: they are the more certain ones
  GuessByDistances(frame, known, config, guesses);
  // Those at which the most planes show some landmark ...
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t g = 0; g < guesses.size(); ++g) {
    double shown = 0.0;
    for (const FramePlane& plane : frame.planes) {
      if (!plane.bad && NearestLike(plane, known, guesses[g].T_cw, config))
        shown += Weight(plane);
    }
    order.emplace_back(-shown, g);
  }
  std::sort(order.begin(), order.end());
  // ... and each place once.
  std::vector<UncertainPose> out;
  for (const auto& [shown, g] : order) {
    if (out.size() == Index(config.max_checked)) break;
    const Pose& T_cw = guesses[g].T_cw;
    if (std::none_of(out.begin(), out.end(), [&](const UncertainPose& other) {
          return (T_cw * Inverse(other.T_cw)).t.norm() < kDifferent_m &&
                 RotationAngle(T_cw, other.T_cw) < kDifferent_rad;
        })) {
      out.push_back(guesses[g]);
    }
  }
  return out;
}

}  // namespace slam
