#include "eval/planes/score_planes.h"

#include <cmath>
#include <map>
#include <numbers>

#include "eval/planes/true_frame.h"
#include "eval/planes/truth_of_planes.h"
#include "eval/planes/united_faces.h"
#include "io/input_error.h"

namespace eval {
namespace {

/// Everything that is known about one frame of a run.
struct FrameEvidence {
  int number = 0;
  TrueFrame truth;
  std::vector<RunFramePlane> planes;
  std::map<int, int> truth_of;            ///< by index of the frame plane
  std::optional<cv::Mat1w> segmentation;  ///< only where it decides the truth

  int TruthOf(const RunFramePlane& plane) const {
    const auto found = truth_of.find(plane.index);
    return found == truth_of.end() ? 0 : found->second;
  }
  /// A scored plane that is too small or too slanted to be asked for: found or not, it is no
  /// mistake.
  bool Ignored(int truth_id) const {
    const SeenPlane* seen = truth.Find(truth_id);
    return seen != nullptr && !seen->counted;
  }
};

/// The run put the plane on a map plane, known or new.
bool Decided(const RunFramePlane& plane) {
  return plane.map_plane.has_value() && plane.decision != "none";
}

/// Truth and machine labels of the frame without what is ignored. `label_of` gives the machine
/// label of a frame plane, 0 to leave it out.
template <typename LabelOf>
Overlap OverlapOf(const FrameEvidence& e, const LabelOf& label_of) {
  std::map<int, int> region_of;
  for (const RunFramePlane& plane : e.planes) {
    if (!e.Ignored(e.TruthOf(plane))) region_of[plane.index + 1] = label_of(plane);
  }
  return CountedOverlap(e.truth, *e.segmentation, region_of);
}

class PlaneScorer {
 public:
  void Add(const FrameEvidence& e) {
    ++score_.frames;
    for (const SeenPlane& seen : e.truth.planes) {
      if (seen.counted) seen_.insert(seen.plane->id);
    }
    AddDecisions(e);
    AddParameters(e);
    AddCorners(e);
    if (e.segmentation) AddRegions(e);
    tracking_.push_back(e.segmentation ? TrackByPixels(e) : TrackByTruth(e));
  }

  PlaneScore Finish(const Run& run, const SceneTruth& scene, const TrajectoryScore& trajectory,
                    bool by_pixels) {
    score_.by_pixels = by_pixels;
    score_.normal_deg = SpreadOf(normal_deg_);
    score_.offset_mm = SpreadOf(offset_mm_);
    score_.association = ScoreAssociation(records_);
    score_.clear = ScoreClear(tracking_);
    score_.identity = ScoreIdentity(tracking_);
    score_.hota = ScoreHota(tracking_);
    if (run.has_map) {
      score_.map = ScoreMap(run.map, scene, trajectory.gauge, records_, seen_);
    }
    if (region_frames_ > 0) FinishRegions();
    return score_;
  }

 private:
  void AddDecisions(const FrameEvidence& e) {
    for (const RunFramePlane& plane : e.planes) {
      if (Decided(plane)) records_.push_back({e.number, e.TruthOf(plane), *plane.map_plane});
    }
  }

