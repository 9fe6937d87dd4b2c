#include "slam/detect/yolox_output.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/input_error.h"
#include "slam/base/require.h"

namespace slam {
namespace {

constexpr std::array<int, 3> kStrides = {8, 16, 32};  // pixels of the input: YOLOX
constexpr int kBoxColumns = 5;                        // x, y, w, h, objectness

/// A cell of a grid, in pixels of the input.
struct Cell {
  int column = 0, row = 0, stride = 1;
};

/// The value as a probability.
/// @throws InputError when it is none
double Probability(float x) {
  const double p = static_cast<double>(x);
  if (!(p >= 0.0 && p <= 1.0)) {
    throw io::InputError(
        "the network's output has an objectness or class probability outside [0, 1]; "
        "expected a YOLOX model exported with its sigmoids");
  }
  return p;
}

/// The box that a row of the output gives, in pixels of the input.
Box BoxOfCell(const float* row, const Cell& cell, bool decoded) {
  Eigen::Vector2d center(static_cast<double>(row[0]), static_cast<double>(row[1]));
  Eigen::Vector2d size(static_cast<double>(row[2]), static_cast<double>(row[3]));
  if (!decoded) {
    center = (center + Eigen::Vector2d(cell.column, cell.row)) * cell.stride;
    size = size.array().exp() * cell.stride;
  }
  Box box{center - 0.5 * size, center + 0.5 * size};
  if (!box.min.allFinite() || !box.max.allFinite() || box.empty()) {
    throw io::InputError("the network's output has a box that is no finite rectangle");
  }
  return box;
}

/// Adds the box of a cell when its score is high enough.
void DecodeCell(const float* row, const Cell& cell, const YoloxConfig& config,
                std::vector<YoloxBox>& boxes) {
  const float* first = row + kBoxColumns;
  const double objectness = Probability(row[4]);
  int best = 0;
  for (int k = 0; k < static_cast<int>(config.classes.size()); ++k) {
    if (Probability(first[k]) > static_cast<double>(first[best])) best = k;
  }
  const double score = objectness * static_cast<double>(first[best]);
  if (!(score >= config.min_score)) return;
  boxes.push_back({BoxOfCell(row, cell, config.decoded), score, best});
}

}  // namespace

std::vector<std::string> CocoNames() {
  return {"person",        "bicycle",      "car",
          "motorcycle",    "airplane",     "bus",
          "train",         "truck",        "boat",
          "traffic light", "fire hydrant", "stop sign",
          "parking meter", "bench",        "bird",
          "cat",           "dog",          "horse",
          "sheep",         "cow",          "elephant",
          "bear",          "zebra",        "giraffe",
          "backpack",      "umbrella",     "handbag",
          "tie",           "suitcase",     "frisbee",
          "skis",          "snowboard",    "sports ball",
          "kite",          "baseball bat", "baseball glove",
          "skateboard",    "surfboard",    "tennis racket",
          "bottle",        "wine glass",   "cup",
          "fork",          "knife",        "spoon",
          "bowl",          "banana",       "apple",
          "sandwich",      "orange",       "broccoli",
          "carrot",        "hot dog",      "pizza",
          "donut",         "cake",         "chair",
          "couch",         "potted plant", "bed",
          "dining table",  "toilet",       "tv",
          "laptop",        "mouse",        "remote",
          "keyboard",      "cell phone",   "microwave",
          "oven",          "toaster",      "sink",
          "refrigerator",  "book",         "clock",
          "vase",          "scissors",     "teddy bear",
          "hair drier",    "toothbrush"};
}

int YoloxCells(cv::Size input) {
  int cells = 0;
  for (const int stride : kStrides) cells += (input.width / stride) * (input.height / stride);
  return cells;
}

std::vector<YoloxBox> DecodeYolox(const cv::Mat1f& output, cv::Size input,
                                  const YoloxConfig& config) {
  Require(!config.classes.empty(), "DecodeYolox: no classes");
  Require(output.rows == YoloxCells(input) &&
              output.cols == kBoxColumns + static_cast<int>(config.classes.size()),
          "DecodeYolox: the output has another size");
  std::vector<YoloxBox> boxes;
  int i = 0;
  for (const int stride : kStrides) {
    for (int row = 0; row < input.height / stride; ++row) {
      for (int column = 0; column < input.width / stride; ++column, ++i) {
        DecodeCell(output[i], {column, row, stride}, config, boxes);
      }
    }
  }
  return boxes;
}

bool LooksDecoded(const cv::Mat1f& output, cv::Size input) {
  Require(output.rows == YoloxCells(input) && output.cols > kBoxColumns,
          "LooksDecoded: the output has another size");
  double from_cells = 0.0, from_origin = 0.0;  // sums of distances of centres, pixels
  int i = 0;
  for (const int stride : kStrides) {
    for (int row = 0; row < input.height / stride; ++row) {
      for (int column = 0; column < input.width / stride; ++column, ++i) {
        const Eigen::Vector2d center(static_cast<double>(output(i, 0)),
                                     static_cast<double>(output(i, 1)));
        from_cells += (center - stride * Eigen::Vector2d(column, row)).norm();
        from_origin += center.norm();
      }
    }
  }
  return from_cells < from_origin;
}

std::vector<YoloxBox> SuppressOverlaps(std::vector<YoloxBox> boxes, double max_nms_iou) {
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const YoloxBox& a, const YoloxBox& b) { return a.score > b.score; });
  std::vector<YoloxBox> kept;
  for (const YoloxBox& box : boxes) {
    const bool outdone = std::any_of(kept.begin(), kept.end(), [&](const YoloxBox& better) {
      return better.class_index == box.class_index && Iou(better.box, box.box) > max_nms_iou;
    });
    if (!outdone) kept.push_back(box);
  }
  return kept;
}

}  // namespace slam
