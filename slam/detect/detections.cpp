#include "slam/detect/detections.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "slam/base/require.h"
#include "slam/detect/yolox_detector.h"

namespace slam {
namespace {

using Json = nlohmann::json;

constexpr double kMaxPixel = 1e6;
constexpr double kMaxStamp_s = 1e11;
constexpr std::size_t kMaxClassName = 100;
constexpr std::size_t kMaxLine = 4u << 20;
constexpr std::size_t kMaxDetections = 10'000;  // a frame
constexpr int kMaxDepth = 8;

/// The value of a required key. `owner` is for the message.
const Json& Get(const Json& object, const char* key, const std::string& where,
                const std::string& owner) {
  if (!object.is_object()) throw InputError(where, owner + " is not an object {...}");
  const auto it = object.find(key);
  if (it == object.end()) throw InputError(where, owner + " has no key \"" + key + "\"");
  return *it;
}

double GetNumber(const Json& value, double min, double max, const std::string& where,
                 const std::string& what, const std::string& domain) {
  const double x = value.is_number() ? value.get<double>() : std::nan("");
  if (!(x >= min && x <= max))
    throw InputError(where, what + " is " +
                                value.dump(-1, ' ', false, Json::error_handler_t::replace) +
                                "; expected " + domain);
  return x;
}

Box GetBox(const Json& box, const std::string& where, const std::string& owner) {
  static constexpr const char* kForm = "[x0, y0, x1, y1] in pixels with x0 <= x1 and y0 <= y1";
  if (!box.is_array() || box.size() != 4)
    throw InputError(where, "\"box\" of " + owner + " is not " + kForm);
  double side[4];
  for (std::size_t i = 0; i < 4; ++i)
    side[i] = GetNumber(box[i], -kMaxPixel, kMaxPixel, where, "\"box\" of " + owner, kForm);
  if (!(side[0] <= side[2] && side[1] <= side[3]))
    throw InputError(where, "\"box\" of " + owner + " is turned over; expected " + kForm);
  return {{side[0], side[1]}, {side[2], side[3]}};
}

Detection GetDetection(const Json& json, const ClassTable& classes, const std::string& where,
                       const std::string& owner) {
  Detection d;
  const Json& name = Get(json, "class", where, owner);
  if (!name.is_string() || name.get_ref<const std::string&>().empty() ||
      name.get_ref<const std::string&>().size() > kMaxClassName)
    throw InputError(where, "\"class\" of " + owner + " is not a text of 1 to 100 bytes");
  d.class_name = name.get<std::string>();
  d.kind = classes.KindOf(d.class_name);
  d.score = GetNumber(Get(json, "score", where, owner), 0, 1, where, "\"score\" of " + owner,
                      "a number in [0, 1]");
  d.box_px = GetBox(Get(json, "box", where, owner), where, owner);
  return d;
}

/// Depth is bounded while parsing: a line of brackets must not end the program.
Json ParseLine(const std::string& text, const std::string& where) {
  try {
    return Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
      if (depth > kMaxDepth) throw InputError("nested too deeply");
      return true;
    });
  } catch (const std::exception&) {
    throw InputError(where, "not JSON; expected {\"timestamp\": t, \"detections\": [...]}");
  }
}

}  // namespace

DetectionRecord ParseDetections(const std::string& text, const Camera& camera,
                                const ClassTable& classes, const std::string& where) {
  const Json line = ParseLine(text, where);
  DetectionRecord record;
  record.timestamp_s = GetNumber(Get(line, "timestamp", where, "the record"), 0, kMaxStamp_s,
                                 where, "\"timestamp\"", "seconds >= 0");
  const Json& list = Get(line, "detections", where, "the record");
  if (!list.is_array() || list.size() > kMaxDetections)
    throw InputError(where, "\"detections\" is not a list of at most 10000 objects");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string owner = std::string("detection ").append(std::to_string(i));
    Detection d = GetDetection(list[i], classes, where, owner);
    d.box_px = Intersection(d.box_px, camera.ImageBox());
    if (d.box_px.area() > 0) record.detections.push_back(std::move(d));
  }
  return record;
}

ReplayDetector::ReplayDetector(const std::filesystem::path& file, const Camera& camera,
                               const ClassTable& classes) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError(file.string(), "no such file; without it pass --detector none");
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string(), "cannot be read; check its permissions");
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    const std::string where = file.string() + std::string(":").append(std::to_string(number));
    if (text.size() > kMaxLine) throw InputError(where, "the line is longer than 4 MiB");
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    DetectionRecord record = ParseDetections(text, camera, classes, where);
    if (!records_.empty() && !(record.timestamp_s > records_.rbegin()->first))
      throw InputError(where, "\"timestamp\" does not increase; expected one record a frame");
    records_[record.timestamp_s] = std::move(record.detections);
  }
}

std::vector<Detection> ReplayDetector::Detect(double timestamp_s, const cv::Mat3b&) {
  const auto after = records_.lower_bound(timestamp_s);
  auto nearest = after;
  if (after != records_.begin()) {
    const auto before = std::prev(after);
    if (after == records_.end() || timestamp_s - before->first < after->first - timestamp_s)
      nearest = before;
  }
  if (nearest == records_.end()) return {};
  const bool same = std::abs(nearest->first - timestamp_s) <= kMaxTimeDifference_s;
  return same ? nearest->second : std::vector<Detection>{};
}

std::unique_ptr<Detector> MakeDetector(const std::string& choice,
                                       const std::filesystem::path& sequence,
                                       const Camera& camera, const ClassTable& classes,
                                       const YoloxConfig& yolox) {
  static constexpr std::string_view kYolox = "yolox:";
  if (choice == "none") return std::make_unique<NoDetector>();
  if (choice.starts_with(kYolox)) {
    const std::string model = choice.substr(kYolox.size());
    if (model.empty())
      throw InputError("--detector yolox:", "names no file; expected yolox:FILE.onnx");
    return std::make_unique<YoloxDetector>(model, camera, classes, yolox);
  }
  if (choice != "replay")
    throw InputError("--detector " + choice,
                     "unknown detector; expected replay, yolox:FILE.onnx or none");
  return std::make_unique<ReplayDetector>(sequence / "detections.jsonl", camera, classes);
}

}  // namespace slam
