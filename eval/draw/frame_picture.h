#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "eval/draw/draw_camera.h"
#include "eval/draw/frame_labels.h"
#include "eval/formats/run/run.h"

namespace eval {

/// All that is drawn of one frame.
struct FrameScene {
  cv::Mat rgb;                      ///< 8-bit BGR, as recorded
  std::optional<cv::Mat1w> labels;  ///< index of the frame plane + 1
  const RunFrame* frame = nullptr;  ///< null: the run says nothing of it
  std::optional<Pose> T_wc;         ///< null: not tracked
  const std::vector<RunMapPlane>* map = nullptr;
  std::optional<Camera> camera;  ///< null: only the segmentation can be drawn
};

/// The image scaled to `width_px` with its planes, in the colours of their map planes, and with
/// chips that tell id, class and decision. With a segmentation the segments are tinted, and
/// edge lines, vertices and faces are drawn; without one each map plane is a mere outline: its
/// four vertices if this frame found them, else the hull of the map plane.
cv::Mat DrawFrame(const FrameScene& scene, int width_px);

/// The labels that the planes of the frame ask for, in the order of the frame's planes, in a
/// picture `width_px` wide. Planes whose place is not seen ask for none.
struct PlaneLabel {
  const RunFramePlane* plane = nullptr;
  LabelWish wish;
};
std::vector<PlaneLabel> LabelsOfFrame(const FrameScene& scene, int width_px);

}  // namespace eval
