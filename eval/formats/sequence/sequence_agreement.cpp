#include "eval/formats/sequence/sequence_agreement.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/formats/stamps.h"

namespace eval {
namespace {

const std::string kFrameTruth = "gt/frames.jsonl";
const std::string kPoses = "groundtruth.txt";

bool IsFaultless(Folder& folder, const std::string& file) {
  return std::none_of(folder.faults().begin(), folder.faults().end(), [&](const Fault& fault) {
    return fault.file == file && fault.severity != Severity::kWarning;
  });
}

void TellUnknownIds(Folder& folder, const FrameTruth& frame, const SceneTruth& scene) {
  const auto tell = [&](const char* list, std::size_t i, int id) {
    folder.Tell({kFrameTruth, frame.line, fmt::format("/{}/{}/id", list, i),
                 fmt::format("{} is not in gt/scene.json", id), "mend the id"});
  };
  for (std::size_t i = 0; i < frame.objects.size(); ++i) {
    const int id = frame.objects[i].id;
    if (id != 0 && scene.FindObject(id) == nullptr) tell("objects", i, id);
  }
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    const int id = frame.planes[i].id;
    if (id != 0 && scene.FindPlane(id) == nullptr) tell("planes", i, id);
  }
}

}  // namespace

bool HasTruthOfFrames(const Folder& folder) {
  return folder.Has("gt/scene.json") || folder.Has(kFrameTruth);
}

void TellFramesWithoutPose(Folder& folder, const std::vector<double>& frames_s,
                           const Trajectory& truth, bool exact) {
  const std::vector<double> poses_s = StampsOf(truth);
  if (exact) {
    for (const double frame_s : frames_s) {
      if (FindStamp(poses_s, frame_s)) continue;
      folder.Tell(kPoses, 0, fmt::format("lacks a pose for the frame {:.6f}", frame_s),
                  "write the pose of every frame");
    }
    return;
  }
  const bool overlaps = std::any_of(frames_s.begin(), frames_s.end(), [&](double frame_s) {
    return NearestStamp(poses_s, frame_s, kMaxStampDifference_s).has_value();
  });
  if (overlaps || frames_s.empty() || truth.empty() || !IsFaultless(folder, kPoses)) return;
  folder.Tell(kPoses, 0,
              fmt::format("has no pose within {:.0f} ms of any frame: poses are from {:.3f} to "
                          "{:.3f} s, frames from {:.3f} to {:.3f} s",
                          1e3 * kMaxStampDifference_s, poses_s.front(), poses_s.back(),
                          frames_s.front(), frames_s.back()),
              "bring poses and images to one clock, or remove the file");
}

void TellFrameTruth(Folder& folder, const std::vector<double>& frames_s,
                    const std::vector<FrameTruth>& truth, const SceneTruth* scene) {
  for (const FrameTruth& frame : truth) {
    if (scene != nullptr) TellUnknownIds(folder, frame, *scene);
    if (FindStamp(frames_s, frame.stamp_s)) continue;
    folder.Tell({kFrameTruth, frame.line, "/timestamp",
                 fmt::format("{:.6f} is no time of a frame", frame.stamp_s),
                 "use the time of the colour image"},
                Severity::kFlaw);
  }
  const std::vector<double> truth_s = StampsOf(truth);
  for (const double frame_s : frames_s) {
    if (FindStamp(truth_s, frame_s)) continue;
    folder.Tell(kFrameTruth, 0, fmt::format("lacks the frame {:.6f} of rgb.txt", frame_s),
                "write the truth of every frame");
  }
}

void TellSequenceDisagreements(Folder& folder, const Sequence& sequence) {
  const std::vector<double> frames_s = StampsOf(sequence.frames);
  if (sequence.groundtruth) {
    TellFramesWithoutPose(folder, frames_s, *sequence.groundtruth, sequence.synthetic);
  } else if (sequence.synthetic) {
    folder.Require(kPoses, "write the pose of every frame", Severity::kWarning);
  }
  if (folder.Has(kFrameTruth)) {
    TellFrameTruth(folder, frames_s, sequence.frame_truth,
                   sequence.scene ? &*sequence.scene : nullptr);
  }
}

}  // namespace eval
