#include "slam/calibrate/warp_learner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace slam {
namespace {

// A view is used when the image has moved since the last one, and an epoch ends when it has
// moved so far that a bump of the scene no longer stands where the device would have it. Shifts
// are radians: 0.025 are 13 pixels at a focal length of 525, 0.1 are 52, where a bend's
// correlation is gone.
constexpr double kMinViewShift_rad = 0.025;
constexpr double kMinEpochShift_rad = 0.1;
constexpr double kMinEpochShare = 0.05;  // of the time so far: what is known well costs little
constexpr double kMinEpoch_s = 0.8;  // measured: drift is new after that, see sim's DepthBend
constexpr int kMaxViews = 16;        // of an epoch; bounds its cost, drift rules its error

constexpr std::size_t kMinGains = 4;      // fewer leave the scatter of the gains in doubt
constexpr double kMinGain = 0.05;         // of the variance: less is not worth the risk
constexpr double kMaxSurfaceShare = 0.9;  // a second surface must say a tenth
constexpr double kSameAngle_rad = 0.17;   // 10 degrees, as in association's beta_T
constexpr double kSameOffset_m = 0.1;     // balances drift of the pose against a table's height

/// Student's t of `freedom` degrees that is exceeded with a probability of 0.001.
double CriticalT(std::size_t freedom) {
  constexpr std::array<double, 11> kOneInThousand = {0,    318.3, 22.3, 10.2, 7.17, 5.89,
                                                     5.21, 4.79,  4.50, 4.30, 4.14};
  return kOneInThousand[std::min(freedom, kOneInThousand.size() - 1)];
}

}  // namespace

std::string WarpEvidence::Doubt() const {
  if (worth_it) return {};
  if (epochs < static_cast<int>(kMinGains)) {
    return fmt::format(
        "planes were seen from too few places: {} of {} are there that earlier ones foretell",
        epochs, kMinGains);
  }
  if (!(largest_surface <= kMaxSurfaceShare)) {
    return fmt::format("one surface has {:.0f} % of what was seen, so the bend may be its own",
                       100 * largest_surface);
  }
  return fmt::format(
      "what is learnt foretells {:.1f} % of the unevenness of planes seen later (Student's t "
      "{:.1f}; wanted: {:.0f} %, {:.1f}): the sensor is flat as far as these data say",
      100 * gain, student_t, 100 * kMinGain, min_student_t);
}

WarpLearner::WarpLearner(const Camera& camera, const DepthNoise& noise,
                         const DepthWarpConfig& config)
    : cells_(CellsOf(camera)),
      rays_(PixelRays(camera)),
      noise_(noise),
      estimates_{WarpEstimate(cells_, camera, config, BendLaw::kDepth),
                 WarpEstimate(cells_, camera, config, BendLaw::kDisparity)} {}

double WarpLearner::Shift(const Place& from, const Pose& T_cw) const {
  const Eigen::Vector3d way = Inverse(T_cw).t - Inverse(from.T_cw).t;
  return RotationAngle(from.T_cw, T_cw) + way.norm() / depth_m_;
}

bool WarpLearner::EndsEpoch(double timestamp_s, const Pose& T_cw) const {
  const double min_epoch_s = std::max(kMinEpoch_s, kMinEpochShare * (timestamp_s - first_s_));
  return views_ > 0 && timestamp_s - epoch_start_.timestamp_s >= min_epoch_s &&
         Shift(epoch_start_, T_cw) >= kMinEpochShift_rad;
}

bool WarpLearner::Wants(double timestamp_s, const Pose& T_cw) const {
  if (!last_) return true;
  return timestamp_s > last_->timestamp_s && Shift(*last_, T_cw) >= kMinViewShift_rad &&
         (views_ < kMaxViews || EndsEpoch(timestamp_s, T_cw));
}

