#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/camera/camera.h"
#include "sim/scene/scene.h"
#include "sim/truth/frame_truth.h"

namespace sim {

enum class DetectorKind { kNone, kPerfect, kNoisy, kPoor };

/// One reported box: pixel centres at integers, inside the image.
struct Detection {
  std::string class_name;
  double score = 1;  ///< [0, 1]
  PixelBox box;
};

/// What there is to detect in a frame: an object, or objects that are detected as one.
struct DetectionTarget {
  std::uint64_t key = 0;  ///< id of the first object that is not `other`
  std::string class_name;
  int pixels = 0, unoccluded = 0;  ///< of all its objects together
  PixelBox box;                    ///< round the visible part
  double VisibleFraction() const;
};

/// How a real detector departs from the truth. Sizes are pixels at 640 x 480 (scaled with the
/// image); the constants imitate a small one-stage network on a desk. [choice]
/// Whatever happens lasts for runs of frames: misses, wrong classes and doubles while a slow
/// standard normal of their own (slow_noise.h) is beyond a threshold, so that the share of
/// frames is exactly the one stated; a phantom stays for a window.
struct DetectorModel {
  double min_pixels = 60;   ///< visible area below which nothing is reported
  double base_miss = 0.02;  ///< missed whatever its size
  double small_miss = 0.8, small_size_px = 25;  ///< + small_miss exp(-sqrt(area)/small_size)
  double hidden_miss = 0.6;                     ///< + hidden_miss (1 - visible fraction)^2
  int miss_run_frames = 8;                      ///< misses come in runs of about this length
  double jitter_ratio = 0.02, jitter_px = 0.5;  ///< sd of each side: ratio x box side + px
  double slow_jitter_share = 0.5;  ///< part of the jitter's variance that drifts over runs
  double confused = 0.02;          ///< share of detections with a wrong class, in runs
  double duplicate = 0.015;        ///< share of detections reported twice, in runs ...
  int duplicate_run_frames = 4;    ///< ... of about this length
  double phantom = 0.02;           ///< chance a window of 4 frames holds a box where nothing is
};

/// A detector on its limits: half-hidden and small things are mostly missed, boxes are loose.
/// Twice to six times the errors of the default. [choice]
DetectorModel PoorDetector();

/// The model of a preset; the default's for `none` and `perfect`, which do not use it.
DetectorModel ModelOf(DetectorKind kind);

/// Replays a detector from truth: one box per regular or unstructured object (objects of one
/// detection_group are one, those of role `other` with them) round its visible part. Structure,
/// and `other` by itself, is never reported.
/// `perfect` gives exactly those boxes, score 1; `noisy` and `poor` follow the model. Frame f
/// depends on (seed, f, truth of f) alone.
class Detector {
 public:
  Detector(const Scene& scene, const Camera& camera, DetectorKind kind, std::uint64_t seed)
      : Detector(scene, camera, kind, seed, ModelOf(kind)) {}
  Detector(const Scene& scene, const Camera& camera, DetectorKind kind, std::uint64_t seed,
           const DetectorModel& model);
  /// Highest score first, then the order of objects.
  std::vector<Detection> Detect(int frame, const FrameTruth& truth) const;

  /// What `perfect` would box, in the order of objects.
  std::vector<DetectionTarget> VisibleTargets(const FrameTruth& truth) const;

 private:
  using Target = DetectionTarget;
  bool Missed(const Target& target, int frame) const;
  Detection Report(const Target& target, int frame) const;
  PixelBox Jittered(const PixelBox& box, std::uint64_t key, int frame, double gain) const;
  void AddPhantom(int frame, std::vector<Detection>& detections) const;

  Scene scene_;
  Camera camera_;
  DetectorKind kind_;
  std::uint64_t seed_;
  DetectorModel model_;
  double scale_;  ///< pixels of this image per pixel at 640 x 480
};

/// One line of detections.jsonl, without the line end.
std::string DetectionsJson(double timestamp_s, const std::vector<Detection>& detections);

}  // namespace sim
