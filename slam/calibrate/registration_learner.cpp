#include "slam/calibrate/registration_learner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "slam/base/median.h"

namespace slam {
namespace {

constexpr int kMinEdges = 80;                            // of each side: an epoch
constexpr std::size_t kMinEpochs = 3, kMaxEpochs = 100;  // then it is known
constexpr double kMinMoved_px = 8.0;                     // between frames that are learnt from
constexpr double kBlur_px = 1.0;                         // brightness changes over some pixels

// What is looked for, in steps: more of a shift is another camera's calibration.
constexpr double kSteps = 8.0;  // a pixel
constexpr int kMaxShift = 40, kMinGrown = -8, kMaxGrown = 32;
constexpr int kBeside = 16;        // steps from the peak that belong to it
constexpr double kMinLead = 1.15;  // wrong peaks of simulated recordings had up to 1.06

/// Whether the near thing lies before the edge.
int Sign(NearSide side) {
  return side == NearSide::kRight || side == NearSide::kBottom ? 1 : -1;
}

/// Standard deviation of the mean of values, some of which may be far off. As if they scattered
/// by two steps at least.
double SigmaOfMean(const std::vector<double>& values) {
  constexpr double kLossOfMedian = 1.2533;  // its efficiency is 2 / pi
  const double median = UpperMedian(values);
  std::vector<double> off;
  off.reserve(values.size());
  for (const double value : values) off.push_back(std::abs(value - median));
  return kLossOfMedian * std::max(kSigmaOverMad * UpperMedian(std::move(off)), 2.0 / kSteps) /
         std::sqrt(static_cast<double>(values.size()));
}

}  // namespace

/// How much of the gradients a shift along an axis explains, with a growth.
class RegistrationLearner::Explained {
 public:
  explicit Explained(const Profiles& profiles) {
    for (std::size_t side = 0; side < around_.size(); ++side) {
      for (int step = -kMost; step <= kMost; ++step) {
        double& sum = around_[side][static_cast<std::size_t>(step + kMost)];
        for (std::size_t k = 0; k < kSamples; ++k) {
          const double off = (static_cast<double>(k) - kReach_px - step / kSteps) / kBlur_px;
          sum += profiles[side].sum[k] * std::exp(-0.5 * off * off);
        }
        sum /= std::max(profiles[side].edges, 1);
      }
    }
  }

  double By(int axis, int shift, int grown) const {
    double sum = 0.0;
    for (const NearSide side : axis == 0 ? std::array{NearSide::kLeft, NearSide::kRight}
                                         : std::array{NearSide::kTop, NearSide::kBottom})
      sum += around_[static_cast<std::size_t>(side)]
                    [static_cast<std::size_t>(shift - Sign(side) * grown + kMost)];
    return sum;
  }

  int BestShift(int axis, int grown) const {
    int best = -kMaxShift;
    for (int shift = -kMaxShift; shift <= kMaxShift; ++shift)
      if (By(axis, shift, grown) > By(axis, best, grown)) best = shift;
    return best;
  }

  /// How much it leads beside the best of all others, over what all explain on average. Those that
  /// no such sensor grows by count, too: where they explain as much, edges tell too little.
  double Lead(int axis, int shift, int grown) const {
    double mean = 0.0, other = 0.0;
    int count = 0;
    for (int g = kMinGrown; g <= kMaxGrown; ++g) {
      for (int s = -kMaxShift; s <= kMaxShift; ++s, ++count) {
        mean += By(axis, s, g);
        if (std::abs(s - shift) >= kBeside || std::abs(g - grown) >= kBeside)
          other = std::max(other, By(axis, s, g));
      }
    }
    mean /= count;
    return (By(axis, shift, grown) - mean) / (other - mean);
  }

