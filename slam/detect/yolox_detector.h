#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "slam/detect/class_table.h"
#include "slam/detect/detections.h"
#include "slam/detect/yolox_output.h"
#include "slam/geometry/camera.h"

namespace slam {

/// Objects found by a YOLOX network in ONNX form, run by OpenCV on the processor: letterbox
/// (letterbox.h), network, boxes and suppression (yolox_output.h).
///
/// The network takes 1 x 3 x height x width, BGR, 0 to 255 as they are, sides multiples of 32,
/// and gives 1 x cells x (5 + classes), as YOLOX's own export does.
class YoloxDetector : public Detector {
 public:
  /// Loads the network and runs it once on a grey image.
  /// @throws InputError naming the file when it is missing or no ONNX model, when its input or
  ///   output is of another shape (with what was expected and found), when it cannot be run, or
  ///   when its answer is refused by DecodeYolox.
  YoloxDetector(const std::filesystem::path& model, const Camera& camera,
                const ClassTable& table, const YoloxConfig& config);
  ~YoloxDetector() override;

  /// Boxes clipped to the image, highest score first; what lies outside it is left out, and so
  /// are all but the 100 best.
  /// @throws InputError naming the file, see DecodeYolox.
  std::vector<Detection> Detect(double timestamp_s, const cv::Mat3b& bgr) override;

 private:
  class Network;
  /// Puts the file's name before the text of an InputError of `work`.
  void NamingTheFile(const std::function<void()>& work) const;

  std::string file_;
  std::unique_ptr<Network> network_;
  Camera camera_;
  ClassTable table_;
};

}  // namespace slam