  void AddParameters(const FrameEvidence& e) {
    for (const RunFramePlane& plane : e.planes) {
      const SeenPlane* seen = e.truth.Find(e.TruthOf(plane));
      if (plane.bad || seen == nullptr) continue;
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

  void AddRegions(const FrameEvidence& e) {
    ++region_frames_;
    std::map<int, int> truth_of_label;
    const Overlap overlap = OverlapOf(e, [&](const RunFramePlane& plane) {
      if (plane.bad) return 0;
      truth_of_label[plane.index + 1] = e.TruthOf(plane);
      return plane.index + 1;
    });
    hoover_ += ScoreHoover(overlap);
    panoptic_ += CountPanoptic(overlap);
    for (const auto& [truth, pixels] : overlap.truth_pixels) truth_pixels_ += double(pixels);
    for (const auto& [label, pixels] : overlap.machine_pixels) {
      machine_pixels_ += double(pixels);
      right_pixels_ += double(overlap.Shared(truth_of_label.at(label), label));
    }
  }

  void FinishRegions() {
    const double n = region_frames_;
    const PrecisionRecall pixels = MakeScores(right_pixels_, machine_pixels_, truth_pixels_);
    score_.regions = {hoover_.truth / n, hoover_.machine / n, hoover_.correct / n,
                      hoover_.over / n,  hoover_.under / n,   hoover_.missed / n,
                      hoover_.noise / n, panoptic_,           pixels.precision,
                      pixels.recall};
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

  static TrackingFrame TrackByPixels(const FrameEvidence& e) {
    const std::map<int, int> labels = LabelsOfMapPlanes(e);
    const Overlap overlap = OverlapOf(e, [&](const RunFramePlane& plane) {
      return Decided(plane) ? labels.at(*plane.map_plane) : 0;
    });
    TrackingFrame frame;
    std::vector<int> machine;
    for (const auto& [truth, pixels] : overlap.truth_pixels) frame.truth_ids.push_back(truth);
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
    return frame;
  }

  /// Without masks: similarity 1 where a frame plane on the map plane shows the truth, else 0.
  static TrackingFrame TrackByTruth(const FrameEvidence& e) {
    TrackingFrame frame;
    for (const SeenPlane& seen : e.truth.planes) {
      if (seen.counted) frame.truth_ids.push_back(seen.plane->id);
    }
    std::map<int, std::set<int>> truths_of;  // by map plane
    for (const RunFramePlane& plane : e.planes) {
      const int truth = e.TruthOf(plane);
      if (Decided(plane) && !e.Ignored(truth)) truths_of[*plane.map_plane].insert(truth);
    }
    frame.similarity = Eigen::MatrixXd::Zero(Eigen::Index(frame.truth_ids.size()),
                                             Eigen::Index(truths_of.size()));
    for (const auto& [id, truths] : truths_of) {
      const auto column = Eigen::Index(frame.predicted_ids.size());
      frame.predicted_ids.push_back(id);
      for (std::size_t i = 0; i < frame.truth_ids.size(); ++i) {
        if (truths.count(frame.truth_ids[i]) > 0)
          frame.similarity(Eigen::Index(i), column) = 1.0;
      }
    }
    return frame;
  }

  PlaneScore score_;
  HooverScore hoover_;
  PanopticCounts panoptic_;
  int region_frames_ = 0;
  double truth_pixels_ = 0.0, machine_pixels_ = 0.0, right_pixels_ = 0.0;
  std::vector<double> normal_deg_, offset_mm_;
  std::vector<AssociationRecord> records_;
  std::vector<TrackingFrame> tracking_;
  std::set<int> seen_;
};

/// A label without a plane would be pixels that nobody answers for.
void RequireKnownLabels(const Run& run, const FrameEvidence& e) {
  std::set<int> known{0};
  for (const RunFramePlane& plane : e.planes) known.insert(plane.index + 1);
  int last = 0;
  for (const std::uint16_t label : *e.segmentation) {
    if (label == last || known.count(label) > 0) {
      last = label;
      continue;
    }
    throw io::InputError(
        run.segmentation_files.Find(e.truth.stamp_s)->string(),
        "shows the value " + std::to_string(label) + ", but the frame has no plane of index " +
            std::to_string(label - 1) + "; write index + 1 of the plane, 0 for none");
  }
}

void DecideTruth(const Run& run, bool by_pixels, FrameEvidence& e) {
  if (!by_pixels || !e.truth.plane_ids) {
    for (const RunFramePlane& plane : e.planes) {
      e.truth_of[plane.index] = TruthByGeometry(e.truth, plane);
    }
    return;
  }
  e.segmentation = ReadSegmentation(run, e.truth.stamp_s);
  if (!e.segmentation) {
    if (!e.planes.empty()) {
      throw io::InputError((run.folder / "segmentation").string(),
                           "has no image for the frame at " + std::to_string(e.truth.stamp_s) +
                               " s, which has planes; save all of them or none");
    }
    e.segmentation = cv::Mat1w::zeros(e.truth.plane_ids->size());
  }
  if (e.segmentation->size() != e.truth.plane_ids->size()) {
    throw io::InputError(
        (run.folder / "segmentation").string(),
        "the image at " + std::to_string(e.truth.stamp_s) +
            " s differs in size from the truth's; is this the right sequence?");
  }
  RequireKnownLabels(run, e);
  e.truth_of = TruthByPixels(e.truth, *e.segmentation);
}

}  // namespace

std::optional<PlaneScore> ScorePlanes(const Run& run, const Sequence& as_read,
                                      const TrajectoryScore& trajectory) {
  const Sequence sequence = WithUnitedFaces(as_read);
  if (!sequence.scene || !sequence.groundtruth || !run.has_planes) return std::nullopt;
  const bool by_pixels = !run.segmentation_files.empty() && !sequence.plane_id_files.empty();
  std::vector<double> frame_stamps_s, run_stamps_s;
  for (const SequenceFrame& frame : sequence.frames) frame_stamps_s.push_back(frame.stamp_s);
  for (const RunFrame& frame : run.frames) run_stamps_s.push_back(frame.stamp_s);
  const auto poses = TruePosesOfFrames(*sequence.groundtruth, frame_stamps_s, true);
  PlaneScorer scorer;
  for (std::size_t i = 0; i < frame_stamps_s.size(); ++i) {
    if (!poses[i]) continue;
    FrameEvidence e;
    e.number = static_cast<int>(i);
    e.truth = ReadTrueFrame(sequence, frame_stamps_s[i], *poses[i]);
    const auto found = FindStamp(run_stamps_s, frame_stamps_s[i]);
    if (found) e.planes = run.frames[*found].planes;
    DecideTruth(run, by_pixels, e);
    scorer.Add(e);
  }
  return scorer.Finish(run, *sequence.scene, trajectory, by_pixels);
}

}  // namespace eval
