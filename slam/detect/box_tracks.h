#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/box.h"
#include "slam/model/detection.h"

namespace slam {

/// Missed-detection compensation: how boxes are followed over frames.
struct BoxTracksConfig {
  bool enabled = true;             ///< off: detections pass through untouched
  double max_duplicate_iou = 0.8;  ///< two boxes of a class above it are one; domain (0, 1]
  double min_match_iou = 0.2;      ///< box and predicted box; domain [0, 1)
  double class_change_iou_penalty =
      0.35;                            ///< less IoU for a pair of two classes; domain [0, 1]
  int min_hits = 3;                    ///< detections that confirm a track; domain [1, 100]
  int max_gap_frames = 8;              ///< misses in a row that are filled; domain [0, 100]
  int max_coast_frames = 15;           ///< misses in a row that end a track; domain [1, 1000]
  double min_existence = 0.35;         ///< fill while the object is this likely there; [0, 1]
  double survival = 0.995;             ///< an object stays in view, a frame; domain (0, 1]
  double max_detection_rate = 0.85;    ///< misses come in bursts: never trust more; (0, 1)
  double min_visible_fraction = 0.5;   ///< of a predicted box inside the image; domain [0, 1]
  double jitter_px = 2.0;              ///< standard deviation of a box side; domain (0, inf)
  double jitter_fraction = 0.03;       ///< the same, as part of the box's size; domain [0, 1]
  double acceleration_px_s2 = 1500.0;  ///< standard deviation of a side's; domain (0, inf)
  double min_class_ratio =
      2.0;                     ///< evidence for a class over another that outvotes it; [1, inf)
  double class_memory = 0.97;  ///< evidence kept from frame to frame; domain (0, 1]
};

inline void VisitFields(BoxTracksConfig& c, FieldVisitor& v) {
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

/// Where a box of the previous frame lies now by the camera's motion alone (a homography, a
/// warp by depth). Optional; without it the common shift of the boxes themselves is used.
using BoxMotion = std::function<Box(const Box& previous_px)>;

/// Follows detection boxes over frames and fills the gaps.
///
/// Each side of a box is a constant-velocity Kalman filter; tracks and detections are paired by
/// the Hungarian method on IoU less a penalty for another class; when most boxes moved
/// together, unpaired tracks are moved with them and tried again. A track's existence is a
/// probability that falls with each miss by the track's own detection rate, so that an object
/// that is seen every second frame is filled for longer than one that is always seen and now is
/// gone.
///
/// What Update returns:
/// - Every detection given, in the order given, box and score untouched, except duplicates
/// (same
///   class, IoU above `max_duplicate_iou`), of which the one with the larger score stays.
///   `track` is the id of its track once that is confirmed, -1 before: a lone false positive is
///   passed on, not believed, and never filled.
///   The class is the track's when its evidence outvotes a single confused label.
/// - Then, by track id, a box for each confirmed track that was missed: `compensated`,
/// predicted,
///   clipped to the image, score times the probability that the object is there.
///
/// Deterministic; the order of the detections changes the order of the answer only.
class BoxTracks {
 public:
  /// @param image_px  pixel centres of the image; compensated boxes are clipped to it
  /// @throws std::invalid_argument when a value of the config is outside its domain.
  BoxTracks(const BoxTracksConfig& config, const Box& image_px);

  /// One frame. Timestamps increase; after a gap of over a second all tracks are forgotten.
  /// @throws std::invalid_argument if the timestamp does not increase.
  std::vector<Detection> Update(double timestamp_s, const std::vector<Detection>& detections,
                                const BoxMotion& motion = {});

  int tracks() const { return static_cast<int>(tracks_.size()); }

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
    int id = 0;
    std::array<Side, 4> sides;  ///< min u, min v, max u, max v
    int hits = 0, misses_in_row = 0, frames = 0;
    double existence = 1.0;  ///< probability that the object is in view
    double score = 0.0;      ///< of the last detection
    std::map<std::string, ClassEvidence> classes;

    Box box() const;
    const std::string& class_name() const;  ///< of most evidence; by name where equal
  };

  std::vector<std::size_t> Deduplicated(const std::vector<Detection>& detections) const;
  void Predict(double dt_s, const BoxMotion& motion);
  std::vector<int> Assign(const std::vector<Detection>& detections);
  std::vector<int> Match(const std::vector<Detection>& detections,
                         const std::vector<std::size_t>& tracks,
                         const std::vector<bool>& taken) const;
  double Affinity(const Track& track, const Detection& detection) const;
  void Correct(Track& track, const Detection& detection) const;
  void Miss(Track& track) const;
  void Start(const Detection& detection);
  Detection Labelled(const Track& track, Detection detection) const;
  bool Fill(const Track& track, Detection& filled) const;
  double DetectionRate(const Track& track) const;

  BoxTracksConfig config_;
  Box image_px_;
  std::vector<Track> tracks_;  ///< by id
  int next_id_ = 0;
  bool started_ = false;
  double last_s_ = 0.0;
};

}  // namespace slam
