#include "slam/detect/box_tracks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "slam/base/median.h"
#include "slam/base/require.h"
#include "slam/detect/box_assignment.h"

namespace slam {
namespace {

constexpr double kMaxPause_s = 1.0;  // after it the boxes say nothing of where objects are
// Standard deviation of an unknown speed: a hand-held camera that turns by 45 degrees a second.
constexpr double kFirstSpeed_px_s = 400;
// Prior of the detection rate: 4 of 5 frames, which as many frames of its own outweigh.
constexpr double kPriorHits = 4, kPriorFrames = 5;
constexpr std::size_t kMinCommonShift = 3;  // boxes whose median tells a shift of the image

std::array<double, 4> Sides(const Box& b) {
  return {b.min.x(), b.min.y(), b.max.x(), b.max.y()};
}

/// A total order that does not depend on where a detection stands in its list.
auto Key(const Detection& d) {
  return std::make_tuple(-d.score, d.class_name, Sides(d.box_px));
}

/// Of the two in the middle of an even number, their mean.
double Median(const std::vector<double>& x) { return 0.5 * (LowerMedian(x) + UpperMedian(x)); }

}  // namespace

Box BoxTracks::Track::box() const {
  // Noise may turn a thin box over: keep it a box.
  const double u0 = sides[0].x, v0 = sides[1].x;
  return {{u0, v0}, {std::max(u0, sides[2].x), std::max(v0, sides[3].x)}};
}

const std::string& BoxTracks::Track::class_name() const {
  auto best = classes.begin();
  for (auto it = classes.begin(); it != classes.end(); ++it)
    if (it->second.weight > best->second.weight) best = it;
  return best->first;
}

BoxTracks::BoxTracks(const BoxTracksConfig& config, const Box& image_px)
    : config_(config), image_px_(image_px) {
  const auto within = [](double x, double low, double high) { return x >= low && x <= high; };
  Require(!image_px.empty(), "BoxTracks: the image is empty");
  Require(within(config.max_duplicate_iou, 0, 1) && within(config.min_match_iou, 0, 1) &&
              within(config.min_existence, 0, 1) && within(config.survival, 0, 1) &&
              within(config.max_detection_rate, 0, 1) && within(config.class_memory, 0, 1) &&
              within(config.min_visible_fraction, 0, 1) && config.min_class_ratio >= 1,
          "BoxTracks: a fraction of the config is outside its domain");
  Require(config.min_hits >= 1 && config.max_gap_frames >= 0 && config.max_coast_frames >= 1,
          "BoxTracks: a count of the config is outside its domain");
  Require(config.jitter_px > 0 && config.jitter_fraction >= 0 && config.acceleration_px_s2 > 0,
          "BoxTracks: noise must be positive");
}

std::vector<Detection> BoxTracks::Update(double timestamp_s,
                                         const std::vector<Detection>& detections) {
  if (!config_.enabled) return detections;
  Advance(timestamp_s);

  // One canonical order, so that tracks and ties do not depend on the order given.
  const std::vector<std::size_t> kept = Deduplicated(detections);
  std::vector<Detection> sorted;
  sorted.reserve(kept.size());
  for (const std::size_t i : kept) sorted.push_back(detections[i]);
  const std::vector<std::size_t> track_of = Follow(sorted);

  // The answer: what was detected, in the order given, then what was missed.
  std::vector<std::pair<std::size_t, Detection>> given;
  for (std::size_t d = 0; d < sorted.size(); ++d)
    given.emplace_back(kept[d], Labelled(tracks_[track_of[d]], sorted[d]));
  std::sort(given.begin(), given.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Detection> answer;
  answer.reserve(given.size());
  for (auto& [position, detection] : given) answer.push_back(std::move(detection));
  AddUnseen(answer);

  std::erase_if(tracks_, [&](const Track& t) {
    const bool tentative = t.hits < config_.min_hits && t.misses_in_row > config_.min_hits;
    const bool missed = t.misses_in_row > 0;
    return tentative || (missed && t.frames_since_hit > config_.max_coast_frames);
  });
  return answer;
}

std::vector<Detection> BoxTracks::Carry(double timestamp_s) {
  if (!config_.enabled) return {};
  Advance(timestamp_s);
  std::erase_if(tracks_, [&](const Track& t) { return timestamp_s - t.seen_s > kMaxPause_s; });
  for (Track& track : tracks_) track.existence *= config_.survival;
  std::vector<Detection> answer;
  AddUnseen(answer);
  return answer;
}

/// Takes the tracks to the time of a frame.
void BoxTracks::Advance(double timestamp_s) {
  Require(std::isfinite(timestamp_s) && (!started_ || timestamp_s > last_s_),
          "BoxTracks: timestamps must increase");
  const double pause_s = started_ ? timestamp_s - last_s_ : 0.0;
  started_ = true;
  last_s_ = timestamp_s;
  if (pause_s > kMaxPause_s) tracks_.clear();
  Predict(pause_s);
  for (Track& track : tracks_) ++track.frames_since_hit;
}

/// Brings the tracks up to date with the detections.
/// @returns the position of each detection's track
std::vector<std::size_t> BoxTracks::Follow(const std::vector<Detection>& detections) {
  const std::vector<int> detection_of = Assign(detections);
  constexpr std::size_t kNoTrack = static_cast<std::size_t>(-1);
  std::vector<std::size_t> track_of(detections.size(), kNoTrack);
  for (std::size_t t = 0; t < detection_of.size(); ++t) {
    Track& track = tracks_[t];
    ++track.asked;
    for (auto& [name, evidence] : track.classes) evidence.weight *= config_.class_memory;
    if (detection_of[t] < 0) {
      Miss(track);
      continue;
    }
    const auto d = static_cast<std::size_t>(detection_of[t]);
    track_of[d] = t;
    Correct(track, detections[d]);
  }
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (track_of[d] != kNoTrack) continue;
    track_of[d] = tracks_.size();
    Start(detections[d]);
  }
  return track_of;
}

/// Adds the boxes of tracks without a detection in this frame, unless the answer has such a box
/// already.
void BoxTracks::AddUnseen(std::vector<Detection>& answer) const {
  for (const Track& track : tracks_) {
    if (track.frames_since_hit == 0) continue;
    // What the detector found stands until it is asked again; what it missed must be believed.
    if (track.misses_in_row > 0 && !IsBelieved(track)) continue;
    std::optional<Detection> filled = Predicted(track);
    if (!filled) continue;
    const bool seen_already =
        std::any_of(answer.begin(), answer.end(), [&](const Detection& d) {
          return d.class_name == filled->class_name &&
                 Iou(d.box_px, filled->box_px) > config_.max_duplicate_iou;
        });
    if (!seen_already) answer.push_back(std::move(*filled));
  }
}

/// Positions of the detections without duplicates, in canonical order.
std::vector<std::size_t> BoxTracks::Deduplicated(
    const std::vector<Detection>& detections) const {
  std::vector<std::size_t> order(detections.size()), kept;
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return Key(detections[a]) < Key(detections[b]);
  });
  for (const std::size_t i : order) {
    const bool duplicate = std::any_of(kept.begin(), kept.end(), [&](std::size_t k) {
      return detections[k].class_name == detections[i].class_name &&
             Iou(detections[k].box_px, detections[i].box_px) > config_.max_duplicate_iou;
    });
    if (!duplicate) kept.push_back(i);
  }
  return kept;
}

