#include "slam/detect/class_table.h"

#include <algorithm>

namespace slam {

ClassKind ClassTable::KindOf(const std::string& class_name) const {
  const auto in = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), class_name) != list.end();
  };
  if (in(regular)) return ClassKind::kRegular;
  if (in(unstructured)) return ClassKind::kUnstructured;
  return ClassKind::kOther;
}

ClassTable CocoClassTable() {
  return {
      .regular = {"box",          "book",        "keyboard",   "tv",           "tvmonitor",
                  "monitor",      "laptop",      "cell phone", "remote",       "mouse",
                  "microwave",    "oven",        "toaster",    "refrigerator", "suitcase",
                  "dining table", "diningtable", "bed",        "bench",        "chair",
                  "clock",        "stop sign"},
      .unstructured = {"person",   "bird",       "cat",          "dog",         "horse",
                       "sheep",    "cow",        "elephant",     "bear",        "zebra",
                       "giraffe",  "teddy bear", "potted plant", "pottedplant", "backpack",
                       "umbrella", "handbag",    "tie",          "couch",       "sofa",
                       "banana",   "broccoli",   "carrot",       "sandwich",    "hot dog",
                       "pizza",    "cake",       "scissors",     "hair drier",  "toothbrush",
                       "fork",     "knife",      "spoon"},
      .other = {"bottle",      "wine glass", "cup",           "bowl",         "vase",
                "sports ball", "frisbee",    "orange",        "apple",        "donut",
                "sink",        "toilet",     "bicycle",       "car",          "motorcycle",
                "motorbike",   "airplane",   "aeroplane",     "bus",          "train",
                "truck",       "boat",       "traffic light", "fire hydrant", "parking meter",
                "skis",        "snowboard",  "kite",          "baseball bat", "baseball glove",
                "skateboard",  "surfboard",  "tennis racket"}};
}

}  // namespace slam
