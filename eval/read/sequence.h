#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/read/scene_truth.h"
#include "eval/read/stamped_files.h"

namespace eval {

/// Pinhole camera of camera.yaml, with its distortion; pixel centres are whole numbers, the
/// first at (0, 0).
struct Camera {
  int width = 0, height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< pixels
  double fps = 0.0;
  double depth_factor = 0.0;           ///< depth image units per metre
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3, OpenCV's order

  bool distorted() const { return distortion != std::array<double, 5>{}; }
};

/// One frame: a colour image with its depth image, files relative to the sequence.
struct SequenceFrame {
  double stamp_s = 0.0;  ///< of the colour image: the frame's id
  std::string rgb;
  double depth_stamp_s = 0.0;
  std::string depth;
};

/// A sequence folder: lists, truth and where its images are. Everything optional in the format
/// is optional here. Images are read on demand.
struct Sequence {
  std::filesystem::path folder;
  std::vector<SequenceFrame> frames;  ///< by rising stamp
  std::optional<Camera> camera;
  std::optional<Trajectory> groundtruth;  ///< T_gc
  std::optional<SceneTruth> scene;
  std::vector<FrameTruth> frame_truth;  ///< by rising stamp; empty without gt/frames.jsonl
  StampedFiles plane_id_files, object_id_files;
  /// Ids of planes that go by another id, in the images too; empty as a sequence is read.
  std::map<int, int> scored_as;
  /// A simulator wrote it: manifest.json says "pas-sequence/1". Stamps of truth and frames are
  /// then equal, not merely near.
  bool synthetic = false;
};

/// Reads the folder; images are not opened.
/// @throws InputError naming the file and line, or the required file that is missing.
Sequence ReadSequence(const std::filesystem::path& folder);

/// Pairs of `rgb.txt` and `depth.txt`: for each colour image the nearest depth image, if it is
/// at most 20 ms away; the earlier one on ties.
std::vector<SequenceFrame> AssociateByTime(const std::filesystem::path& rgb_list,
                                           const std::filesystem::path& depth_list);

/// @throws InputError naming the file, the key and its line.
Camera ReadCamera(const std::filesystem::path& file);

/// An image of one channel and 8 or 16 bits, widened to 16. @throws InputError.
cv::Mat1w ReadLabels(const std::filesystem::path& file);

/// Truth images of the frame, if the sequence has them; 0 = none.
std::optional<cv::Mat1w> ReadPlaneIds(const Sequence& sequence, double stamp_s);
std::optional<cv::Mat1w> ReadObjectIds(const Sequence& sequence, double stamp_s);

}  // namespace eval
