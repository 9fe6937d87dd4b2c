#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/box.h"
#include "slam/model/detection.h"

namespace slam {

/// Missed-detection compensation: how boxes are followed over frames. Unless a source is named,
/// the defaults balance gaps that are filled against boxes where nothing is any more.
struct BoxTracksConfig {
  bool enabled = true;
  double max_duplicate_iou = 0.8;
  double min_match_iou = 0.2;
  double class_change_iou_penalty = 0.35;
  int min_hits = 3;
  int max_gap_frames = 8;
  int max_coast_frames = 15;  // half a second at 30 Hz
  double min_existence = 0.35;
  double survival = 0.995;           // an object stays in view for 200 frames, about
  double max_detection_rate = 0.85;  // misses come in bursts: they are less telling than chance
  double min_visible_fraction = 0.5;
  double jitter_px = 2.0;
  double jitter_fraction = 0.03;
  double acceleration_px_s2 = 1500.0;
  double min_class_ratio = 2.0;
  double class_memory = 0.97;  // half is forgotten over 23 answers of the detector
};

inline void VisitFields(BoxTracksConfig& c, FieldVisitor& v) {
  v.Flag("enabled", c.enabled,
         "follow boxes over frames; without it detections pass untouched");
  v.Number("max_duplicate_iou", c.max_duplicate_iou, "(0, 1]",
           "two boxes of one class with a higher IoU are one");
  v.Number("min_match_iou", c.min_match_iou, "[0, 1)",
           "IoU of a detected and a predicted box that belong together, at least");
  v.Number("class_change_iou_penalty", c.class_change_iou_penalty, "[0, 1]",
           "subtracted from the IoU of two boxes of different classes");
  v.Integer("min_hits", c.min_hits, "[1, 100]", "detections that confirm a track");
  v.Integer("max_gap_frames", c.max_gap_frames, "[0, 100]",
            "a missed object is filled for this many frames after it was detected, at most");
  v.Integer("max_coast_frames", c.max_coast_frames, "[1, 1000]",
            "a track ends when it is missed more frames than this after it was detected");
  v.Number("min_existence", c.min_existence, "[0, 1]",
           "fill only while the object is in view with a higher probability than this");
  v.Number("survival", c.survival, "(0, 1]",
           "probability that an object stays in view from frame to frame");
  v.Number("max_detection_rate", c.max_detection_rate, "(0, 1)",
           "upper bound on the probability with which an object in view is detected");
  v.Number("min_visible_fraction", c.min_visible_fraction, "[0, 1]",
           "share of a predicted box inside the image for which it is filled");
  v.Number("jitter_px", c.jitter_px, "(0, inf)",
           "standard deviation of a side of a detected box, plus ...");
  v.Number("jitter_fraction", c.jitter_fraction, "[0, 1]", "... this share of the box's size");
  v.Number("acceleration_px_s2", c.acceleration_px_s2, "(0, inf)",
           "standard deviation of the acceleration of a side");
  v.Number("min_class_ratio", c.min_class_ratio, "[1, inf)",
           "evidence for another class over that for the detected one that overrules it");
  v.Number("class_memory", c.class_memory, "(0, 1]",
           "share of the evidence for a class that is kept from one time that the detector is "
           "asked to the next");
}

/// Follows detection boxes over frames and fills the gaps.
///
/// Each side of a box is a constant-velocity Kalman filter; tracks and detections are paired by
/// the Hungarian method on IoU less a penalty for another class; when most boxes moved
/// together, unpaired tracks are moved with them and tried again. A track's existence is a
/// probability that falls with each miss by the track's own detection rate, so that an object
/// that is seen every second frame is filled for longer than one that is always seen and now is
/// gone. A frame in which the detector is not asked (Carry) is no miss: boxes move on and nothing
/// is learnt, except that an object may leave.
///
/// What Update returns:
/// - Every detection given, in the order given, box and score untouched, except duplicates
///   (same class, IoU above `max_duplicate_iou`), of which the one with the larger score stays.
///   The class is the track's when its evidence outvotes a single confused label.
/// - Then, by age of the track, a box for each confirmed track that was missed: `compensated`,
///   predicted, clipped to the image, score times the probability that the object is there. A
///   lone false positive is passed on, not believed, and never filled.
///
/// Deterministic; the order of the detections changes the order of the answer only.
class BoxTracks {
 public:
  /// @param image_px  pixel centres of the image; compensated boxes are clipped to it
  /// @throws std::invalid_argument when a value of the config is outside its domain.
  BoxTracks(const BoxTracksConfig& config, const Box& image_px);

  /// One frame. Timestamps increase; after a gap of over a second all tracks are forgotten.
  /// @throws std::invalid_argument if the timestamp does not increase.
  std::vector<Detection> Update(double timestamp_s, const std::vector<Detection>& detections);

  /// One frame in which the detector is not asked.
  /// @returns by age of the track, a `compensated` box for each object that the detector found
  ///   when it was last asked, and for those that are being filled: predicted, clipped to the
  ///   image. None when tracks are not `enabled`, nor over a second after the object was seen.
  /// @throws std::invalid_argument if the timestamp does not increase.
  std::vector<Detection> Carry(double timestamp_s);

 private:
  /// Position and velocity of one side, pixels and pixels a second, with covariance.
  struct Side {
    double x = 0, v = 0;
    double p_xx = 0, p_xv = 0, p_vv = 0;
  };
  struct ClassEvidence {
    double weight = 0;
    ClassKind kind = ClassKind::kOther;
  };
  struct Track {
    std::array<Side, 4> sides;  ///< min u, min v, max u, max v
    int hits = 0, misses_in_row = 0;
    int asked = 0;             ///< frames in which the detector was asked, since the first hit
    int frames_since_hit = 0;  ///< asked or not
    double seen_s = 0.0;       ///< time of the last hit
    double existence = 1.0;    ///< probability that the object is in view
    double score = 0.0;        ///< the last detection's
    std::map<std::string, ClassEvidence> classes;

    Box box() const;
    const std::string& class_name() const;  ///< with most evidence; by name where equal
  };

  std::vector<std::size_t> Deduplicated(const std::vector<Detection>& detections) const;
  void Advance(double timestamp_s);
  void Predict(double dt_s);
  std::vector<int> Assign(const std::vector<Detection>& detections);
  std::optional<double> ShiftOf(const Box& expected, const Box& seen, int axis) const;
  void MoveWithTheOthers(const std::vector<Detection>& detections,
                         const std::vector<int>& detection_of,
                         const std::vector<std::size_t>& missed);
  std::vector<int> Match(const std::vector<Detection>& detections,
                         const std::vector<std::size_t>& tracks,
                         const std::vector<bool>& taken) const;
  double Affinity(const Track& track, const Detection& detection) const;
  std::vector<std::size_t> Follow(const std::vector<Detection>& detections);
  void Correct(Track& track, const Detection& detection) const;
  void Miss(Track& track) const;
  void Start(const Detection& detection);
  Detection Labelled(const Track& track, Detection detection) const;
  bool IsBelieved(const Track& track) const;
  std::optional<Detection> Predicted(const Track& track) const;
  void AddUnseen(std::vector<Detection>& answer) const;
  double DetectionRate(const Track& track) const;

  BoxTracksConfig config_;
  Box image_px_;
  std::vector<Track> tracks_;  ///< oldest first
  bool started_ = false;
  double last_s_ = 0.0;
};

}  // namespace slam