/// Moves each side by its velocity, with white acceleration over the step.
void BoxTracks::Predict(double dt_s) {
  if (!(dt_s > 0)) return;
  const double q = config_.acceleration_px_s2 * config_.acceleration_px_s2;
  for (Track& track : tracks_) {
    for (Side& s : track.sides) {
      s.x += s.v * dt_s;
      s.p_xx += 2 * dt_s * s.p_xv + dt_s * dt_s * s.p_vv + 0.25 * q * std::pow(dt_s, 4);
      s.p_xv += dt_s * s.p_vv + 0.5 * q * std::pow(dt_s, 3);
      s.p_vv += q * dt_s * dt_s;
    }
  }
}

/// Gain of pairing a track with a detection; 0: they do not belong together.
double BoxTracks::Affinity(const Track& track, const Detection& detection) const {
  // The image cuts detections off; cut the prediction off as well before they are compared.
  const double iou = Iou(Intersection(track.box(), image_px_), detection.box_px);
  const bool same_class = track.classes.count(detection.class_name) > 0;
  const double gain = iou - (same_class ? 0.0 : config_.class_change_iou_penalty);
  return gain > config_.min_match_iou ? gain : 0.0;
}

/// Best pairing of some tracks with the detections not taken: by track, or -1.
std::vector<int> BoxTracks::Match(const std::vector<Detection>& detections,
                                  const std::vector<std::size_t>& tracks,
                                  const std::vector<bool>& taken) const {
  std::vector<std::vector<double>> gain;
  for (const std::size_t t : tracks) {
    std::vector<double> row;
    for (std::size_t d = 0; d < detections.size(); ++d)
      row.push_back(taken[d] ? 0.0 : Affinity(tracks_[t], detections[d]));
    gain.push_back(std::move(row));
  }
  return AssignForLargestGain(gain);
}

