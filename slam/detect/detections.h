#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "io/json_field.h"
#include "slam/base/field_visitor.h"
#include "slam/detect/class_table.h"
#include "slam/detect/yolox_output.h"
#include "slam/geometry/camera.h"
#include "slam/model/detection.h"

namespace slam {

/// How often the detector is asked.
struct DetectionConfig {
  int every = 1;  ///< frames from one question to the next
};

inline void VisitFields(DetectionConfig& c, FieldVisitor& v) {
  v.Integer("every", c.every, "[1, 1000]",
            "the detector is asked in every Nth frame; box_tracks carry its boxes over the "
            "others");
}

/// Finds objects in a colour image. Asked frame by frame, from one thread at a time.
class Detector {
 public:
  virtual ~Detector() = default;
  /// Boxes in pixels of the recorded image, clipped to it; in the detector's order.
  virtual std::vector<Detection> Detect(double timestamp_s, const cv::Mat3b& bgr) = 0;
  /// What does not go together between what it has and the frames at these times, a line a
  /// kind.
  /// @throws InputError when nothing goes together
  virtual std::vector<std::string> WarningsFor(const std::vector<double>&) const { return {}; }
};

/// Sees nothing: no plane gets a class.
class NoDetector : public Detector {
 public:
  std::vector<Detection> Detect(double, const cv::Mat3b&) override { return {}; }
};

/// One line of a detections.jsonl (formats.md).
struct DetectionRecord {
  double timestamp_s = 0.0;
  std::vector<Detection> detections;  ///< clipped to the image, without those outside
};

/// @throws InputError for a missing key, a score outside [0, 1], a box whose max is below its
/// min
DetectionRecord ReadDetections(const io::JsonField& record, const Camera& camera,
                               const ClassTable& classes);

/// Replays a detections.jsonl (formats.md). A frame without a record has no detections.
class ReplayDetector : public Detector {
 public:
  /// Records are found by timestamp within this time, so that a file may print fewer digits.
  static constexpr double kMaxTimeDifference_s = 5e-4;

  /// @throws InputError with file:line for text that is not JSON, see also ReadDetections, and
  ///   for a timestamp that does not increase.
  ReplayDetector(const std::filesystem::path& file, const Camera& camera,
                 const ClassTable& classes);
  std::vector<Detection> Detect(double timestamp_s, const cv::Mat3b&) override;

  std::vector<std::string> WarningsFor(const std::vector<double>& frames_s) const override;

 private:
  using Records = std::map<double, std::vector<Detection>>;
  /// The record of a frame, or the end.
  Records::const_iterator Find(double timestamp_s) const;

  std::filesystem::path file_;
  Records records_;
};

/// FILE of the choice "yolox:FILE"; empty for another.
std::string ModelFile(const std::string& choice);

/// @throws InputError when `choice` is none that MakeDetector knows
void RequireDetectorChoice(const std::string& choice);

/// `choice` is "replay" (SEQUENCE/detections.jsonl), "yolox:FILE" (yolox_detector.h) or "none".
/// @throws InputError for another choice, or when the file to replay or the model is absent or
///   bad.
std::unique_ptr<Detector> MakeDetector(const std::string& choice,
                                       const std::filesystem::path& sequence,
                                       const Camera& camera, const ClassTable& classes,
                                       const YoloxConfig& yolox = {});

}  // namespace slam
