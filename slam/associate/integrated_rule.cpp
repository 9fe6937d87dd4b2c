#include "slam/associate/integrated_rule.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/associate/box_plane.h"
#include "slam/associate/frame_relations.h"
#include "slam/associate/plane_anchors.h"
#include "slam/associate/plane_plane.h"
#include "slam/associate/plane_samples.h"
#include "slam/associate/rank_test.h"
#include "slam/model/class_belief.h"

namespace slam {
namespace {

// By rule, without and with the rank test.
enum Rule { kOverlap, kExtension, kIou, kBelief };
constexpr const char* kRuleNames[][2] = {{"overlap", "overlap+ranksum"},
                                         {"extension", "extension+ranksum"},
                                         {"iou", "iou+ranksum"},
                                         {"belief", "belief+ranksum"}};

/// Border and structure faults concern corners: such a plane may be recognised, not mapped.
bool CanBeMatched(const FramePlane& plane) {
  return !plane.bad || *plane.bad == BadReason::kBorder || *plane.bad == BadReason::kStructure;
}

}  // namespace

const char* IntegratedRule::RuleName(const FramePlane& f, const MapPlane& m, const Pair& pair) {
  Rule rule = kOverlap;
  if (pair.extension) {
    rule = kExtension;
  } else if (!f.class_name.empty() && !m.class_name.empty()) {
    rule = kIou;
  } else if (f.class_name != m.class_name) {
    rule = kBelief;
  }
  return kRuleNames[rule][pair.ranked ? 1 : 0];
}

IntegratedRule::IntegratedRule(const Frame& frame, const Map& map,
                               const PlaneQuestion& question, const Camera& camera,
                               const AssociationConfig& config)
    : frame_(frame),
      map_(map),
      planes_(question.planes),
      asked_(question.asked),
      camera_(camera),
      config_(config) {
  const double t = config.pose_sigma_m, r = config.pose_sigma_rad;
  Vector6d variances;
  variances << t * t, t * t, t * t, r * r, r * r, r * r;
  pose_ = {frame.T_cw, variances.asDiagonal()};
}

std::vector<PlaneMatch> IntegratedRule::Run() {
  LookAtPairs();
  pose_ = CorrectByAnchors(pose_, frame_, planes_, Anchors(), config_);
  LookAtPairs();
  IntegratedRule::CheckRanks();
  return Decide();
}

/// Where the pose is known from landmarks already: `matched` are (frame plane, landmark).
std::vector<PlaneMatch> IntegratedRule::RunAfter(
    const std::vector<std::pair<int, int>>& matched) {
  pose_ = CorrectByAnchors(pose_, frame_, map_.planes, matched, config_);
  LookAtPairs();
  return Decide();
}

void IntegratedRule::LookAtPairs() {
  pairs_.assign(frame_.planes.size(), Row(planes_.size()));
  for (const MapPlane& m : planes_) {
    if (m.merged_into) continue;
    std::optional<PlaneView> view;
    Box box_px;
    for (std::size_t f = 0; f < frame_.planes.size(); ++f) {
      const FramePlane& plane = frame_.planes[f];
      if (!asked_[f] || !CanBeMatched(plane)) continue;
      const PlaneComparison comparison = ComparePlanes(plane, m, pose_, config_);
      if (!(comparison.angle_rad < config_.gates.max_normal_angle_rad)) continue;
      if (!(comparison.chi2 < config_.new_chi2)) continue;
      if (!view) {
        view = ViewMapPlane(m, frame_, pose_.T_cw, camera_);
        box_px = ProjectedBox(m, pose_.T_cw, camera_);
      }
      pairs_[f][static_cast<std::size_t>(m.id)] = Weigh(plane, m, comparison, *view, box_px);
    }
  }
}

IntegratedRule::Pair IntegratedRule::Weigh(const FramePlane& f, const MapPlane& m,
                                           const PlaneComparison& comparison,
                                           const PlaneView& view, const Box& box_px) const {
  Pair out;
  out.overlap = Overlap(view, f);
  out.cost = comparison.chi2 + config_.overlap_weight * (1 - out.overlap) -
             2 * std::log(ClassLikelihood(m.class_belief, f.class_name)) +
             BoxCost(f, m, box_px);
  const bool shared = out.overlap > config_.min_overlap;
  out.extension = !shared && GoesOn(f, m);
  if (!shared && !out.extension) return out;
  // Beyond its known edge a surface must fit twice as well: there is no overlap to speak for
  // it.
  const double max_chi2 = shared ? config_.max_chi2 : 0.5 * config_.max_chi2;
  const bool fits =
      comparison.chi2 < max_chi2 && out.cost < config_.max_chi2 + config_.overlap_weight;
  out.verdict = fits ? Verdict::kPossible : Verdict::kDoubtful;
  return out;
}

/// Distance between the boxes, where both sides have one.
double IntegratedRule::BoxCost(const FramePlane& f, const MapPlane& m,
                               const Box& box_px) const {
  if (!f.detection || m.class_name.empty() || f.class_name.empty()) return 0.0;
  const auto d = static_cast<std::size_t>(*f.detection);
  if (d >= frame_.detections.size()) return 0.0;
  return config_.iou_weight * (1 - Iou(box_px, frame_.detections[d].box_px));
}

/// A surface that belongs to no object may go on where it has not been seen yet.
bool IntegratedRule::GoesOn(const FramePlane& f, const MapPlane& m) const {
  return f.class_name.empty() && m.class_name.empty() && m.area_m2 > config_.min_open_area_m2 &&
         InPlaneGap(f, m, Inverse(pose_.T_cw)) < config_.max_extension_gap_m;
}

/// Pairs that fit, overlap, and have no rival on either side.
std::vector<std::pair<int, int>> IntegratedRule::Anchors() const {
  constexpr double kMinOverlap = 0.5;
  std::vector<std::pair<int, int>> anchors;
  for (std::size_t f = 0; f < pairs_.size(); ++f) {
    if (frame_.planes[f].bad) continue;
    int best = kNone;
    bool contested = false;
    for (std::size_t m = 0; m < pairs_[f].size(); ++m) {
      const Pair& pair = pairs_[f][m];
      if (pair.verdict == Verdict::kRefused || pair.extension) continue;
      contested = contested || best != kNone;
      best = static_cast<int>(m);
    }
    if (best == kNone || contested) continue;
    const Pair& pair = pairs_[f][static_cast<std::size_t>(best)];
    if (pair.verdict == Verdict::kPossible && pair.overlap > kMinOverlap) {
      anchors.emplace_back(static_cast<int>(f), best);
    }
  }
  return anchors;
}

/// The rank test refuses pairs of little overlap whose points are distributed otherwise.
void IntegratedRule::CheckRanks() {
  constexpr double kAmpleOverlap = 0.6;
  const auto on_plane = FeaturesOnPlanes(frame_, pose_.T_cw, camera_);
  for (const MapPlane& m : planes_) {
    const auto id = static_cast<std::size_t>(m.id);
    std::optional<std::vector<Eigen::Vector3d>> visible;
    for (std::size_t f = 0; f < pairs_.size(); ++f) {
      Pair& pair = pairs_[f][id];
      if (pair.verdict != Verdict::kPossible) continue;
      if (!visible) visible = VisibleMapPoints(m, map_, frame_, pose_.T_cw, camera_);
      const auto test = TestPlaneRanks(on_plane[f], *visible, PlaneAxes(m.pi_w, *visible),
                                       config_.min_rank_points);
      if (!test) continue;
      if (test.value().p >= config_.rank_alpha) {
        pair.ranked = true;
      } else if (!(pair.overlap > kAmpleOverlap)) {
        pair.verdict = Verdict::kDoubtful;
      }
    }
  }
}

PlaneRelations IntegratedRule::Relations() const {
  PlaneRelations relations;
  relations.one_surface = PiecesOfOneSurface(frame_, camera_, config_);
  for (std::size_t m = 0; m < planes_.size(); ++m) {
    for (std::size_t n = m + 1; n < planes_.size(); ++n) {
      if (SharesFramePlane(m, n) && Duplicates(planes_[m], planes_[n])) {
        relations.duplicates.emplace_back(static_cast<int>(m), static_cast<int>(n));
      }
    }
  }
  return relations;
}

bool IntegratedRule::SharesFramePlane(std::size_t m, std::size_t n) const {
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Row& row) {
    return row[m].verdict == Verdict::kPossible && row[n].verdict == Verdict::kPossible;
  });
}