 private:
  static constexpr int kMost = kMaxShift + kMaxGrown;
  /// Mean gradients around each distance from the edges of a side, in steps.
  std::array<std::array<double, 2 * kMost + 1>, kNearSides> around_{};
};

RegistrationLearner::RegistrationLearner(const Camera& camera, double edge_growth_px,
                                         const RegistrationConfig& config)
    : camera_(camera),
      rays_(PixelRays(camera)),
      max_grown_(std::min(static_cast<int>(std::lround(edge_growth_px * kSteps)), kMaxGrown)),
      config_(config) {}

/// Adds the gradients of brightness across an edge, around where colour should show it.
void RegistrationLearner::AddEdge(const cv::Mat1f& gray, const DepthEdge& edge, NearSide side,
                                  const Pose& T_cd) {
  // The ray is that of the pixel at the edge; both move alike.
  const cv::Vec2d& ray = rays_(static_cast<int>(edge.v_px), static_cast<int>(edge.u_px));
  const auto z_m = static_cast<double>(edge.z_m);
  const Eigen::Vector3d x_d(ray[0] * z_m, ray[1] * z_m, z_m), x_c = T_cd * x_d;
  if (!(x_c.z() > kMinVisibleDepth_m)) return;
  const Eigen::Vector2d moved = camera_.ProjectDistorted(x_c) - camera_.ProjectDistorted(x_d);
  const double u = static_cast<double>(edge.u_px) + moved.x(),
               v = static_cast<double>(edge.v_px) + moved.y();

  // A gradient is half-way to the next pixel. Roots, so that one strong edge does not rule.
  const bool across_u = side == NearSide::kLeft || side == NearSide::kRight;
  const double along = (across_u ? u : v) - 0.5, whole = std::floor(along),
               rest = along - whole;
  const int first = static_cast<int>(whole) - kReach_px;
  const int other = static_cast<int>(std::lround(across_u ? v : u));
  const cv::Rect needed = across_u ? cv::Rect(first, other, kSamples + 2, 1)
                                   : cv::Rect(other, first, 1, kSamples + 2);
  if ((needed & cv::Rect({}, gray.size())) != needed) return;
  std::array<double, kSamples + 1> root;
  for (int k = 0; k <= static_cast<int>(kSamples); ++k) {
    const cv::Point at = needed.tl() + (across_u ? cv::Point(k, 0) : cv::Point(0, k));
    const float next = gray(at + (across_u ? cv::Point(1, 0) : cv::Point(0, 1)));
    root[static_cast<std::size_t>(k)] =
        std::sqrt(static_cast<double>(std::abs(next - gray(at))));
  }
  std::array<double, kSamples> gradient;
  for (std::size_t k = 0; k < kSamples; ++k)
    gradient[k] = (1.0 - rest) * root[k] + rest * root[k + 1];
  const double mean = std::accumulate(gradient.begin(), gradient.end(), 0.0) / kSamples;
  for (Profiles* profiles : {&epoch_, &all_}) {
    Profile& profile = (*profiles)[static_cast<std::size_t>(side)];
    for (std::size_t k = 0; k < kSamples; ++k) profile.sum[k] += gradient[k] - mean;
    ++profile.edges;
  }
}

/// The shifts along both axes and the growth, one for all sides, that explain the most.
RegistrationLearner::Peak RegistrationLearner::FindPeak(const Profiles& profiles) const {
  // The best growth for the best shifts of both axes, and for each of them alone.
  const Explained explained(profiles);
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  std::array<int, 2> best_shift{}, own_grown{};
  int best_grown = 0;
  double most = kNothing;
  std::array<double, 2> own_most{kNothing, kNothing};
  for (int grown = kMinGrown; grown <= max_grown_; ++grown) {
    std::array<int, 2> shift{};
    double sum = 0.0;
    for (const int axis : {0, 1}) {
      const auto at = static_cast<std::size_t>(axis);
      shift[at] = explained.BestShift(axis, grown);
      const double own = explained.By(axis, shift[at], grown);
      if (own > own_most[at]) own_most[at] = own, own_grown[at] = grown;
      sum += own;
    }
    if (sum > most) most = sum, best_shift = shift, best_grown = grown;
  }

  Peak peak;
  peak.grown_px = best_grown / kSteps;
  peak.torn_px = (own_grown[0] - own_grown[1]) / kSteps;
  for (const int axis : {0, 1}) {
    const int shift = best_shift[static_cast<std::size_t>(axis)];
    peak.shift_px[axis] = shift / kSteps;
    peak.lead[axis] = explained.Lead(axis, shift, best_grown);
  }
  return peak;
}

void RegistrationLearner::CloseEpoch() {
  shifts_px_.push_back(FindPeak(epoch_).shift_px);
  epoch_ = {};
  if (shifts_px_.size() < kMinEpochs) return;
  const Peak peak = FindPeak(all_);
  RegistrationEstimate now;
  now.shift_px = peak.shift_px, now.grown_px = peak.grown_px;
  now.epochs = static_cast<int>(shifts_px_.size());
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> shifts;
    for (const Eigen::Vector2d& shift : shifts_px_) shifts.push_back(shift[axis]);
    now.sigma_px[axis] = std::hypot(SigmaOfMean(shifts), peak.torn_px);
  }
  now.clear = peak.lead.minCoeff() > kMinLead;

  // What is expected before anything is seen counts beside it; what is not clear is left.
  for (int axis = 0; axis < 2; ++axis) {
    const double prior2 = config_.usual_px * config_.usual_px;
    const double shift =
        now.shift_px[axis] * prior2 / (prior2 + now.sigma_px[axis] * now.sigma_px[axis]);
    if (now.clear && std::abs(shift) > config_.min_shift_px) now.applied_px[axis] = shift;
  }
  estimate_ = now;
  const Eigen::Vector3d ray_d(-now.applied_px.x() / camera_.fx,
                              -now.applied_px.y() / camera_.fy, 1.0);
  R_dc_ = RotationBetween(Eigen::Vector3d::UnitZ(), ray_d);
}

/// Whether the image moves by so much, at a usual distance, that its edges are new evidence.
bool RegistrationLearner::HasMoved(const Frame& frame) const {
  if (!last_T_cw_) return true;
  constexpr double kUsual_m = 1.0;
  const Vector6d xi = Log(frame.T_cw * Inverse(*last_T_cw_));
  return camera_.fx * (xi.head<3>().norm() / kUsual_m + xi.tail<3>().norm()) > kMinMoved_px;
}

void RegistrationLearner::Learn(const Frame& frame) {
  if (!config_.learn || held_ || shifts_px_.size() >= kMaxEpochs || !HasMoved(frame)) return;
  last_T_cw_ = frame.T_cw;
  cv::Mat1f smooth;
  frame.gray.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, kBlur_px);
  // The motion between the two images is known, and no part of what is learnt.
  const Pose T_cd = Exp(-frame.depth_late_s * frame.speed.mean);
  const DepthEdges edges = FindDepthEdges(frame.measured.depth_m);
  for (int side = 0; side < kNearSides; ++side) {
    for (const DepthEdge& edge : edges[static_cast<std::size_t>(side)])
      AddEdge(smooth, edge, static_cast<NearSide>(side), T_cd);
  }
  if (std::all_of(epoch_.begin(), epoch_.end(),
                  [](const Profile& profile) { return profile.edges >= kMinEdges; }))
    CloseEpoch();
}

}  // namespace slam
