#include "eval/formats/run/frame_planes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "eval/formats/plane_record.h"
#include "eval/formats/stamps.h"

namespace eval {
namespace {

constexpr int kMaxIndex = 254;  // a segmentation has 8 bits, and 0 means none

/// A text that should be one of `words`.
std::optional<std::string> ReadWord(const JsonRecord& plane, const char* key,
                                    const std::vector<std::string>& words, Severity severity) {
  auto text = plane.Text(key);
  if (text && std::find(words.begin(), words.end(), *text) == words.end()) {
    plane.TellAt(key, "is " + *text, fmt::format("use {}", fmt::join(words, ", ")), severity);
    if (severity == Severity::kFatal) return std::nullopt;
  }
  return text;
}

std::vector<std::array<Eigen::Vector3d, 2>> ReadLines(const JsonRecord& plane) {
  std::vector<std::array<Eigen::Vector3d, 2>> lines;
  for (const JsonRecord& line : plane.Expected().Items("lines")) {
    const std::vector<JsonRecord> ends = line.AsItems();
    if (ends.size() != 2) {
      line.Tell("is not a pair [P, V]", "write a point and a direction [[..], [..]]");
      continue;
    }
    const auto P = ends[0].AsVector3(), V = ends[1].AsVector3();
    if (V && !(V->norm() > 0)) {
      ends[1].Tell("has no direction", "write a direction that is not zero", Severity::kFlaw);
    }
    if (P && V) lines.push_back({*P, *V});
  }
  return lines;
}

void ReadGeometry(const JsonRecord& record, RunFramePlane& plane) {
  auto pi_c = ReadPlane(record, kRunUnit);
  if (pi_c && !(pi_c->d > 0)) {
    record.TellAt("d", fmt::format("is {}; a plane that the camera sees has d > 0", pi_c->d),
                  "turn the normal and d around, so that the normal faces the camera",
                  Severity::kWarning);
    // The camera is the origin, so which side it sees is known.
    if (pi_c->d < 0) *pi_c = {-pi_c->n, -pi_c->d};
  }
  if (pi_c) plane.pi_c = *pi_c;
  if (const auto centroid_c = record.Vector3("centroid")) {
    plane.centroid_c = *centroid_c;
    if (!(centroid_c->z() > 0)) {
      record.TellAt("centroid", "is behind the camera", "write it in the camera frame, z ahead",
                    Severity::kWarning);
    }
  }
  plane.lines_c = ReadLines(record);
  plane.vertices_c = ReadPointsOnPlane(record, "vertices", pi_c);
}

RunFramePlane ReadFramePlane(const JsonRecord& record) {
  const JsonRecord optional = record.Optional();
  RunFramePlane plane;
  plane.index = record.Integer("index", 0, kMaxIndex).value_or(-1);
  ReadGeometry(record, plane);
  plane.pixels = record.Integer("pixels", 1).value_or(0);
  // What is read into nothing is in no figure; a wrong one is told.
  record.Expected().Number("inlier_ratio", io::Interval("[0, 1]"));
  plane.plane_class = (record.Contains("class") ? optional : record.Expected()).Text("class");
  optional.Integer("detection", 0);
  plane.bad =
      ReadWord(record.Contains("bad") ? optional : record.Expected(), "bad",
               {"far", "inliers", "border", "structure", "unstructured"}, Severity::kWarning);
  if (!record.Contains("map_plane")) {
    record.TellAt("map_plane", "is missing; expected an id or null", "tell the decision");
  }
  plane.map_plane = optional.Integer("map_plane");
  plane.decision =
      ReadWord(record, "decision", {"matched", "new", "none"}, Severity::kFatal).value_or("");
  plane.by = (record.Contains("by") ? optional : record.Expected()).Text("by");
  return plane;
}

RunFrame ReadFrame(const JsonRecord& root) {
  RunFrame frame;
  frame.line = root.line();
  std::set<int> indices;
  for (const JsonRecord& record : root.Items("planes")) {
    frame.planes.push_back(ReadFramePlane(record));
    const int index = frame.planes.back().index;
    if (index < 0 || indices.insert(index).second) continue;
    record.TellAt("index", fmt::format("{} is used a second time", index),
                  "give every plane of a frame its own index");
  }
  return frame;
}

}  // namespace

std::vector<RunFrame> ReadRunFrames(Folder& folder) {
  const std::string file = "frame_planes.jsonl";
  std::vector<RunFrame> frames;
  StampOrder order(folder, file);
  VisitJsonLines(folder, file, [&](const JsonRecord& root) {
    const auto stamp_s = root.Number("timestamp");
    RunFrame frame = ReadFrame(root);
    if (!stamp_s) return;
    order.Next(*stamp_s, root.line());
    frame.stamp_s = *stamp_s;
    frames.push_back(std::move(frame));
  });
  order.Finish();
  if (frames.empty()) {
    folder.Tell(file, 0, "holds no frame", "write a line for each frame, or remove the file");
  }
  std::stable_sort(frames.begin(), frames.end(),
                   [](const RunFrame& a, const RunFrame& b) { return a.stamp_s < b.stamp_s; });
  return frames;
}

}  // namespace eval
