#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "eval/check/sequence_truth.h"

namespace eval {

/// A frame as the deep checks look at it.
struct DeepFrame {
  std::string name, plane_file;
  double stamp_s = 0;
  std::size_t pose = 0;  ///< index into SequenceTruth::poses
  cv::Mat ids;           ///< CV_16U
  /// CV_16U; empty when there is none, or no pose of its time.
  cv::Mat depth;
  double depth_stamp_s = 0;
  cv::Mat depth_ids;  ///< the planes that `depth` shows: all, or InnerIds
  Pose T_wc_depth;    ///< when depth was taken
};

/// Up to 24 frames with truth, spread over the sequence, and the rays of their pixels.
class DeepFrames {
 public:
  /// @pre truth has a camera; kept by reference
  DeepFrames(const Folder& folder, const SequenceTruth& truth);

  const std::vector<DeepFrame>& frames() const { return frames_; }
  const SequenceTruth& truth() const { return truth_; }
  double unit_m() const { return unit_m_; }  ///< what a unit of the depth image is
  const Pose& PoseOf(const DeepFrame& frame) const { return truth_.poses[frame.pose].T_wc; }
  /// (x/z, y/z, 1) of a pixel of the image.
  const Eigen::Vector3d& Ray(int u, int v) const {
    return rays_[static_cast<std::size_t>(v) * static_cast<std::size_t>(truth_.camera->width) +
                 static_cast<std::size_t>(u)];
  }
  /// Pixel of a point with z > 0, with the lens's distortion. Far outside the image, where a
  /// lens may fold, it is a place outside the image.
  Eigen::Vector2d Pixel(const Eigen::Vector3d& x_c) const;

 private:
  void Load(const Folder& folder);
  void AddDepth(const Folder& folder, const SequenceFrame& pair, DeepFrame& frame) const;
  cv::Mat Read(const Folder& folder, const std::string& file) const;

  const SequenceTruth& truth_;
  double unit_m_;
  double reach2_ = 0;  ///< largest x^2 + y^2 of a ray
  std::vector<Eigen::Vector3d> rays_;
  std::vector<DeepFrame> frames_;
};

}  // namespace eval
