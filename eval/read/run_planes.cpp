#include "eval/read/run_planes.h"

#include <algorithm>
#include <cmath>

#include "io/input_error.h"
#include "io/json_field.h"

namespace eval {
namespace {

constexpr double kUnitTolerance = 1e-6;
constexpr int kMaxPlanes = 255;  // of a frame: a segmentation has 8 bits and 0 means none

Plane ReadPlane(const io::JsonField& field) {
  Plane pi{field["normal"].Vector3(), field["d"].Number()};
  if (!(std::abs(pi.n.norm() - 1.0) <= kUnitTolerance)) field["normal"].Fail("a unit normal");
  pi.n.normalize();
  return pi;
}

std::optional<std::string> OptionalText(const io::JsonField& field, const char* key) {
  const auto found = field.Find(key);
  return found ? std::optional(found->Text()) : std::nullopt;
}
std::optional<int> OptionalInteger(const io::JsonField& field, const char* key) {
  const auto found = field.Find(key);
  return found ? std::optional(found->Integer()) : std::nullopt;
}
std::optional<double> OptionalNumber(const io::JsonField& field, const char* key) {
  const auto found = field.Find(key);
  return found ? std::optional(found->Number()) : std::nullopt;
}
std::vector<Eigen::Vector3d> OptionalPoints(const io::JsonField& field, const char* key) {
  const auto found = field.Find(key);
  return found ? found->Points() : std::vector<Eigen::Vector3d>{};
}

RunFramePlane ReadFramePlane(const io::JsonField& field) {
  RunFramePlane plane;
  plane.index = field["index"].Integer();
  if (plane.index < 0 || plane.index >= kMaxPlanes)
    field["index"].Fail("an index from 0 to 254");
  plane.pi_c = ReadPlane(field);
  plane.centroid_c = field["centroid"].Vector3();
  plane.pixels = field["pixels"].Integer();
  plane.inlier_ratio = OptionalNumber(field, "inlier_ratio");
  plane.plane_class = OptionalText(field, "class");
  plane.detection = OptionalInteger(field, "detection");
  plane.bad = OptionalText(field, "bad");
  plane.vertices_c = OptionalPoints(field, "vertices");
  if (const auto lines = field.Find("lines")) {
    for (const io::JsonField& line : lines->Elements()) {
      const std::vector<Eigen::Vector3d> point_and_direction = line.Points();
      if (point_and_direction.size() != 2) line.Fail("a point and a direction [[..], [..]]");
      plane.lines_c.push_back({point_and_direction[0], point_and_direction[1]});
    }
  }
  if (!field["map_plane"].IsNull()) plane.map_plane = field["map_plane"].Integer();
  plane.decision = field["decision"].Text();
  if (plane.decision != "matched" && plane.decision != "new" && plane.decision != "none") {
    field["decision"].Fail("matched, new or none");
  }
  plane.by = OptionalText(field, "by");
  return plane;
}

}  // namespace

std::vector<RunFrame> ReadRunFrames(const std::filesystem::path& file) {
  std::vector<RunFrame> frames;
  io::ForEachJsonLine(file, "", [&](const io::JsonField& root) {
    RunFrame frame;
    frame.stamp_s = root["timestamp"].Number();
    for (const io::JsonField& field : root["planes"].Elements()) {
      frame.planes.push_back(ReadFramePlane(field));
    }
    frames.push_back(std::move(frame));
  });
  std::stable_sort(frames.begin(), frames.end(),
                   [](const RunFrame& a, const RunFrame& b) { return a.stamp_s < b.stamp_s; });
  return frames;
}

std::vector<RunMapPlane> ReadRunMap(const std::filesystem::path& file) {
  const nlohmann::json json = io::ReadJson(file);
  std::vector<RunMapPlane> planes;
  for (const io::JsonField& field : io::JsonField(json, file.string())["planes"].Elements()) {
    RunMapPlane plane;
    plane.id = field["id"].Integer();
    plane.plane_class = OptionalText(field, "class");
    plane.pi_w = ReadPlane(field);
    plane.area_m2 = OptionalNumber(field, "area").value_or(0.0);
    plane.observations = OptionalInteger(field, "observations").value_or(0);
    plane.first_seen = OptionalNumber(field, "first_seen");
    plane.last_seen = OptionalNumber(field, "last_seen");
    plane.merged_into = OptionalInteger(field, "merged_into");
    plane.vertices_w = OptionalPoints(field, "vertices");
    plane.hull_w = OptionalPoints(field, "hull");
    planes.push_back(std::move(plane));
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const RunMapPlane& a, const RunMapPlane& b) { return a.id < b.id; });
  const auto twice = std::adjacent_find(
      planes.begin(), planes.end(), [](const auto& a, const auto& b) { return a.id == b.id; });
  if (twice != planes.end()) {
    throw io::InputError(file.string(), "plane id " + std::to_string(twice->id) +
                                            " stands twice; ids must differ");
  }
  return planes;
}

}  // namespace eval
