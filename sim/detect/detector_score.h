#pragma once

#include <array>
#include <map>
#include <string>

#include "sim/detect/detector.h"

namespace sim {

/// What became of the things to detect, all or those of one size.
struct DetectorFigures {
  long targets = 0;      ///< boxes there were, all frames
  long found = 0;        ///< those with a detection of IoU 0.5 or more
  long right_class = 0;  ///< those found with the right class
  long runs = 0;         ///< times that misses began while the thing was in view
  double iou_sum = 0;    ///< over those found

  double Recall() const;
  double MeanIou() const;
  double RightShare() const;
  /// Mean length of a run of misses, frames; 0 when nothing was missed.
  double MeanMissRun() const;
  /// What it would be if each frame were drawn alone.
  double IndependentMissRun() const;
};

/// Compares detections with what there is, frame after frame. A detection belongs to the target
/// that it overlaps most; IoU below 0.5 makes it a phantom, a second one of a target a double.
class DetectorScore {
 public:
  static constexpr double kMinIou = 0.5;
  /// Visible pixels at 640 x 480 below which a target is small, or medium: COCO's limits.
  static constexpr double kSmall = 32.0 * 32.0, kMedium = 96.0 * 96.0;

  /// @param scale  pixels per pixel of a 640 x 480 image of the same view, along a side
  DetectorScore() = default;
  explicit DetectorScore(double scale) : scale_(scale) {}

  /// Frames of one recording in order; begin another with NextRecording.
  void Add(const std::vector<DetectionTarget>& targets,
           const std::vector<Detection>& detections);
  void NextRecording() { missing_.clear(); }

  const DetectorFigures& all() const { return all_; }
  const std::array<DetectorFigures, 3>& by_size() const { return by_size_; }
  long boxes() const { return boxes_; }
  long doubles() const { return doubles_; }
  long phantoms() const { return phantoms_; }
  /// Found targets over all boxes.
  double Precision() const;

 private:
  double scale_ = 1.0;
  DetectorFigures all_;
  std::array<DetectorFigures, 3> by_size_;  ///< small, medium, large
  long boxes_ = 0, doubles_ = 0, phantoms_ = 0;
  std::map<std::uint64_t, bool> missing_;  ///< in the frame before; only what was in view
};

/// Intersection over union of two boxes as areas.
double BoxIou(const PixelBox& a, const PixelBox& b);

/// The figures as lines for people: all, small, medium, large.
std::string ScoreTable(const DetectorScore& score);

}  // namespace sim
