#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "eval/formats/sequence/sequence.h"

namespace eval {

/// When a true plane counts as one that can be seen in a frame.
inline constexpr double kMinPixels = 1000.0;  ///< at 640 x 480; scaled with the image's area
inline constexpr double kMaxIncidence_deg = 75.0;  ///< at the middle of its visible pixels

/// A scored true plane in one frame; camera frame c, metres.
struct SeenPlane {
  const TruthPlane* plane = nullptr;
  const TruthObject* object = nullptr;
  Plane pi_c;
  std::vector<Eigen::Vector3d> corners_c;
  std::vector<bool> corner_in_view;  ///< inside the image and not hidden by something else
  int pixels = 0;
  double incidence_deg = 0.0;
  bool counted = false;  ///< it passes both rules above
};

/// What the truth says about one frame.
struct TrueFrame {
  double stamp_s = 0.0;
  Pose T_gc;
  double image_px = 0.0;               ///< pixels of the image
  std::vector<SeenPlane> planes;       ///< scored planes with at least one pixel, by rising id
  std::optional<cv::Mat1w> plane_ids;  ///< ids of all planes; 0 = none

  const SeenPlane* Find(int id) const;  ///< null if the frame does not show it
};

/// Builds it from gt/plane_id, or from the pixel counts of gt/frames.jsonl where there is no
/// such image (corners then count when they are inside the image).
/// @throws InputError if the sequence has neither, or no camera.yaml.
TrueFrame ReadTrueFrame(const Sequence& sequence, double stamp_s, const Pose& T_gc);

}  // namespace eval
