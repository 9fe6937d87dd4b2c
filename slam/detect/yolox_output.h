#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/box.h"

namespace slam {

/// COCO's 80 classes in the order of a network's columns, named as the class table names them.
std::vector<std::string> CocoNames();

/// A YOLOX network: how its output is read and which boxes are believed.
struct YoloxConfig {
  double min_score = 0.3;     // YOLOX's published ONNX demo
  double max_nms_iou = 0.45;  // the same
  int input_width = 0, input_height = 0;
  bool decoded = false;
  std::vector<std::string> classes = CocoNames();
};

inline void VisitFields(YoloxConfig& c, FieldVisitor& v) {
  v.Number("min_score", c.min_score, "[0, 1]",
           "boxes with a lower objectness times class probability are left out");
  v.Number("max_nms_iou", c.max_nms_iou, "(0, 1]",
           "two boxes of one class with a higher IoU are one object");
  v.Integer("input_width", c.input_width, "[0, 4096]",
            "width of the network's input, px, where the model does not state it; 0: it must");
  v.Integer("input_height", c.input_height, "[0, 4096]",
            "height of the network's input, px; both are multiples of 32");
  v.Flag("decoded", c.decoded, "the model was exported with --decode_in_inference");
  v.Texts("classes", c.classes, "class names in the order of the model's columns");
}

/// A box in the network's input, whose first pixel spans [0, 1).
struct YoloxBox {
  Box box;
  double score = 0.0;
  int class_index = 0;
};

/// Cells of the grids of strides 8, 16 and 32: rows of the output for an input of this size.
int YoloxCells(cv::Size input);

/// Reads the network's output: a row a cell, grid after grid, each row by row of its image:
///
///   x, y, w, h, objectness, class probabilities
///   centre = ((x, y) + cell) stride,   size = exp(w, h) stride,
///   score  = objectness * largest class probability
///
/// Cells with a score of min_score or more, in the order of the rows. Equal probabilities: the
/// first class.
///
/// @param output  YoloxCells(input) x (5 + classes)
/// @throws std::invalid_argument for another size; InputError for a box that is no number, an
///   objectness or probability outside [0, 1] (a model that was exported without its sigmoids)
/// Source: YOLOX (Ge et al. 2021), demo_postprocess of its published ONNX demo.
std::vector<YoloxBox> DecodeYolox(const cv::Mat1f& output, cv::Size input,
                                  const YoloxConfig& config);

/// Whether the boxes of an output are decoded, as its values say: a network's own centres are
/// offsets of a few cells from the cells of their rows; decoded ones lie near these cells, all
/// over the image. Needs no box to be right.
bool LooksDecoded(const cv::Mat1f& output, cv::Size input);

/// Non-maximum suppression within each class: of two boxes that overlap by more than
/// max_nms_iou the one with the lower score goes (the later one if equal), unless what
/// outdoes it has gone itself. Highest score first.
std::vector<YoloxBox> SuppressOverlaps(std::vector<YoloxBox> boxes, double max_nms_iou);

}  // namespace slam
