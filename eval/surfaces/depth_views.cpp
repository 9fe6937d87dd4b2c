#include "eval/surfaces/depth_views.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <opencv2/calib3d.hpp>

#include "eval/trajectory/true_pose.h"

namespace eval {
namespace {

cv::Mat2d RaysOf(const Camera& camera) {
  cv::Mat2d pixels(camera.height, camera.width);
  pixels.forEach([](cv::Vec2d& pixel, const int* at) {
    pixel = {double(at[1]), double(at[0])};
  });
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const auto& k = camera.distortion;
  cv::Mat rays;
  cv::undistortPoints(pixels.reshape(2, 1), rays, K,
                      cv::Vec<double, 5>(k[0], k[1], k[2], k[3], k[4]));
  return rays.reshape(2, camera.height);
}

}  // namespace

DepthViews::DepthViews(const Sequence& sequence, const Camera& camera,
                       const std::optional<DepthRegistration>& registration)
    : folder_(sequence.folder), camera_(camera), registration_(registration) {
  if (registration_) {
    camera_ = registration_->colour;
    camera_.depth_factor = camera.depth_factor;
  }
  rays_ = RaysOf(camera_);
  if (!sequence.groundtruth) {
    throw io::InputError((folder_ / "groundtruth.txt").string(),
                         "is missing; surfaces need the true poses of the camera, lines of `t "
                         "tx ty tz qx qy qz qw`");
  }
  Trajectory poses = *sequence.groundtruth;
  std::stable_sort(poses.begin(), poses.end(), [](const StampedPose& a, const StampedPose& b) {
    return a.stamp_s < b.stamp_s;
  });
  int number = 0;
  for (const SequenceFrame& frame : sequence.frames) {
    if (const auto T_gc = PoseAt(poses, frame.depth_stamp_s))
      frames_.push_back({frame, number, *T_gc});
    ++number;
  }
  if (frames_.empty()) {
    throw io::InputError(
        (folder_ / "groundtruth.txt").string(),
        "has no pose at the time of any depth image, nor one before and one after "
        "it; are both of one clock?");
  }
}

cv::Mat1f ReadDepthOnColour(const std::filesystem::path& folder, const SequenceFrame& frame,
                            double depth_factor, const Camera& taken_by,
                            const std::optional<DepthRegistration>& registration) {
  Folder files(folder);
  const cv::Mat stored =
      ReadImage(files, frame.depth, {CV_16U, 1, {taken_by.width, taken_by.height}});
  cv::Mat1f depth_m;
  stored.convertTo(depth_m, CV_32F, 1.0 / depth_factor);
  depth_m.setTo(0, stored == std::numeric_limits<std::uint16_t>::max());
  return registration ? LayOnColour(depth_m, *registration) : depth_m;
}

DepthView DepthViews::Read(std::size_t i) const {
  const PosedFrame& posed = frames_.at(i);
  const Camera& taken_by = registration_ ? registration_->depth : camera_;
  return {
      posed.frame.stamp_s, posed.T_gc,
      ReadDepthOnColour(folder_, posed.frame, camera_.depth_factor, taken_by, registration_)};
}

}  // namespace eval
