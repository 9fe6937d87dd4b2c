#include "slam/detect/yolox_detector.h"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <string>
#include <utility>

#include "io/input_error.h"
#include "io/read_file.h"
#include "slam/detect/letterbox.h"
#include "slam/detect/onnx_inputs.h"

namespace slam {
namespace {

using cv::utils::logging::getLogLevel;
using cv::utils::logging::setLogLevel;

constexpr int kCoarsestStride = 32;  // pixels of the input: YOLOX
// COCO scores as many detections an image. A network that finds something everywhere would
// otherwise keep box tracking busy for half a minute a frame.
constexpr std::size_t kMaxBoxes = 100;
constexpr int kMaxInputPixels = 1 << 24;  // far beyond any network that is used

/// OpenCV tells of a bad model on the standard error as well as by an exception.
class QuietOpenCv {
 public:
  QuietOpenCv() : before_(getLogLevel()) { setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }
  ~QuietOpenCv() { setLogLevel(before_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

std::string ShapeText(const std::vector<int>& shape) {
  std::string text;
  for (const int side : shape) text += (text.empty() ? "" : " x ") + std::to_string(side);
  return text.empty() ? "no shape" : text;
}

/// First line of what OpenCV said.
std::string Reason(const cv::Exception& error) {
  return error.err.substr(0, error.err.find('\n'));
}

/// The size that the model states, or the configuration for it.
cv::Size InputSize(const std::string& bytes, const YoloxConfig& config) {
  const std::vector<OnnxInput> inputs = ReadOnnxInputs(bytes);
  if (inputs.size() != 1) {
    throw io::InputError("the model has " + std::to_string(inputs.size()) +
                         " inputs; expected one image");
  }
  // What the model leaves open, the configuration says.
  std::vector<int> shape = inputs.front().shape;
  if (shape.size() == 4) {
    if (shape[0] == 0) shape[0] = 1;
    if (shape[2] == 0) shape[2] = config.input_height;
    if (shape[3] == 0) shape[3] = config.input_width;
    if (shape[2] == 0 || shape[3] == 0) {
      throw io::InputError(
          "the model does not state the size of its input; set yolox: input_width and "
          "input_height in --config");
    }
  }
  // Whole cells of the coarsest grid, and no more pixels than memory can be expected for.
  const auto fits = [](int side) { return side > 0 && side % kCoarsestStride == 0; };
  if (shape.size() != 4 || shape[0] != 1 || shape[1] != 3 || !fits(shape[2]) ||
      !fits(shape[3]) || shape[2] > kMaxInputPixels / shape[3]) {
    throw io::InputError(
        "the model's input is " + ShapeText(shape) +
        "; expected 1 x 3 x height x width with sides that are multiples of 32");
  }
  return {shape[3], shape[2]};
}

cv::dnn::Net Load(const std::string& bytes) {
  try {
    cv::dnn::Net net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    return net;
  } catch (const cv::Exception& error) {
    throw io::InputError("OpenCV cannot read it as an ONNX model (" + Reason(error) +
                         "); export one with YOLOX's tools/export_onnx.py");
  }
}

}  // namespace

/// The model with its input size: an image in, boxes out. Its errors name no file.
class YoloxDetector::Network {
 public:
  Network(const std::string& bytes, const Camera& camera, YoloxConfig config)
      : config_(std::move(config)),
        letterbox_({camera.width, camera.height}, InputSize(bytes, config_)),
        net_(Load(bytes)) {
    const cv::Mat3b grey(camera.height, camera.width, cv::Vec3b::all(Letterbox::kPadding));
    const cv::Mat1f output = Answer(grey);
    if (LooksDecoded(output, letterbox_.input()) != config_.decoded) {
      throw io::InputError(
          config_.decoded
              ? "the model's boxes are not decoded; set yolox: decoded: false in --config"
              : "the model computes its boxes itself (--decode_in_inference); set yolox: "
                "decoded: true in --config");
    }
    DecodeYolox(output, letterbox_.input(), config_);
  }

  std::vector<YoloxBox> Find(const cv::Mat3b& bgr) {
    std::vector<YoloxBox> boxes = SuppressOverlaps(
        DecodeYolox(Answer(bgr), letterbox_.input(), config_), config_.max_nms_iou);
    if (boxes.size() > kMaxBoxes) boxes.resize(kMaxBoxes);
    return boxes;
  }

  const Letterbox& letterbox() const { return letterbox_; }
  const std::string& ClassName(int index) const {
    return config_.classes[static_cast<std::size_t>(index)];
  }

 private:
  /// The network's output, a row a cell; refused if it is of another shape.
  cv::Mat1f Answer(const cv::Mat3b& bgr) {
    const cv::Mat output = Run(letterbox_.Apply(bgr));
    CheckOutput(output);
    return output.reshape(1, output.size[1]);
  }

  cv::Mat Run(const cv::Mat3b& input) {
    try {
      net_.setInput(cv::dnn::blobFromImage(input));
      return net_.forward();
    } catch (const cv::Exception& error) {
      throw io::InputError("OpenCV cannot run the model on an input of " +
                           std::to_string(input.cols) + " x " + std::to_string(input.rows) +
                           " (" + Reason(error) + ")");
    }
  }

  void CheckOutput(const cv::Mat& output) const {
    const std::vector<int> expected = {1, YoloxCells(letterbox_.input()),
                                       5 + static_cast<int>(config_.classes.size())};
    const std::vector<int> found(output.size.p, output.size.p + output.dims);
    if (found == expected && output.type() == CV_32F && output.isContinuous()) return;
    throw io::InputError(
        "the model's output is " + ShapeText(found) + "; expected " + ShapeText(expected) +
        " (1, cells of strides 8, 16 and 32, 5 + " + std::to_string(config_.classes.size()) +
        " classes); another list of classes is set by yolox: classes in --config");
  }

  YoloxConfig config_;
  Letterbox letterbox_;
  cv::dnn::Net net_;
};

YoloxDetector::YoloxDetector(const std::filesystem::path& model, const Camera& camera,
                             const ClassTable& table, const YoloxConfig& config)
    : file_(model.string()), camera_(camera), table_(table) {
  if (config.classes.empty()) {
    throw io::InputError(
        "yolox: classes in --config is empty; expected the names of the model's columns");
  }
  const std::string bytes =
      io::ReadFile(model, "expected a YOLOX model: --detector yolox:FILE.onnx");
  const QuietOpenCv quiet;
  NamingTheFile([&] { network_ = std::make_unique<Network>(bytes, camera, config); });
}

YoloxDetector::~YoloxDetector() = default;

void YoloxDetector::NamingTheFile(const std::function<void()>& work) const {
  try {
    work();
  } catch (const io::InputError& error) {
    throw io::InputError(file_, error.what());
  }
}

std::vector<Detection> YoloxDetector::Detect(double, const cv::Mat3b& bgr) {
  std::vector<YoloxBox> boxes;
  NamingTheFile([&] { boxes = network_->Find(bgr); });
  std::vector<Detection> detections;
  for (const YoloxBox& found : boxes) {
    Detection d;
    d.box_px = Intersection({network_->letterbox().ToImage(found.box.min),
                             network_->letterbox().ToImage(found.box.max)},
                            camera_.ImageBox());
    if (!(d.box_px.area() > 0)) continue;
    d.class_name = network_->ClassName(found.class_index);
    d.kind = table_.KindOf(d.class_name);
    d.score = found.score;
    detections.push_back(std::move(d));
  }
  return detections;
}

}  // namespace slam
