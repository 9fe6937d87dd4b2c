#include "eval/planes/frame_evidence.h"

#include <set>
#include <string>

#include "eval/planes/truth_of_planes.h"
#include "eval/trajectory/score_trajectory.h"
#include "io/input_error.h"

namespace eval {
namespace {

/// A label without a plane would be pixels that nobody answers for.
void RequireKnownLabels(const Run& run, const FrameEvidence& e) {
  std::set<int> known{0};
  for (const RunFramePlane& plane : e.planes) known.insert(plane.index + 1);
  for (const auto& [labels, pixels] : *e.pairs) {
    if (known.count(labels.second) > 0) continue;
    throw io::InputError(run.segmentation_files.Find(e.truth.stamp_s)->string(),
                         "shows the value " + std::to_string(labels.second) +
                             ", but the frame has no plane of index " +
                             std::to_string(labels.second - 1) +
                             "; write index + 1 of the plane, 0 for none");
  }
}

/// Labels of a system that says nothing else: each is a plane.
std::vector<RunFramePlane> PlanesOfLabels(const LabelPairs& pairs) {
  std::vector<RunFramePlane> planes;
  for (const auto& [label, pixels] : OverlapOf(pairs).machine_pixels) {
    RunFramePlane plane;
    plane.index = label - 1;
    plane.pixels = static_cast<int>(pixels);
    planes.push_back(std::move(plane));
  }
  return planes;
}

void ReadPixels(const Run& run, FrameEvidence& e) {
  auto segmentation = ReadSegmentation(run, e.truth.stamp_s);
  if (!segmentation) {
    if (!e.planes.empty()) {
      throw io::InputError((run.folder / "segmentation").string(),
                           "has no image for the frame at " + std::to_string(e.truth.stamp_s) +
                               " s, which has planes; save all of them or none");
    }
    segmentation = cv::Mat1w::zeros(e.truth.plane_ids->size());
  }
  if (segmentation->size() != e.truth.plane_ids->size()) {
    throw io::InputError(
        (run.folder / "segmentation").string(),
        "the image at " + std::to_string(e.truth.stamp_s) +
            " s differs in size from the truth's; is this the right sequence?");
  }
  e.pairs = CountPairs(*e.truth.plane_ids, *segmentation);
  if (run.has_planes) {
    RequireKnownLabels(run, e);
  } else {
    e.planes = PlanesOfLabels(*e.pairs);
  }
  e.truth_of = TruthByPixels(e.truth, *e.pairs);
}

}  // namespace

int FrameEvidence::TruthOf(const RunFramePlane& plane) const {
  const auto found = truth_of.find(plane.index);
  return found == truth_of.end() ? 0 : found->second;
}

bool FrameEvidence::Ignored(int truth_id) const {
  const SeenPlane* seen = truth.Find(truth_id);
  return seen != nullptr && !seen->counted;
}

bool Decided(const RunFramePlane& plane) {
  return plane.map_plane.has_value() && plane.decision != "none";
}

LabelPairs PairsOf(const FrameEvidence& e,
                   const std::function<int(const RunFramePlane& plane)>& label_of) {
  std::map<int, int> region_of;
  for (const RunFramePlane& plane : e.planes) {
    if (!e.Ignored(e.TruthOf(plane))) region_of[plane.index + 1] = label_of(plane);
  }
  return CountedPairs(e.truth, *e.pairs, region_of);
}

bool DecidedByPixels(const Run& run, const Sequence& sequence) {
  return !run.segmentation_files.empty() && !sequence.plane_id_files.empty();
}

void VisitEvidence(const Run& run, const Sequence& sequence,
                   const std::function<void(const FrameEvidence&)>& visit) {
  const bool by_pixels = DecidedByPixels(run, sequence);
  const std::vector<double> frame_stamps_s = StampsOf(sequence.frames);
  const std::vector<double> run_stamps_s = StampsOf(run.frames);
  const auto poses = TruePosesOfFrames(*sequence.groundtruth, frame_stamps_s, true);
  for (std::size_t i = 0; i < frame_stamps_s.size(); ++i) {
    if (!poses[i]) continue;
    FrameEvidence e;
    e.number = static_cast<int>(i);
    e.truth = ReadTrueFrame(sequence, frame_stamps_s[i], *poses[i]);
    const auto found = FindStamp(run_stamps_s, frame_stamps_s[i]);
    if (found) e.planes = run.frames[*found].planes;
    if (by_pixels && e.truth.plane_ids) {
      ReadPixels(run, e);
    } else {
      for (const RunFramePlane& plane : e.planes) {
        e.truth_of[plane.index] = TruthByGeometry(e.truth, plane);
      }
    }
    visit(e);
  }
}

}  // namespace eval