/// The detection of each track, or -1.
std::vector<int> BoxTracks::Assign(const std::vector<Detection>& detections) {
  std::vector<int> detection_of(tracks_.size(), -1);
  std::vector<bool> taken(detections.size(), false);
  std::vector<std::size_t> open(tracks_.size());
  std::iota(open.begin(), open.end(), 0u);
  const auto match = [&] {
    const std::vector<int> found = Match(detections, open, taken);
    std::vector<std::size_t> still_open;
    for (std::size_t i = 0; i < open.size(); ++i) {
      detection_of[open[i]] = found[i];
      if (found[i] >= 0)
        taken[static_cast<std::size_t>(found[i])] = true;
      else
        still_open.push_back(open[i]);
    }
    open = still_open;
  };
  match();
  if (open.empty()) return detection_of;
  MoveWithTheOthers(detections, detection_of, open);
  match();
  return detection_of;
}

/// Mean shift of a box's sides along an axis (0: u, 1: v) that the image's border does not cut off: those
/// that it does stay where they are. Nothing where it cuts off both.
std::optional<double> BoxTracks::ShiftOf(const Box& expected, const Box& seen, int axis) const {
  constexpr double kAtBorder_px = 1.0;
  const double low = image_px_.min[axis] + kAtBorder_px,
               high = image_px_.max[axis] - kAtBorder_px;
  double sum = 0.0;
  int sides = 0;
  for (const auto& [from, to] : {std::pair(expected.min[axis], seen.min[axis]),
                                 std::pair(expected.max[axis], seen.max[axis])}) {
    if (std::min(from, to) < low || std::max(from, to) > high) continue;
    sum += to - from;
    ++sides;
  }
  return sides > 0 ? std::optional(sum / sides) : std::nullopt;
}

/// How far the paired boxes are from where they were expected: when the hand jerks, all of them
/// by the same. The missed ones moved with them.
void BoxTracks::MoveWithTheOthers(const std::vector<Detection>& detections,
                                  const std::vector<int>& detection_of,
                                  const std::vector<std::size_t>& missed) {
  std::vector<double> shift_u, shift_v;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (detection_of[t] < 0) continue;
    const Box expected = Intersection(tracks_[t].box(), image_px_);
    const Box& seen = detections[static_cast<std::size_t>(detection_of[t])].box_px;
    if (const auto du = ShiftOf(expected, seen, 0)) shift_u.push_back(*du);
    if (const auto dv = ShiftOf(expected, seen, 1)) shift_v.push_back(*dv);
  }
  if (std::min(shift_u.size(), shift_v.size()) < kMinCommonShift) return;
  const double du = Median(shift_u), dv = Median(shift_v);
  for (const std::size_t t : missed) {
    auto& sides = tracks_[t].sides;
    sides[0].x += du, sides[1].x += dv, sides[2].x += du, sides[3].x += dv;
  }
}

