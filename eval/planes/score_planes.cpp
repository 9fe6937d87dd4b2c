#include "eval/planes/score_planes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "eval/planes/united_faces.h"

namespace eval {
namespace {

class PlaneScorer {
 public:
  explicit PlaneScorer(bool from_frame_planes) { score_.from_frame_planes = from_frame_planes; }

  void Add(const FrameEvidence& e) {
    ++score_.frames;
    for (const SeenPlane& seen : e.truth.planes) {
      if (seen.counted) seen_.insert(seen.plane->id);
    }
    FrameScore frame{e.number, 0, std::nullopt};
    for (const SeenPlane& seen : e.truth.planes) frame.true_planes += seen.counted ? 1 : 0;
    if (e.pairs) frame.regions = regions_.Add(e);
    score_.by_frame.push_back(frame);
    if (!score_.from_frame_planes) return;
    score_.history.Add(e);
    AddParameters(e);
    AddCorners(e);
    tracking_.push_back(e.pairs ? TrackByPixels(e) : TrackByTruth(e));
  }

  /// To be called once: the score leaves the scorer.
  PlaneScore Finish(const Run& run, const SceneTruth& scene, const TrajectoryScore& trajectory,
                    bool by_pixels) {
    score_.by_pixels = by_pixels;
    score_.normal_deg = SpreadOf(normal_deg_);
    score_.offset_mm = SpreadOf(offset_mm_);
    score_.regions = regions_.Score();
    const std::vector<AssociationRecord> records = RecordsOf(score_.history.decisions);
    score_.association = ScoreAssociation(records);
    score_.undecided = FindUndecided(score_.history);
    score_.ambiguous = FindAmbiguous(score_.history);
    score_.clear = ScoreClear(tracking_);
    score_.identity = ScoreIdentity(tracking_);
    score_.hota = ScoreHota(tracking_);
    score_.steps = ScoreSteps(score_.history, scene);
    score_.events = FindPlaneEvents(score_.history, score_.undecided, score_.ambiguous,
                                    {run.map, scene, trajectory.gauge});
    if (!run.has_map) return std::move(score_);
    score_.map = score_.from_frame_planes
                     ? ScoreMap(run.map, scene, trajectory.gauge, records, seen_)
                     : ScoreMap(run.map, scene, trajectory.gauge, seen_);
    return std::move(score_);
  }

 private:
  void AddParameters(const FrameEvidence& e) {
    for (const RunFramePlane& plane : e.planes) {
      const SeenPlane* seen = e.truth.Find(e.TruthOf(plane));
      if (plane.bad || seen == nullptr || !seen->counted) continue;
      const Eigen::Vector3d foot_c =
          plane.centroid_c - SignedDistance(plane.pi_c, plane.centroid_c) * plane.pi_c.n;
      normal_deg_.push_back(Angle(plane.pi_c.n, seen->pi_c.n) * 180.0 / std::numbers::pi);
      offset_mm_.push_back(std::abs(SignedDistance(seen->pi_c, foot_c)) * 1e3);
    }
  }

  void AddCorners(const FrameEvidence& e) {
    std::map<int, std::vector<Eigen::Vector3d>> claimed_c;
    for (const RunFramePlane& plane : e.planes) {
      if (plane.bad) continue;
      auto& corners = claimed_c[e.TruthOf(plane)];
      corners.insert(corners.end(), plane.vertices_c.begin(), plane.vertices_c.end());
    }
    score_.corners.claimed += static_cast<int>(claimed_c[0].size());
    for (const SeenPlane& seen : e.truth.planes) {
      score_.corners.AddPlane(seen, claimed_c[seen.plane->id]);
    }
  }

  /// Map planes of the frame, one label each: masks of one map plane are one prediction.
  static std::map<int, int> LabelsOfMapPlanes(const FrameEvidence& e) {
    std::map<int, int> labels;
    for (const RunFramePlane& plane : e.planes) {
      if (Decided(plane)) labels.emplace(*plane.map_plane, 0);
    }
    int next = 1;
    for (auto& [id, label] : labels) label = next++;
    return labels;
  }

  /// Adds the map planes that hold pixels, with their IoU.
  static void FillSimilarity(const Overlap& overlap, const std::map<int, int>& labels,
                             TrackingFrame& frame) {
    std::vector<int> machine;
    for (const auto& [id, label] : labels) {
      if (overlap.machine_pixels.count(label) == 0) continue;
      frame.predicted_ids.push_back(id);
      machine.push_back(label);
    }
    frame.similarity.resize(Eigen::Index(frame.truth_ids.size()), Eigen::Index(machine.size()));
    for (std::size_t i = 0; i < frame.truth_ids.size(); ++i) {
      for (std::size_t j = 0; j < machine.size(); ++j) {
        frame.similarity(Eigen::Index(i), Eigen::Index(j)) =
            overlap.IoU(frame.truth_ids[i], machine[j]);
      }
    }
  }

  static TrackingFrame TrackByPixels(const FrameEvidence& e) {
    const std::map<int, int> labels = LabelsOfMapPlanes(e);
    const Overlap overlap = OverlapOf(PairsOf(e, [&](const RunFramePlane& plane) {
      return Decided(plane) ? labels.at(*plane.map_plane) : 0;
    }));
    TrackingFrame frame;
    for (const auto& [truth, pixels] : overlap.truth_pixels) frame.truth_ids.push_back(truth);
    FillSimilarity(overlap, labels, frame);
    return frame;
  }

  /// Without masks, the IoU of what frame planes hold of the truth and of the map plane: of two map
  /// planes on one truth the one that holds most of it is the match, whatever their ids.
  static TrackingFrame TrackByTruth(const FrameEvidence& e) {
    TrackingFrame frame;
    for (const SeenPlane& seen : e.truth.planes) {
      if (seen.counted) frame.truth_ids.push_back(seen.plane->id);
    }
    const std::map<int, int> labels = LabelsOfMapPlanes(e);
    LabelPairs pairs;
    for (const RunFramePlane& plane : e.planes) {
      const int truth = e.TruthOf(plane);
      if (!Decided(plane) || e.Ignored(truth)) continue;
      pairs[{truth, labels.at(*plane.map_plane)}] += plane.pixels;
    }
    FillSimilarity(OverlapOf(pairs), labels, frame);
    return frame;
  }

  PlaneScore score_;
  RegionScorer regions_;
  std::vector<double> normal_deg_, offset_mm_;
  std::vector<TrackingFrame> tracking_;
  std::set<int> seen_;
};

}  // namespace

std::string WhyNoPlaneScore(const Sequence& sequence) {
  if (!sequence.scene || !sequence.plane_id_files.empty() || !sequence.frame_truth.empty()) {
    return "";
  }
  return "the sequence has neither gt/plane_id/ nor gt/frames.jsonl, which tell the planes of "
         "a "
         "frame";
}

std::optional<PlaneScore> ScorePlanes(const Run& run, const Sequence& as_read,
                                      const TrajectoryScore& trajectory) {
  const Sequence sequence = WithUnitedFaces(as_read);
  if (!sequence.scene || !sequence.groundtruth) return std::nullopt;
  if (!WhyNoPlaneScore(sequence).empty()) return std::nullopt;
  const bool by_pixels = DecidedByPixels(run, sequence);
  if (!run.has_planes && !run.has_map && !by_pixels) return std::nullopt;
  PlaneScorer scorer(run.has_planes);
  VisitEvidence(run, sequence, [&](const FrameEvidence& e) { scorer.Add(e); });
  return scorer.Finish(run, *sequence.scene, trajectory, by_pixels);
}

}  // namespace eval
