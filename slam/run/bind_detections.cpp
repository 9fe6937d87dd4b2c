#include "slam/run/config_fields.h"

namespace slam {
namespace {

void VisitClasses(ClassTable& c, FieldVisitor& v) {
  v.Texts("regular", c.regular, "box-shaped: their faces are rectangles");
  v.Texts("unstructured", c.unstructured, "planes found on them are noise");
  v.Texts("other", c.other, "neither; a class in no list is this as well");
}

void VisitYolox(YoloxConfig& c, FieldVisitor& v) {
  v.Number("min_score", c.min_score, "[0, 1]", "objectness times class probability");
  v.Number("max_nms_iou", c.max_nms_iou, "(0, 1]", "two boxes of a class above it are one");
  v.Integer("input_width", c.input_width, "[0, 4096]",
            "where the model does not state its input's; 0: it must");
  v.Integer("input_height", c.input_height, "[0, 4096]", "the same; multiples of 32");
  v.Flag("decoded", c.decoded, "the model was exported with --decode_in_inference");
  v.Texts("classes", c.classes, "in the order of the model's columns");
}

void VisitBoxTracks(BoxTracksConfig& c, FieldVisitor& v) {
  v.Flag("enabled", c.enabled, "off: detections pass through untouched");
  v.Number("max_duplicate_iou", c.max_duplicate_iou, "(0, 1]",
           "two boxes of a class above it are one");
  v.Number("min_match_iou", c.min_match_iou, "[0, 1)", "box and predicted box");
  v.Number("class_change_iou_penalty", c.class_change_iou_penalty, "[0, 1]",
           "less IoU for two classes");
  v.Integer("min_hits", c.min_hits, "[1, 100]", "detections that confirm a track");
  v.Integer("max_gap_frames", c.max_gap_frames, "[0, 100]", "misses in a row that are filled");
  v.Integer("max_coast_frames", c.max_coast_frames, "[1, 1000]",
            "misses in a row that end a track");
  v.Number("min_existence", c.min_existence, "[0, 1]",
           "fill while the object is this likely there");
  v.Number("survival", c.survival, "(0, 1]", "probability to stay in view, a frame");
  v.Number("max_detection_rate", c.max_detection_rate, "(0, 1)", "never trust a detector more");
  v.Number("min_visible_fraction", c.min_visible_fraction, "[0, 1]",
           "of a predicted box in the image");
  v.Number("jitter_px", c.jitter_px, "(0, inf)", "standard deviation of a box side");
  v.Number("jitter_fraction", c.jitter_fraction, "[0, 1]",
           "the same, as part of the box's size");
  v.Number("acceleration_px_s2", c.acceleration_px_s2, "(0, inf)",
           "standard deviation of a side's");
  v.Number("min_class_ratio", c.min_class_ratio, "[1, inf)",
           "evidence that outvotes another class");
  v.Number("class_memory", c.class_memory, "(0, 1]", "evidence kept from frame to frame");
}

}  // namespace

void VisitDetections(Config& c, FieldVisitor& v) {
  v.Section("classes", "what objects of a class are good for",
            [&] { VisitClasses(c.classes, v); });
  v.Section("yolox", "--detector yolox:FILE", [&] { VisitYolox(c.yolox, v); });
  v.Section("box_tracks", "missed-detection compensation",
            [&] { VisitBoxTracks(c.box_tracks, v); });
}

}  // namespace slam
