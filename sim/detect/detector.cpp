#include "sim/detect/detector.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/base/random.h"
#include "sim/detect/confusions.h"
#include "sim/detect/slow_noise.h"
#include "sim/sensor/noise.h"

namespace sim {
namespace {

/// Streams of random numbers, so that changing one effect leaves the others alone.
enum Stream : std::uint64_t {
  kMiss = 1,
  kSide = 2,
  kConfuse = 3,
  kScore = 4,
  kTwice = 5,
  kPhantom = 6,
  kSecondBox = 7
};

constexpr int kPhantomWindow = 4;  ///< frames

double Rounded(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit;
}
std::uint64_t Key(std::uint64_t seed, std::uint64_t stream, std::uint64_t target) {
  return Random({seed, 0xDE7EC7ull, stream, target}).Bits();
}
/// Objects of one group are one thing, others one each.
std::pair<bool, int> ThingOf(const Object& object) {
  const bool grouped = object.detection_group > 0;
  return {grouped, grouped ? object.detection_group : object.id};
}
bool LargeEnough(const PixelBox& box) { return box.x1 - box.x0 >= 2 && box.y1 - box.y0 >= 2; }

}  // namespace

double DetectionTarget::VisibleFraction() const {
  return static_cast<double>(pixels) / std::max(unoccluded, 1);
}

DetectorModel PoorDetector() {
  DetectorModel model;
  model.min_pixels = 150;
  model.base_miss = 0.10;
  model.small_miss = 0.9, model.small_size_px = 45;
  model.hidden_miss = 0.9;
  model.miss_run_frames = 12;
  model.jitter_ratio = 0.05, model.jitter_px = 1.5;
  model.confused = 0.10;
  model.duplicate = 0.06, model.duplicate_run_frames = 6;
  model.phantom = 0.12;
  return model;
}

DetectorModel ModelOf(DetectorKind kind) {
  return kind == DetectorKind::kPoor ? PoorDetector() : DetectorModel{};
}

Detector::Detector(const Scene& scene, const Camera& camera, DetectorKind kind,
                   std::uint64_t seed, const DetectorModel& model)
    : scene_(scene),
      camera_(camera),
      kind_(kind),
      seed_(seed),
      model_(model),
      scale_(std::sqrt(static_cast<double>(camera.width) * camera.height / (640.0 * 480.0))) {}

std::vector<DetectionTarget> Detector::VisibleTargets(const FrameTruth& truth) const {
  std::map<int, const ObjectInFrame*> seen;
  for (const ObjectInFrame& object : truth.objects) seen[object.id] = &object;
  std::vector<Target> targets;
  std::map<std::pair<bool, int>, std::size_t> target_of;  // by ThingOf
  for (const Object& object : scene_.objects) {
    if (object.role != Role::kRegular && object.role != Role::kUnstructured) continue;
    if (!target_of.try_emplace(ThingOf(object), targets.size()).second) continue;
    targets.push_back({static_cast<std::uint64_t>(object.id), object.class_name, 0, 0, {}});
  }
  // What is not detected by itself may be a part of what is, as the keys of a keyboard.
  for (const Object& object : scene_.objects) {
    const auto thing = target_of.find(ThingOf(object));
    const auto found = seen.find(object.id);
    if (thing == target_of.end() || found == seen.end()) continue;
    if (object.role == Role::kStructure) continue;
    Target& target = targets[thing->second];
    const PixelBox& box = found->second->visible_box;
    target.box =
        target.pixels == 0
            ? box
            : PixelBox{std::min(target.box.x0, box.x0), std::min(target.box.y0, box.y0),
                       std::max(target.box.x1, box.x1), std::max(target.box.y1, box.y1)};
    target.pixels += found->second->pixels;
    // What one part hides of another does not hide the thing.
    target.unoccluded = object.detection_group > 0
                            ? truth.unoccluded_pixels_of_group.at(object.detection_group)
                            : found->second->unoccluded_pixels;
  }
  const double min_pixels = model_.min_pixels * scale_ * scale_;
  std::erase_if(targets, [&](const Target& target) {
    return target.pixels < min_pixels || !LargeEnough(target.box);
  });
  return targets;
}

bool Detector::Missed(const Target& target, int frame) const {
  const double size = std::sqrt(static_cast<double>(target.pixels)) / scale_;
  const double small = model_.small_miss * std::exp(-size / model_.small_size_px);
  const double hidden = 1.0 - target.VisibleFraction();
  const double found =
      (1 - model_.base_miss) * (1 - small) * (1 - model_.hidden_miss * hidden * hidden);
  const SlowNoise luck(Key(seed_, kMiss, target.key), model_.miss_run_frames);
  return luck.Uniform(frame) > found;
}

PixelBox Detector::Jittered(const PixelBox& box, std::uint64_t key, int frame,
                            double gain) const {
  const double slow = std::sqrt(model_.slow_jitter_share);
  const double fast = std::sqrt(1 - model_.slow_jitter_share);
  Random random{key, static_cast<std::uint64_t>(frame)};
  const auto side = [&](double at, double length, std::uint64_t which, double last) {
    const double sigma = gain * (model_.jitter_ratio * length + model_.jitter_px * scale_);
    const double drift = SlowNoise(key + which, model_.miss_run_frames).Normal(frame);
    return std::clamp(at + sigma * (slow * drift + fast * NormalDraw(random)), 0.0, last);
  };
  const double width = box.x1 - box.x0, height = box.y1 - box.y0;
  const double last_u = camera_.width - 1, last_v = camera_.height - 1;
  const double x0 = side(box.x0, width, 1, last_u), y0 = side(box.y0, height, 2, last_v);
  const double x1 = side(box.x1, width, 3, last_u), y1 = side(box.y1, height, 4, last_v);
  return {std::min(x0, x1), std::min(y0, y1), std::max(x0, x1), std::max(y0, y1)};
}

Detection Detector::Report(const Target& target, int frame) const {
  Detection detection;
  detection.class_name = target.class_name;
  detection.box = Jittered(target.box, Key(seed_, kSide, target.key), frame, 1.0);
  const double size = std::sqrt(static_cast<double>(target.pixels)) / scale_;
  Random random{seed_, kScore, target.key, static_cast<std::uint64_t>(frame)};
  double score =
      0.55 + 0.4 * target.VisibleFraction() * (size / (size + 20)) + 0.05 * NormalDraw(random);
  const SlowNoise doubt(Key(seed_, kConfuse, target.key), 2 * model_.miss_run_frames);
  if (doubt.Uniform(frame) < model_.confused) {
    const auto others = ConfusedWith(target.class_name);
    detection.class_name = others[random.Chance(0.7) ? 0 : others.size() - 1];
    score -= 0.25;
  }
  detection.score = std::clamp(score, 0.26, 0.99);
  return detection;
}

void Detector::AddPhantom(int frame, std::vector<Detection>& detections) const {
  Random window{seed_, kPhantom, static_cast<std::uint64_t>(frame / kPhantomWindow)};
  if (!window.Chance(model_.phantom)) return;
  const double width = window.Between(30, 150) * scale_,
               height = window.Between(30, 150) * scale_;
  const double x0 = window.Between(0, camera_.width - 1 - width);
  const double y0 = window.Between(0, camera_.height - 1 - height);
  const auto classes = PhantomClasses();
  Detection phantom;
  phantom.class_name =
      classes[static_cast<std::size_t>(window.Below(static_cast<int>(classes.size())))];
  phantom.score = window.Between(0.25, 0.5);
  phantom.box = Jittered(
      {x0, y0, x0 + width, y0 + height},
      Key(seed_, kPhantom, static_cast<std::uint64_t>(frame / kPhantomWindow)), frame, 1.0);
  detections.push_back(phantom);
}

std::vector<Detection> Detector::Detect(int frame, const FrameTruth& truth) const {
  std::vector<Detection> detections;
  if (kind_ == DetectorKind::kNone) return detections;
  for (const Target& target : VisibleTargets(truth)) {
    if (kind_ == DetectorKind::kPerfect) {
      detections.push_back({target.class_name, 1.0, target.box});
      continue;
    }
    if (Missed(target, frame)) continue;
    const Detection first = Report(target, frame);
    detections.push_back(first);
    const SlowNoise twice(Key(seed_, kTwice, target.key), model_.duplicate_run_frames);
    if (twice.Uniform(frame) < model_.duplicate) {
      detections.push_back(
          {first.class_name, 0.6 * first.score,
           Jittered(target.box, Key(seed_, kSecondBox, target.key), frame, 3.0)});
    }
  }
  if (kind_ == DetectorKind::kPerfect) return detections;
  AddPhantom(frame, detections);
  std::erase_if(detections, [](const Detection& d) { return !LargeEnough(d.box); });
  for (Detection& d : detections) {
    d.score = Rounded(d.score, 1000);
    d.box = {Rounded(d.box.x0, 100), Rounded(d.box.y0, 100), Rounded(d.box.x1, 100),
             Rounded(d.box.y1, 100)};
  }
  std::stable_sort(detections.begin(), detections.end(),
                   [](const Detection& a, const Detection& b) { return a.score > b.score; });
  return detections;
}

std::string DetectionsJson(double timestamp_s, const std::vector<Detection>& detections) {
  nlohmann::ordered_json json;
  json["timestamp"] = timestamp_s;
  json["detections"] = nlohmann::ordered_json::array();
  for (const Detection& d : detections) {
    json["detections"].push_back({{"class", d.class_name},
                                  {"score", d.score},
                                  {"box", {d.box.x0, d.box.y0, d.box.x1, d.box.y1}}});
  }
  return json.dump();
}

}  // namespace sim
