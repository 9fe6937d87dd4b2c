#include "slam/diagnose/depth_clock.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace slam {
namespace {

constexpr int kTiles = 40;     // across the image: small enough to be planes
constexpr int kStep_px = 4;    // between the pixels of a tile that are read
constexpr int kMinPixels = 8;  // measured, of a tile; a plane has three unknowns
// Measured pixels for one without depth; with fewer, the edge of an object is near.
constexpr int kMinMeasuredPerMissing = 8;
// Root mean square distance from its plane, in inverse depth, as a share of it: above, the tile
// is not one plane.
constexpr double kMaxBend_ratio = 0.01;
constexpr double kMaxChange_ratio = 0.1;  // share of the inverse depth; more is another surface

// Between frames that are compared: long enough for the motion to be more than poses jitter.
constexpr double kMaxStep_s = 0.11;

constexpr double kMaxLate_s = 1.0;
constexpr std::size_t kShifts = 61;  // to both sides of none; at 30 Hz a step is a frame
constexpr double kStep_s = 2 * kMaxLate_s / (kShifts - 1);
constexpr double kMaxPoseGap_s = 0.15;  // between poses, to say what was in between

// Changes overlap: 3.5 sigmas of independent ones at 30 Hz.
constexpr double kSure_sigmas = 6.0;
constexpr int kMinChanges = 10;
constexpr double kPaired_s = 0.025;  // time stamps are paired to 20 ms

constexpr std::size_t kUnshifted = kShifts / 2;
double LateOf(std::size_t shift) { return static_cast<double>(shift) * kStep_s - kMaxLate_s; }

}  // namespace

DepthClock::DepthClock(const Camera& camera) : rays_(PixelRays(camera)), shifts_(kShifts) {
  const int side_px = std::max(4 * kStep_px, camera.width / kTiles);
  for (int v = 0; v + side_px <= camera.height; v += side_px) {
    for (int u = 0; u + side_px <= camera.width; u += side_px) {
      areas_.emplace_back(u, v, side_px, side_px);
    }
  }
}

Eigen::Vector3d DepthClock::Ray(int u, int v) const {
  const cv::Vec2d& ray = rays_(v, u);
  return {ray[0], ray[1], 1.0};
}

Eigen::Vector3d DepthClock::Middle(const cv::Rect& area) const {
  return Ray(area.x + area.width / 2, area.y + area.height / 2);
}

/// A plane fitted to the inverse depths of an area; none when that is not one plane.
DepthClock::Tile DepthClock::Fit(const cv::Mat1f& depth_m, const cv::Rect& area) const {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double squares = 0.0;
  int count = 0, missing = 0;
  for (int v = area.y; v < area.y + area.height; v += kStep_px) {
    for (int u = area.x; u < area.x + area.width; u += kStep_px) {
      if (!(depth_m(v, u) > 0)) {
        ++missing;
        continue;
      }
      const Eigen::Vector3d r = Ray(u, v);
      const double q = 1.0 / depth_m(v, u);
      A += r * r.transpose(), b += r * q, squares += q * q;
      ++count;
    }
  }
  if (count < kMinPixels || missing * kMinMeasuredPerMissing > count) return {};
  const Eigen::Vector3d m = A.ldlt().solve(b);
  const double q = m.dot(Middle(area));
  const double bend = std::sqrt(std::max(0.0, squares - m.dot(b)) / count);
  return q > 0 && bend < kMaxBend_ratio * q ? Tile{m, q} : Tile{};
}

std::vector<DepthClock::Tile> DepthClock::Tiles(const cv::Mat1f& depth_m) const {
  std::vector<Tile> tiles;
  tiles.reserve(areas_.size());
  for (const cv::Rect& area : areas_) tiles.push_back(Fit(depth_m, area));
  return tiles;
}

/// Normal equations of the motion between two frames, from the tiles that both have.
DepthClock::Change DepthClock::Between(const Seen& from, const Seen& to) const {
  Change change;
  change.from_s = from.s, change.to_s = to.s;
  for (std::size_t k = 0; k < areas_.size(); ++k) {
    const Tile &a = from.tiles[k], &b = to.tiles[k];
    const double q = 0.5 * (a.q + b.q), by = b.q - a.q;
    if (a.q <= 0 || b.q <= 0 || std::abs(by) > kMaxChange_ratio * q) continue;
    // dq = omega . (m x r) - q m . v, around the mean of both frames.
    const Eigen::Vector3d m = 0.5 * (a.m + b.m), r = Middle(areas_[k]);
    Vector6d J;
    J << -q * m, m.cross(r);
    change.H += J * J.transpose(), change.g += J * by, change.c += by * by;
    ++change.tiles;
  }
  return change;
}

