#include "eval/check/check_map.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace eval {
namespace {

const std::string kFile = "map.json";
constexpr double kUnit = 1e-4;  // a run may be printed with few digits
// Corners and hull points are averages and measurements: a sensor at 3 m is off by 15 mm (one
// sigma). What is beyond is in another frame or belongs to another plane.
constexpr double kOffPlane_m = 0.10;

void CheckMapPlane(const CheckedJson& plane) {
  const auto pi = CheckPlaneParameters(plane);
  if (plane.Contains("class") && plane.Has("class")) plane.Text("class");
  const auto area = plane.Number("area");
  if (area && !(*area >= 0)) plane.ReportAt("area", "is negative", "give it in m^2");
  const auto observations = plane.Integer("observations");
  if (observations && *observations < 1) {
    plane.ReportAt("observations", fmt::format("is {}; expected 1 or more", *observations),
                   "count the frames that saw the plane");
  }
  const auto first = plane.Number("first_seen");
  const auto last = plane.Number("last_seen");
  if (first && last && !(*first <= *last)) {
    plane.ReportAt("first_seen", "is later than last_seen", "write times in seconds, in order");
  }
  CheckPointsOnPlane(plane, "vertices", pi);
  CheckPointsOnPlane(plane, "hull", pi);
}

// Follows merges to the plane that is left; a circle leaves none.
void CheckMerges(const std::vector<std::pair<long, CheckedJson>>& planes,
                 const std::map<long, long>& merged_into, const std::set<long>& ids) {
  for (const auto& [id, plane] : planes) {
    const auto target = merged_into.find(id);
    if (target == merged_into.end()) continue;
    if (ids.count(target->second) == 0) {
      plane.ReportAt("merged_into",
                     fmt::format("is {}, which is no plane of the map", target->second),
                     "name the plane that took this one in, and keep it in the map");
      continue;
    }
    long at = target->second;
    for (std::size_t steps = 0; at != id && steps <= planes.size(); ++steps) {
      const auto next = merged_into.find(at);
      if (next == merged_into.end()) break;
      at = next->second;
    }
    if (at == id) {
      plane.ReportAt("merged_into", "leads back to the plane itself",
                     "merge into a plane that is left");
    }
  }
}

}  // namespace

std::optional<CheckedPlane> CheckPlaneParameters(const CheckedJson& plane) {
  const auto n = plane.Numbers("normal", 3);
  const auto d = plane.Number("d");
  if (!n || !d) return std::nullopt;
  const double length = std::hypot((*n)[0], (*n)[1], (*n)[2]);
  if (!(std::abs(length - 1) <= kUnit)) {
    plane.ReportAt("normal", fmt::format("has length {:.6f}; expected 1", length),
                   "normalise the normal and divide d by the same length");
    return std::nullopt;
  }
  return CheckedPlane{(*n)[0], (*n)[1], (*n)[2], *d};
}

void CheckPointsOnPlane(const CheckedJson& record, const std::string& key,
                        const std::optional<CheckedPlane>& pi) {
  const std::vector<CheckedJson> points = record.Items(key);
  for (const CheckedJson& point : points) {
    const auto x = point.AsNumbers(3);
    if (!x || !pi) continue;
    const double off = pi->Distance(*x);
    if (std::abs(off) <= kOffPlane_m) continue;
    point.Report(fmt::format("is {:.3f} m off its plane n . x + d = 0", off),
                 "write points and plane in one frame, n . x + d = 0");
  }
}

CheckedMap CheckMap(FolderCheck& check) {
  CheckedMap map;
  if (!check.Require(kFile, "run the SLAM system again")) return map;
  VisitJson(check, kFile, [&](const CheckedJson& root) {
    if (!root.Has("planes")) {
      root.ReportAt("planes", "is missing; expected a list", "write the planes of the map");
      return;
    }
    map.read = true;
    std::map<long, long> merged_into;
    std::vector<std::pair<long, CheckedJson>> planes;
    for (const CheckedJson& plane : root.Items("planes")) {
      CheckMapPlane(plane);
      const auto id = plane.Integer("id");
      if (!id) continue;
      if (*id < 0) plane.ReportAt("id", "is negative", "number the planes from 0");
      if (!map.ids.insert(*id).second) {
        plane.ReportAt("id", fmt::format("{} is used a second time", *id),
                       "give every plane its own id");
        continue;
      }
      planes.emplace_back(*id, plane);
      if (!plane.Has("merged_into")) continue;
      if (const auto target = plane.Integer("merged_into")) merged_into[*id] = *target;
    }
    CheckMerges(planes, merged_into, map.ids);
  });
  return map;
}

}  // namespace eval