/// Kalman update of each side by the detected box.
void BoxTracks::Correct(Track& track, const Detection& detection) const {
  const Box& seen = detection.box_px;
  const std::array<double, 4> z = Sides(seen);
  for (std::size_t i = 0; i < 4; ++i) {
    Side& s = track.sides[i];
    const double size = i % 2 == 0 ? seen.width() : seen.height();
    const double sigma = config_.jitter_px + config_.jitter_fraction * size;
    const double variance = s.p_xx + sigma * sigma;
    const double gain_x = s.p_xx / variance, gain_v = s.p_xv / variance;
    const double innovation = z[i] - s.x;
    s.x += gain_x * innovation;
    s.v += gain_v * innovation;
    s.p_vv -= gain_v * s.p_xv;
    s.p_xv -= gain_x * s.p_xv;
    s.p_xx -= gain_x * s.p_xx;
  }
  ++track.hits;
  track.misses_in_row = 0;
  track.frames_since_hit = 0;
  track.seen_s = last_s_;
  track.existence = 1.0;
  track.score = detection.score;
  ClassEvidence& evidence = track.classes[detection.class_name];
  evidence.weight += detection.score;
  evidence.kind = detection.kind;
}

/// Probability that the object is detected in a frame in which it is there.
double BoxTracks::DetectionRate(const Track& track) const {
  // The present run of misses is what is being judged: it has no say in its own likelihood.
  const double asked = track.asked - track.misses_in_row;
  const double rate = (track.hits + kPriorHits) / (asked + kPriorFrames);
  return std::min(rate, config_.max_detection_rate);
}

void BoxTracks::Miss(Track& track) const {
  ++track.misses_in_row;
  // Bayes: there and missed, against gone.
  const double there = track.existence * config_.survival;
  const double missed = there * (1.0 - DetectionRate(track));
  track.existence = missed / (missed + (1.0 - there));
}

void BoxTracks::Start(const Detection& detection) {
  Track track;
  const std::array<double, 4> z = Sides(detection.box_px);
  for (std::size_t i = 0; i < 4; ++i) {
    const double size = i % 2 == 0 ? detection.box_px.width() : detection.box_px.height();
    const double sigma = config_.jitter_px + config_.jitter_fraction * size;
    track.sides[i] = {z[i], 0.0, sigma * sigma, 0.0, kFirstSpeed_px_s * kFirstSpeed_px_s};
  }
  track.hits = track.asked = 1;
  track.seen_s = last_s_;
  track.score = detection.score;
  track.classes[detection.class_name] = {detection.score, detection.kind};
  tracks_.push_back(std::move(track));
}

/// The detection with the class that its track believes in.
Detection BoxTracks::Labelled(const Track& track, Detection detection) const {
  detection.compensated = false;
  if (track.hits < config_.min_hits) return detection;
  const std::string& believed = track.class_name();
  const ClassEvidence& best = track.classes.at(believed);
  const double own = track.classes.at(detection.class_name).weight;
  if (best.weight > config_.min_class_ratio * own) {
    detection.class_name = believed;
    detection.kind = best.kind;
  }
  return detection;
}

/// Whether a missed object is most likely still there, and its box not yet too old.
bool BoxTracks::IsBelieved(const Track& track) const {
  return track.hits >= config_.min_hits && track.frames_since_hit <= config_.max_gap_frames &&
         track.existence > config_.min_existence;
}

/// The box of an object that was not seen in this frame, if it is in view.
std::optional<Detection> BoxTracks::Predicted(const Track& track) const {
  const Box whole = track.box(), seen = Intersection(whole, image_px_);
  if (!(seen.area() > 0.0) || seen.area() < config_.min_visible_fraction * whole.area())
    return std::nullopt;
  Detection filled;
  filled.class_name = track.class_name();
  filled.kind = track.classes.at(filled.class_name).kind;
  filled.score = track.score * track.existence;
  filled.box_px = seen;
  filled.compensated = true;
  return filled;
}

}  // namespace slam