bool WarpLearner::Observe(double timestamp_s, const cv::Mat1f& depth_m, const cv::Mat1b& labels,
                          const Pose& T_cw) {
  if (!Wants(timestamp_s, T_cw)) return false;
  if (!last_) first_s_ = timestamp_s;
  const bool learnt = EndsEpoch(timestamp_s, T_cw);
  if (learnt) CloseEpoch();

  // Each law sees surfaces by what it knows itself: else the one that is believed would keep the lead.
  std::vector<SurfaceView> views;
  for (WarpEstimate& estimate : estimates_) {
    std::vector<SurfaceView> seen =
        ViewSurfaces(depth_m, labels, rays_, cells_, noise_, estimate.pattern(),
                     estimate.spread(), estimate.law());
    for (const SurfaceView& view : seen) estimate.Add(view);
    if (estimate.law() == evidence_.law) views = std::move(seen);
  }
  last_ = Place{timestamp_s, T_cw};
  if (views.empty()) return learnt;
  if (views_++ == 0) epoch_start_ = *last_;
  double sum_m = 0.0;
  std::size_t count = 0;
  for (const SurfaceView& view : views) {
    CountSurface(view, T_cw);
    for (const CellMean& cell : view.cells) sum_m += 1 / cell.q;
    count += view.cells.size();
  }
  depth_m_ = sum_m / static_cast<double>(count);
  return learnt;
}

void WarpLearner::Finish() {
  if (views_ > 0) CloseEpoch();
}

/// Adds a view to the surface of the world that it shows.
void WarpLearner::CountSurface(const SurfaceView& view, const Pose& T_cw) {
  const Plane pi_c = view.plane.Hessian();
  const Pose T_wc = Inverse(T_cw);
  const Eigen::Vector3d n_w = T_wc.R * pi_c.n;
  Eigen::Vector3d x_c = Eigen::Vector3d::Zero();
  for (const CellMean& cell : view.cells) {
    x_c += Eigen::Vector3d(cell.x, cell.y, 1) / cell.q / static_cast<double>(view.cells.size());
  }
  const Eigen::Vector3d x_w = T_wc * x_c;
  const auto cells = static_cast<double>(view.cells.size());
  for (SeenSurface& seen : surfaces_) {
    if (Angle(seen.pi_w.n, n_w) < kSameAngle_rad &&
        std::abs(SignedDistance(seen.pi_w, x_w)) < kSameOffset_m) {
      seen.cells += cells;
      return;
    }
  }
  surfaces_.push_back({{n_w, -n_w.dot(x_w)}, cells});
}

void WarpLearner::CloseEpoch() {
  views_ = 0;
  for (std::size_t law = 0; law < estimates_.size(); ++law) {
    const bool foretold = estimates_[law].epochs() > 0;
    const double gain = estimates_[law].CloseEpoch();
    if (foretold) gains_[law].push_back(gain);
  }
  const WarpEvidence by_depth = EvidenceOf(BendLaw::kDepth);
  const WarpEvidence by_disparity = EvidenceOf(BendLaw::kDisparity);
  evidence_ = by_disparity.gain > by_depth.gain ? by_disparity : by_depth;
}

WarpEvidence WarpLearner::EvidenceOf(BendLaw law) const {
  const std::vector<double>& gains = gains_[static_cast<std::size_t>(law)];
  double largest = 0.0, all = 0.0;
  for (const SeenSurface& seen : surfaces_) {
    largest = std::max(largest, seen.cells);
    all += seen.cells;
  }
  WarpEvidence evidence;
  evidence.law = law;
  evidence.epochs = static_cast<int>(gains.size());
  evidence.largest_surface = all > 0 ? largest / all : 1.0;
  const auto n = static_cast<double>(gains.size());
  if (gains.size() >= 2) {
    evidence.gain = std::accumulate(gains.begin(), gains.end(), 0.0) / n;
    double squares = 0.0;
    for (const double g : gains) squares += (g - evidence.gain) * (g - evidence.gain);
    evidence.student_t = evidence.gain / std::sqrt(std::max(squares, 1e-12) / (n - 1) / n);
    evidence.min_student_t = CriticalT(gains.size() - 1);
  }
  // Once it is, it stays so while it foretells: depth that changes to and fro helps nobody.
  const bool foretells = gains.size() >= kMinGains && evidence.gain >= kMinGain;
  evidence.worth_it =
      foretells && (evidence_.worth_it || (evidence.student_t > evidence.min_student_t &&
                                           evidence.largest_surface <= kMaxSurfaceShare));
  return evidence;
}

DepthWarp WarpLearner::Warp() const {
  return {cells_, best().law(), WithoutLinearPart(cells_, best().pattern()), best().sigma()};
}

}  // namespace slam