/// T_cw at a time; none when no poses are near enough.
std::optional<Pose> DepthClock::PoseAt(double s) const {
  constexpr double kSame_s = 1e-4;  // rounding of time stamps; a camera moves less than noise
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), s - kSame_s,
                                      [](const TimedPose& p, double t) { return p.s < t; });
  if (after == poses_.end()) return std::nullopt;
  if (after->s - s <= kSame_s) return after->T_cw;
  if (after == poses_.begin()) return std::nullopt;
  // In between the camera moves evenly.
  const auto before = after - 1;
  const double gap_s = after->s - before->s;
  if (gap_s > kMaxPoseGap_s) return std::nullopt;
  const Vector6d xi = Log(after->T_cw * Inverse(before->T_cw));
  return Exp((s - before->s) / gap_s * xi) * before->T_cw;
}

/// How badly the poses of the two times, so much later, explain the change.
std::optional<double> DepthClock::Cost(const Change& change, double late_s) const {
  const auto from = PoseAt(change.from_s + late_s), to = PoseAt(change.to_s + late_s);
  if (!from || !to) return std::nullopt;
  const Vector6d xi = Log(*to * Inverse(*from));
  return xi.dot(change.H * xi) - 2 * xi.dot(change.g) + change.c;
}

/// Adds to each shift how it explains the change, against none.
void DepthClock::Add(const Change& change, Shifts& shifts) const {
  const auto unshifted = Cost(change, 0.0);
  if (!unshifted) return;
  for (std::size_t k = 0; k < kShifts; ++k) {
    const auto cost = Cost(change, LateOf(k));
    if (!cost) continue;
    Shift& shift = shifts[k];
    const double sum = *unshifted + *cost;
    const double gain = sum > 0 ? (*unshifted - *cost) / sum : 0.0;
    shift.cost += *cost;
    shift.gains += gain, shift.squared_gains += gain * gain;
    ++shift.changes;
  }
}

void DepthClock::Observe(const Frame& frame) {
  const double timestamp_s = frame.timestamp_s, depth_s = timestamp_s + frame.depth_late_s;
  // The change since the oldest frame that is near enough.
  seen_.push_back({depth_s, Tiles(frame.measured.depth_m)});
  while (seen_.front().s < depth_s - kMaxStep_s) seen_.pop_front();
  if (seen_.size() > 1) {
    const Change change = Between(seen_.front(), seen_.back());
    if (change.tiles > 0) changes_.push_back(change);
  }
  if (frame.T_cw_by_pixels) poses_.push_back({timestamp_s, *frame.T_cw_by_pixels});
  // Changes to which no more poses will come are added up.
  while (!changes_.empty() && changes_.front().to_s + kMaxLate_s <= timestamp_s) {
    Add(changes_.front(), shifts_);
    changes_.pop_front();
  }
  while (!poses_.empty() && poses_.front().s + 2 * kMaxLate_s + kMaxPoseGap_s < timestamp_s) {
    poses_.pop_front();
  }
}

/// Where between the neighbours of a shift the mean cost is lowest, in steps from it.
double DepthClock::Lowest(const Shifts& shifts, std::size_t at) {
  if (at == 0 || at + 1 == shifts.size()) return 0.0;
  const auto mean = [&](std::size_t k) {
    return shifts[k].cost / std::max(1, shifts[k].changes);
  };
  const double slope = 0.5 * (mean(at + 1) - mean(at - 1));
  const double curvature = mean(at + 1) + mean(at - 1) - 2 * mean(at);
  return curvature > 0 ? std::clamp(-slope / curvature, -0.5, 0.5) : 0.0;
}

std::optional<double> DepthClock::Late_s() const {
  Shifts shifts = shifts_;
  for (const Change& change : changes_) Add(change, shifts);
  // The shift that explains most, if it does so for enough of the changes.
  const int needed = std::max(kMinChanges, shifts[kUnshifted].changes / 2);
  std::size_t best = kUnshifted;
  double most = 0.0;
  for (std::size_t k = 0; k < kShifts; ++k) {
    const Shift& shift = shifts[k];
    if (shift.changes < needed || shift.gains / shift.changes <= most) continue;
    best = k, most = shift.gains / shift.changes;
  }
  // It must be better than none by more than the changes scatter.
  const Shift& shift = shifts[best];
  if (best == kUnshifted) return std::nullopt;
  const double variance =
      std::max(shift.squared_gains / shift.changes - most * most, 0.0);  // rounding
  if (most < kSure_sigmas * std::sqrt(variance / shift.changes)) return std::nullopt;
  return LateOf(best) + kStep_s * Lowest(shifts, best);
}

std::vector<std::string> DepthClock::Warnings() const {
  const std::optional<double> late_s = Late_s();
  if (!late_s || std::abs(*late_s) < kPaired_s) return {};
  const int late_ms = static_cast<int>(std::lround(1000 * std::abs(*late_s)));
  return {"depth seems to be taken " + std::to_string(late_ms) + " ms " +
          (*late_s > 0 ? "after" : "before") +
          " its colour image, as the motion says; are the right images paired?"};
}

}  // namespace slam
