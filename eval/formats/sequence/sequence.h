#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "eval/formats/pose/pose.h"
#include "eval/formats/sequence/camera.h"
#include "eval/formats/sequence/frame_truth.h"
#include "eval/formats/sequence/image_lists.h"
#include "eval/formats/sequence/images.h"
#include "eval/formats/sequence/scene_truth.h"
#include "eval/formats/stamped_files.h"

namespace eval {

/// A sequence folder: lists, truth and where its images are. Everything optional in the format
/// is optional here. Images are read on demand.
struct Sequence {
  std::filesystem::path folder;
  std::vector<SequenceFrame> frames;  ///< by rising stamp
  std::optional<Camera> camera;       ///< as camera.yaml tells it
  /// The camera that truth is of: gt/camera.yaml where calibration errs, else `camera`.
  std::optional<Camera> true_camera;
  std::optional<Trajectory> groundtruth;  ///< T_gc
  std::optional<SceneTruth> scene;
  std::vector<FrameTruth> frame_truth;  ///< by rising stamp; empty without gt/frames.jsonl
  StampedFiles plane_id_files, object_id_files;
  /// Ids of planes that go by another id, in the images too; empty as a sequence is read.
  std::map<int, int> scored_as;
  /// It has the truth of every frame, as only a simulator knows it (HasTruthOfFrames). Stamps of
  /// truth, run and frames are then equal, not merely near.
  bool synthetic = false;
  double rolling_s = 0.0;  ///< colour is read row by row over this time; truth is of its middle
  bool complete = true;    ///< false: manifest.json says that it was not finished
  std::vector<Fault> warnings;  ///< faults that figures and pictures can live with
};

/// Reads the folder. Images are not opened: colour and depth need not be there.
/// @throws InputError naming the file and line, or the required file that is missing.
Sequence ReadSequence(const std::filesystem::path& folder);

/// Ids of the true planes that the frame shows, if the sequence has them; 0 = none.
/// @throws InputError for an image of another kind, and for an id that gt/scene.json does not have
std::optional<cv::Mat1w> ReadPlaneIds(const Sequence& sequence, double stamp_s);

}  // namespace eval
