#include "slam/detect/detections.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "io/input_error.h"
#include "io/json_field.h"
#include "io/number_text.h"
#include "slam/detect/yolox_detector.h"

namespace slam {
namespace {

constexpr std::string_view kYolox = "yolox:";

constexpr std::size_t kMaxClassName = 100;  // bytes; keeps a run's files readable

Box ReadBox(const io::JsonField& field) {
  static const io::Interval kPixels(-1e6, 1e6);  // far beyond any image
  static constexpr const char* kForm = "[x0, y0, x1, y1] in pixels with x0 <= x1 and y0 <= y1";
  const std::vector<io::JsonField> side = field.Elements();
  if (side.size() != 4) field.Fail(kForm);
  Box box{{side[0].Number(kPixels), side[1].Number(kPixels)},
          {side[2].Number(kPixels), side[3].Number(kPixels)}};
  if (!(box.min.x() <= box.max.x() && box.min.y() <= box.max.y())) field.Fail(kForm);
  return box;
}

Detection ReadDetection(const io::JsonField& field, const ClassTable& classes) {
  Detection d;
  d.class_name = field["class"].Text();
  if (d.class_name.empty() || d.class_name.size() > kMaxClassName)
    field["class"].Fail("a text of 1 to 100 bytes");
  d.kind = classes.KindOf(d.class_name);
  d.score = field["score"].Number({0, 1});
  d.box_px = ReadBox(field["box"]);
  return d;
}

}  // namespace

DetectionRecord ReadDetections(const io::JsonField& record, const Camera& camera,
                               const ClassTable& classes) {
  static const io::Interval kSeconds(0, 1e11);  // milliseconds since 1970 are above it
  DetectionRecord read;
  read.timestamp_s = record["timestamp"].Number(kSeconds);
  for (const io::JsonField& field : record["detections"].Elements()) {
    Detection d = ReadDetection(field, classes);
    d.box_px = Intersection(d.box_px, camera.ImageBox());
    if (d.box_px.area() > 0) read.detections.push_back(std::move(d));
  }
  return read;
}

ReplayDetector::ReplayDetector(const std::filesystem::path& file, const Camera& camera,
                               const ClassTable& classes)
    : file_(file) {
  const auto read = [&](const io::JsonField& line) {
    DetectionRecord record = ReadDetections(line, camera, classes);
    if (!records_.empty() && !(record.timestamp_s > records_.rbegin()->first))
      line["timestamp"].Fail("more than in the line before, one line a frame");
    records_[record.timestamp_s] = std::move(record.detections);
  };
  io::ForEachJsonLine(file, "without it pass --detector none", read);
}

ReplayDetector::Records::const_iterator ReplayDetector::Find(double timestamp_s) const {
  const auto after = records_.lower_bound(timestamp_s);
  auto nearest = after;
  if (after != records_.begin()) {
    const auto before = std::prev(after);
    if (after == records_.end() || timestamp_s - before->first < after->first - timestamp_s)
      nearest = before;
  }
  if (nearest == records_.end()) return nearest;
  const bool same = std::abs(nearest->first - timestamp_s) <= kMaxTimeDifference_s;
  return same ? nearest : records_.end();
}

std::vector<Detection> ReplayDetector::Detect(double timestamp_s, const cv::Mat3b&) {
  const auto record = Find(timestamp_s);
  return record == records_.end() ? std::vector<Detection>{} : record->second;
}

std::vector<std::string> ReplayDetector::WarningsFor(
    const std::vector<double>& frames_s) const {
  std::set<double> used;
  std::size_t without = 0;
  for (const double frame_s : frames_s) {
    const auto record = Find(frame_s);
    if (record == records_.end()) {
      ++without;
    } else {
      used.insert(record->first);
    }
  }
  if (!records_.empty() && used.empty()) {
    throw io::InputError(file_.string(),
                         "none of its lines has the time of a frame; it is of another "
                         "recording: make it again, or pass --detector none");
  }
  std::vector<std::string> warnings;
  const auto of = [](std::size_t some, std::size_t all) {
    return std::to_string(some) + " of " + std::to_string(all);
  };
  if (used.size() < records_.size()) {
    const auto first = std::find_if(records_.begin(), records_.end(), [&](const auto& record) {
      return used.count(record.first) == 0;
    });
    warnings.push_back(of(records_.size() - used.size(), records_.size()) +
                       " lines of detections.jsonl have the time of no frame and are not used; "
                       "first timestamp " +
                       io::NumberText(first->first));
  }
  if (without > 0) {
    warnings.push_back(of(without, frames_s.size()) +
                       " frames have no line in detections.jsonl; they are taken to show no "
                       "object");
  }
  return warnings;
}

std::string ModelFile(const std::string& choice) {
  return choice.starts_with(kYolox) ? choice.substr(kYolox.size()) : "";
}

void RequireDetectorChoice(const std::string& choice) {
  if (choice.starts_with(kYolox)) {
    if (!ModelFile(choice).empty()) return;
    throw io::InputError("--detector yolox:", "names no file; expected yolox:FILE.onnx");
  }
  if (choice == "none" || choice == "replay") return;
  throw io::InputError("--detector " + choice,
                       "unknown detector; expected replay, yolox:FILE.onnx or none");
}

std::unique_ptr<Detector> MakeDetector(const std::string& choice,
                                       const std::filesystem::path& sequence,
                                       const Camera& camera, const ClassTable& classes,
                                       const YoloxConfig& yolox) {
  RequireDetectorChoice(choice);
  if (choice == "none") return std::make_unique<NoDetector>();
  if (const std::string model = ModelFile(choice); !model.empty()) {
    return std::make_unique<YoloxDetector>(model, camera, classes, yolox);
  }
  return std::make_unique<ReplayDetector>(sequence / "detections.jsonl", camera, classes);
}

}  // namespace slam