bool IntegratedRule::Duplicates(const MapPlane& one, const MapPlane& other) const {
  return SameClassOdds(one.class_belief, other.class_belief) > config_.min_class_odds &&
         ComparePlanes(one, other, config_).chi2 < config_.max_chi2 &&
         ComparePlanes(other, one, config_).chi2 < config_.max_chi2;
}

std::vector<PlaneMatch> IntegratedRule::Decide() const {
  std::vector<PlaneCandidate> candidates;
  for (std::size_t f = 0; f < pairs_.size(); ++f) {
    for (std::size_t m = 0; m < pairs_[f].size(); ++m) {
      if (pairs_[f][m].verdict != Verdict::kPossible) continue;
      candidates.push_back({static_cast<int>(f), static_cast<int>(m), pairs_[f][m].cost});
    }
  }
  const PlaneAssignment assignment = AssignPlanes(static_cast<int>(frame_.planes.size()),
                                                  candidates, Relations(), config_.min_margin);
  std::vector<PlaneMatch> matches(frame_.planes.size());
  for (std::size_t f = 0; f < matches.size(); ++f) {
    const int m = assignment.map_plane[f];
    if (m >= 0) {
      const Pair& pair = pairs_[f][static_cast<std::size_t>(m)];
      matches[f] = {PlaneDecision::kMatched, m,
                    RuleName(frame_.planes[f], planes_[static_cast<std::size_t>(m)], pair)};
    } else if (m == PlaneAssignment::kAmbiguous || Doubtful(pairs_[f])) {
      matches[f].by = kByAmbiguous;
    }
  }
  return matches;
}

bool IntegratedRule::Doubtful(const Row& row) {
  return std::any_of(row.begin(), row.end(),
                     [](const Pair& pair) { return pair.verdict == Verdict::kDoubtful; });
}

void IntegratedRule::YieldTo(const std::vector<MapPlane>& candidates,
                             std::vector<PlaneMatch>& matches) const {
  PlaneQuestion question{candidates, std::vector<bool>(matches.size(), false)};
  for (std::size_t f = 0; f < matches.size(); ++f) {
    question.asked[f] = matches[f].decision == PlaneDecision::kMatched;
  }
  IntegratedRule trial(frame_, map_, question, camera_, config_);
  trial.pose_ = pose_;
  trial.LookAtPairs();
  for (std::size_t f = 0; f < matches.size(); ++f) {
    if (!question.asked[f]) continue;
    const auto id = static_cast<std::size_t>(matches[f].map_plane);
    const double limit = pairs_[f][id].cost - config_.min_margin;
    for (const MapPlane& candidate : candidates) {
      const Pair& pair = trial.pairs_[f][static_cast<std::size_t>(candidate.id)];
      if (pair.verdict != Verdict::kPossible || !(pair.cost < limit)) continue;
      if (Duplicates(candidate, planes_[id])) continue;
      matches[f] = {};
      break;
    }
  }
}

}  // namespace slam
