#include "eval/check/check_frame_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/check/checked_text.h"

namespace eval {
namespace {

const std::string kFile = "frame_planes.jsonl";

// Reports a word that is none of `allowed`; null is good when `may_be_null`.
std::optional<std::string> CheckWord(const CheckedJson& plane, const std::string& key,
                                     const std::vector<std::string>& allowed,
                                     bool may_be_null) {
  if (may_be_null && plane.Contains(key) && !plane.Has(key)) return std::nullopt;
  const auto word = plane.Text(key);
  if (!word || std::find(allowed.begin(), allowed.end(), *word) != allowed.end()) return word;
  std::string list;
  for (const std::string& one : allowed) list += (list.empty() ? "" : ", ") + one;
  plane.ReportAt(key, "is " + *word, "use one of: " + list + (may_be_null ? ", null" : ""));
  return std::nullopt;
}

void CheckFigures(const CheckedJson& plane) {
  const auto pixels = plane.Integer("pixels");
  if (pixels && *pixels < 1) {
    plane.ReportAt("pixels", fmt::format("is {}; expected 1 or more", *pixels),
                   "count the pixels of the segment");
  }
  const auto ratio = plane.Number("inlier_ratio");
  if (ratio && !(*ratio >= 0 && *ratio <= 1)) {
    plane.ReportAt("inlier_ratio", fmt::format("is {}; expected 0 to 1", *ratio),
                   "divide inliers by all points");
  }
  if (plane.Has("class")) plane.Text("class");
  if (plane.Has("detection")) {
    const auto detection = plane.Integer("detection");
    if (detection && *detection < 0) plane.ReportAt("detection", "is negative", "count from 0");
  }
}

void CheckLines(const CheckedJson& plane) {
  for (const CheckedJson& line : plane.Items("lines")) {
    const std::vector<CheckedJson> ends = line.AsItems();
    if (ends.size() != 2) {
      line.Report("is not a pair [P, V]", "write a point and a direction");
      continue;
    }
    ends[0].AsNumbers(3);
    const auto V = ends[1].AsNumbers(3);
    if (V && !(std::hypot((*V)[0], (*V)[1], (*V)[2]) > 0)) {
      ends[1].Report("has no direction", "write a direction that is not zero");
    }
  }
}

void CheckGeometry(const CheckedJson& plane) {
  auto pi = CheckPlaneParameters(plane);
  if (pi && !(pi->d > 0)) {
    plane.ReportAt("d", fmt::format("is {}; a plane that the camera sees has d > 0", pi->d),
                   "turn the normal and d around, so that the normal faces the camera");
    pi.reset();
  }
  if (const auto centroid = plane.Numbers("centroid", 3)) {
    if (!((*centroid)[2] > 0)) {
      plane.ReportAt("centroid", "is behind the camera",
                     "write it in the camera frame, z ahead");
    }
  }
  CheckLines(plane);
  CheckPointsOnPlane(plane, "vertices", pi);
}

/// Follows which map planes exist when a frame decides.
class DecisionCheck {
 public:
  explicit DecisionCheck(const CheckedMap& map) : map_(map) {}

  void Plane(const CheckedJson& plane) {
    const auto decision = CheckWord(plane, "decision", {"matched", "new", "none"}, false);
    if (plane.Has("by")) plane.Text("by");
    std::optional<long> id;
    if (plane.Has("map_plane")) id = plane.Integer("map_plane");
    if (id && map_.read && map_.ids.count(*id) == 0) {
      plane.ReportAt("map_plane", fmt::format("is {}, which is no plane of map.json", *id),
                     "keep merged planes in the map, with merged_into");
      return;
    }
    if (!decision) return;
    if (!plane.Has("map_plane") && *decision != "none") {
      plane.ReportAt("map_plane", "is null, but the decision is " + *decision,
                     "name the map plane that was " +
                         std::string(*decision == "new" ? "made" : "matched"));
    } else if (id && *decision != "none") {
      Follow(plane, *decision, *id);
    }
  }

  /// Decisions of a frame are made at once, so what is new in it can be matched only later.
  void EndOfFrame() {
    for (const long id : made_now_) made_.insert(id);
    made_now_.clear();
  }

 private:
  void Follow(const CheckedJson& plane, const std::string& decision, long id) {
    const bool known = made_.count(id) != 0;
    if (decision == "new") {
      if (known || made_now_.count(id) != 0) {
        plane.ReportAt("decision",
                       fmt::format("is new, but map plane {} has been made before", id),
                       "write each decision as it was made at that frame");
      }
      made_now_.insert(id);
    } else if (!known && unmade_.insert(id).second) {
      plane.ReportAt("decision",
                     fmt::format("is matched, but no earlier frame made map plane {}", id),
                     "write the frame that makes a map plane as new");
    }
  }

  const CheckedMap& map_;
  std::set<long> made_, made_now_;
  std::set<long> unmade_;  ///< reported already
};

std::set<long> CheckPlanesOfFrame(const CheckedJson& record, DecisionCheck& decisions) {
  std::set<long> indices;
  for (const CheckedJson& plane : record.Items("planes")) {
    const auto index = plane.Integer("index");
    if (index && (*index < 0 || *index > 254)) {
      plane.ReportAt("index", fmt::format("is {}; expected 0 to 254", *index),
                     "number the planes of a frame from 0");
    } else if (index && !indices.insert(*index).second) {
      plane.ReportAt("index", fmt::format("{} is used a second time", *index),
                     "give every plane of a frame its own index");
    }
    CheckGeometry(plane);
    CheckFigures(plane);
    CheckWord(plane, "bad", {"far", "inliers", "border", "structure", "unstructured"}, true);
    decisions.Plane(plane);
  }
  decisions.EndOfFrame();
  return indices;
}

}  // namespace

FramePlaneCounts CheckFramePlanes(FolderCheck& check, const CheckedMap& map) {
  FramePlaneCounts counts;
  if (!check.Require(kFile, "run the SLAM system again")) return counts;
  DecisionCheck decisions(map);
  StampOrder order(check, kFile);
  std::map<double, std::set<long>> frames;
  VisitJsonLines(check, kFile, [&](const CheckedJson& record, int line) {
    const auto stamp = record.Number("timestamp");
    if (stamp) order.Next(*stamp, line);
    const std::set<long> indices = CheckPlanesOfFrame(record, decisions);
    if (stamp) frames[*stamp] = indices;
  });
  order.Finish();
  for (const auto& [stamp, indices] : frames) {
    counts.stamps_s.push_back(stamp);
    counts.indices.push_back(indices);
  }
  return counts;
}

}  // namespace eval
