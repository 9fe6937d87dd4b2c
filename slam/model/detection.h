#pragma once

#include <string>

#include "slam/geometry/box.h"

namespace slam {

/// What an object of a class is good for. Which class is which: slam/detect/class_table.h.
enum class ClassKind {
  kRegular,       ///< box-shaped: its faces are rectangles (book, keyboard, tv, laptop ...)
  kUnstructured,  ///< planes found on it are noise (person, teddy bear, plant ...)
  kOther          ///< neither is known
};

/// One detected object in one frame. The box bounds the *visible part of the object*, in pixels
/// of the recorded (distorted) image.
struct Detection {
  std::string class_name;
  ClassKind kind = ClassKind::kOther;
  double score = 0.0;  ///< [0, 1]
  Box box_px;
  bool compensated = false;  ///< not detected in this frame: predicted from its track
};

}  // namespace slam
