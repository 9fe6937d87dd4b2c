#include "slam/diagnose/camera_check.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <utility>

namespace slam {
namespace {

// Intrinsics are called wrong when they are off by so many sigmas and by so much that poses and
// map suffer.
constexpr double kWrong_sigmas = 5.0;  // 1 in 2e6 of noise; its spread is estimated from little
constexpr double kMinFocalError_ratio = 0.025;    // share of the focal length
constexpr double kMinCentreError_ratio = 0.0125;  // share of the image's width

// So wide that it says nothing; it keeps finite what the views do not see.
constexpr double kPriorFocal_ratio = 0.4;    // share of the focal length
constexpr double kPriorCentre_ratio = 0.16;  // share of the image's width

// Which views are compared: these bound time and memory, and keep the pairs that say most.
constexpr double kMinTurn_rad = 0.026;        // 1.5 degrees between neighbouring views
constexpr std::size_t kMinCommonPoints = 60;  // of two views; twice what a pair needs
constexpr std::size_t kMaxPoints = 250;       // taken of a pair of views
constexpr std::size_t kMaxViews = 12;         // kept for later ones
constexpr std::size_t kMinPairs = 3;          // before anything is said
constexpr std::size_t kMaxPairs = 40;         // kept, those that turn most

constexpr int kEstimateSteps = 3;
// Views that more or less of the shutter was taken out of are not alike.
constexpr double kMaxReadGap_s = 0.003;
constexpr double kMaxSpeedGap_s = 0.2;  // a longer one says nothing of the speed at its ends
constexpr std::array<const char*, 4> kNames = {"fx", "fy", "cx", "cy"};

std::string Fixed(double x, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, x);
  return text;
}

}  // namespace

CameraCheck::CameraCheck(const Camera& given, const FeatureScale& scale)
    : given_(given.fx, given.fy, given.cx, given.cy), scale_(scale), height_px_(given.height) {
  min_error_ << kMinFocalError_ratio * given_.head<2>(),
      Eigen::Vector2d::Constant(kMinCentreError_ratio * given.width);
  prior_sigma_ << kPriorFocal_ratio * given_.head<2>(),
      Eigen::Vector2d::Constant(kPriorCentre_ratio * given.width);
}

void CameraCheck::NoteSpeed(const Frame& frame) {
  const std::optional<Vector6d> before = speed_per_s_;
  speed_per_s_.reset();
  if (last_ && frame.timestamp_s > last_->s && frame.timestamp_s - last_->s < kMaxSpeedGap_s) {
    speed_per_s_ = Log(frame.T_cw * Inverse(last_->T_cw)) / (frame.timestamp_s - last_->s);
    // A view's own speed lies between that before and that after it.
    if (last_->view) {
      views_.back().speed_per_s = before ? 0.5 * (*before + *speed_per_s_) : *speed_per_s_;
    }
  }
  last_ = {frame.timestamp_s, frame.T_cw, false};
}

CameraCheck::View CameraCheck::ViewOf(const Frame& frame) const {
  View view{frame.index,
            frame.T_cw,
            speed_per_s_.value_or(Vector6d::Zero()),
            frame.readout.taken_out_s,
            {}};
  for (std::size_t i = 0; i < frame.features.size(); ++i) {
    const PointFeature& feature = frame.features[i];
    if (frame.map_points[i] == kNone || !(feature.depth_m > 0)) continue;
    view.points.push_back({frame.map_points[i], feature.u_px, feature.depth_m, feature.octave});
  }
  std::stable_sort(view.points.begin(), view.points.end(),
                   [](const SeenPoint& a, const SeenPoint& b) { return a.id < b.id; });
  return view;
}

std::vector<TwiceSeen> CameraCheck::Common(const View& first, const View& second) const {
  std::vector<TwiceSeen> common;
  auto b = second.points.begin();
  for (const SeenPoint& a : first.points) {
    while (b != second.points.end() && b->id < a.id) ++b;
    if (b == second.points.end()) break;
    if (b->id != a.id) continue;
    common.push_back({a.u_px, b->u_px, a.z_m, b->z_m,
                      std::hypot(scale_.Scale(a.octave), scale_.Scale(b->octave))});
  }
  return common;
}

