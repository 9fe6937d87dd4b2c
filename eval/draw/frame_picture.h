#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "eval/draw/draw_camera.h"
#include "eval/formats/run.h"

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

/// The image scaled to `width_px`, with each plane tinted in the colour of its map plane, its
/// boundary, edge lines and vertices, and a chip with map id, class and decision. Without a
/// segmentation a plane is outlined by its four vertices, or by the hull of its map plane.
cv::Mat DrawFrame(const FrameScene& scene, int width_px);

/// Marks of the decisions, for the legend.
inline const cv::Scalar kMatchedMark{110, 215, 110}, kNewMark{60, 190, 255},
    kBadMark{80, 80, 245}, kOpenMark{170, 170, 170};

}  // namespace eval
