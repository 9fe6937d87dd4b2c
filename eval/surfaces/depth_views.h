#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "eval/formats/sequence/sequence.h"
#include "eval/surfaces/depth_registration.h"

namespace eval {

/// Depth that a camera saw from a known place.
struct DepthView {
  double stamp_s = 0.0;  ///< of the frame: the colour image's
  Pose T_gc;             ///< at the time of the depth image
  cv::Mat1f depth_m;     ///< along the optical axis, on the colour image's pixels; 0 = none
};

/// The depth image of a frame, metres on the colour image's pixels; 0 = none.
/// @param depth_factor  units a metre; 65535, which 7-Scenes and others write where nothing was
///   measured, is none
/// @param taken_by      the camera of the depth image, for its size
/// @throws InputError when it cannot be read or has another size
cv::Mat1f ReadDepthOnColour(const std::filesystem::path& folder, const SequenceFrame& frame,
                            double depth_factor, const Camera& taken_by,
                            const std::optional<DepthRegistration>& registration);

/// The depth images of a recording, each with the recording's own camera truth.
class DepthViews {
 public:
  /// @param camera        of the colour image; depth_factor is that of the depth images
  /// @param registration  for depth that is not laid on colour; its colour camera takes the
  ///   place of `camera`
  /// @throws InputError when the recording has no groundtruth.txt
  DepthViews(const Sequence& sequence, const Camera& camera,
             const std::optional<DepthRegistration>& registration);

  /// Frames whose pose is known, by rising stamp.
  std::size_t size() const { return frames_.size(); }
  double StampOf(std::size_t i) const { return frames_[i].frame.stamp_s; }
  const SequenceFrame& FrameOf(std::size_t i) const { return frames_[i].frame; }
  /// Its place in the sequence, from 0; frames without a pose count there.
  int NumberOf(std::size_t i) const { return frames_[i].number; }
  const Pose& PoseOf(std::size_t i) const { return frames_[i].T_gc; }
  /// @throws InputError when the depth image cannot be read or has another size
  DepthView Read(std::size_t i) const;

  /// (x, y) of the ray (x, y, 1) of each pixel, the lens's distortion removed.
  const cv::Mat2d& rays() const { return rays_; }
  const Camera& camera() const { return camera_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  struct PosedFrame {
    SequenceFrame frame;
    int number;
    Pose T_gc;
  };
  std::filesystem::path folder_;
  Camera camera_;
  std::optional<DepthRegistration> registration_;
  std::vector<PosedFrame> frames_;
  cv::Mat2d rays_;
};

}  // namespace eval