bool CameraCheck::Compare(const View& first, const View& second) {
  if (std::abs(first.taken_out_s - second.taken_out_s) > kMaxReadGap_s) return false;
  const double turn_rad = RotationAngle(first.T_cw, second.T_cw);
  // Of too many pairs, the one that turns least gives way.
  const auto flattest =
      std::min_element(pairs_.begin(), pairs_.end(),
                       [](const Pair& a, const Pair& b) { return a.turn_rad < b.turn_rad; });
  const bool full = pairs_.size() >= kMaxPairs;
  if (full && turn_rad <= flattest->turn_rad) return false;

  std::vector<TwiceSeen> common = Common(first, second);
  if (common.size() > kMaxPoints) {  // evenly over the ages of the points
    for (std::size_t i = 0; i < kMaxPoints; ++i) {
      common[i] = common[i * common.size() / kMaxPoints];
    }
    common.resize(kMaxPoints);
  }
  const ViewMotion motion{first.speed_per_s, second.speed_per_s,
                          static_cast<double>(height_px_)};
  Pair pair{first.frame,
            turn_rad,
            ViewPair(std::move(common), second.T_cw * Inverse(first.T_cw), motion),
            {}};
  pair.at_given = pair.views.Evidence(given_);
  if (!pair.at_given.usable) return false;
  if (full) pairs_.erase(flattest);
  pairs_.push_back(std::move(pair));
  ++compared_;
  return true;
}

/// How many pairs share their earlier view, on the mean.
double CameraCheck::PairsAView() const {
  std::set<int> views;
  for (const Pair& pair : pairs_) views.insert(pair.first_frame);
  return static_cast<double>(pairs_.size()) / static_cast<double>(views.size());
}

CameraEstimate CameraCheck::Combine(const std::vector<IntrinsicsEvidence>& evidence,
                                    const Intrinsics& at) const {
  // Sum of what the pairs say and of the prior around the given camera.
  const Intrinsics prior = prior_sigma_.cwiseAbs2().cwiseInverse();
  Eigen::Matrix4d information = prior.asDiagonal();
  Eigen::Vector4d gradient = prior.cwiseProduct(at - given_);
  for (const IntrinsicsEvidence& e : evidence) {
    information += e.information;
    gradient += e.gradient;
  }
  const auto factor = information.ldlt();
  const Intrinsics move = factor.solve(-gradient);
  // How much further the pairs are apart than their noise says: chi-square of their gradients
  // at the common answer, by its degrees of freedom.
  double chi2 = 0.0;
  for (const IntrinsicsEvidence& e : evidence) {
    const Eigen::Vector4d left = e.gradient + e.information * move;
    chi2 += left.dot((e.information + Eigen::Matrix4d(prior.asDiagonal())).ldlt().solve(left));
  }
  const double apart = chi2 / (4.0 * static_cast<double>(evidence.size() - 1));

  // Pairs that share a view share what is wrong with it, as where depth bends: they all say the
  // same, so their scatter does not show it. They count as one.
  const double variance_ratio = std::max(apart, 1.0) * PairsAView();

  // An intrinsic is wrong when that is sure, and matters.
  CameraEstimate estimate;
  estimate.found = at + move;
  const Eigen::Matrix4d covariance = factor.solve(Eigen::Matrix4d::Identity());
  estimate.sigma = (variance_ratio * covariance.diagonal()).cwiseSqrt();
  for (int k = 0; k < 4; ++k) {
    const double off = std::abs(estimate.found[k] - given_[k]);
    estimate.wrong[static_cast<std::size_t>(k)] =
        off > min_error_[k] && off > kWrong_sigmas * estimate.sigma[k];
  }
  estimate.pairs = evidence.size();
  for (const Pair& pair : pairs_)
    estimate.turn_rad = std::max(estimate.turn_rad, pair.turn_rad);
  return estimate;
}

std::optional<CameraEstimate> CameraCheck::Estimate() {
  if (pairs_.size() < kMinPairs) return std::nullopt;
  CameraEstimate estimate;
  Intrinsics at = given_;
  for (int step = 0; step < kEstimateSteps; ++step) {
    std::vector<IntrinsicsEvidence> evidence;
    for (Pair& pair : pairs_) {
      evidence.push_back(step == 0 ? pair.at_given : pair.views.Evidence(at));
      if (!evidence.back().usable) evidence.pop_back();
    }
    if (evidence.size() < kMinPairs) return std::nullopt;
    estimate = Combine(evidence, at);
    // The next step is from there, but not farther than the prior believes.
    at = estimate.found.cwiseMax(at - prior_sigma_).cwiseMin(at + prior_sigma_);
  }
  return estimate;
}

bool CameraCheck::FindsWrong(int frame_index) {
  if (noticed_ || pairs_.size() < kMinPairs || compared_ < next_estimate_) return false;
  // One step from the given camera costs little, and is asked first.
  std::vector<IntrinsicsEvidence> evidence;
  for (const Pair& pair : pairs_) evidence.push_back(pair.at_given);
  if (!Combine(evidence, given_).AnyWrong()) return false;
  // To iterate costs more; when it denies, it is asked again after a quarter more pairs.
  next_estimate_ = compared_ + 1 + compared_ / 4;
  const std::optional<CameraEstimate> estimate = Estimate();
  if (!estimate || !estimate->AnyWrong()) return false;
  noticed_ = estimate;
  noticed_frame_ = frame_index;
  return true;
}

bool CameraCheck::See(const Frame& frame) {
  NoteSpeed(frame);
  if (!views_.empty() && RotationAngle(views_.back().T_cw, frame.T_cw) < kMinTurn_rad) {
    return false;
  }
  View view = ViewOf(frame);
  if (view.points.size() < kMinCommonPoints) return false;  // dark or blurred: says nothing
  // Views that share too little with this one will not share more later.
  std::vector<View> kept;
  for (View& earlier : views_) {
    if (Common(earlier, view).size() >= kMinCommonPoints) {
      kept.push_back(std::move(earlier));
    }
  }
  // The oldest is turned away the most; a second one has errors of its own.
  bool compared = !kept.empty() && Compare(kept.front(), view);
  if (kept.size() >= 3) compared |= Compare(kept[kept.size() / 2], view);
  kept.push_back(std::move(view));
  if (kept.size() > kMaxViews) kept.erase(kept.begin());
  views_ = std::move(kept);
  last_->view = true;
  return compared && FindsWrong(frame.index);
}

std::string CameraCheck::Warning() {
  if (!noticed_) return {};
  // The latest figures. Few views can be wrong together, as when depth is late or bends.
  const CameraEstimate estimate = Estimate().value_or(*noticed_);
  if (!estimate.AnyWrong()) {
    return "the camera file was doubted at frame " + std::to_string(noticed_frame_) +
           "; views after that do not bear it out";
  }
  std::string text = "the camera is not what the camera file says: ";
  bool first = true;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!estimate.wrong[k]) continue;
    const auto i = static_cast<Eigen::Index>(k);
    text += std::string(first ? "" : ", ") + kNames[k] + " is about " +
            Fixed(estimate.found[i], 0) + " px (+- " + Fixed(3 * estimate.sigma[i], 1) +
            "), not " + Fixed(given_[i], 0);
    first = false;
  }
  return text + "; noticed at frame " + std::to_string(noticed_frame_) + ", from " +
         std::to_string(estimate.pairs) + " pairs of views up to " +
         Fixed(estimate.turn_rad * 180.0 / std::numbers::pi, 0) +
         " degrees apart. Poses and map are distorted by as much: calibrate the camera and "
         "give the right camera.yaml. Lens distortion left out, images scaled or cropped after "
         "calibration, depth not registered to colour or taken at another time, and a rolling "
         "shutter look alike";
}

}  // namespace slam
