#include "eval/formats/run/run_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "eval/formats/covariance.h"
#include "eval/formats/plane_record.h"

namespace eval {
namespace {

/// Rank is not asked: three of the four directions have a variance, none a negative one.
std::optional<Eigen::Matrix4d> ReadCovariance(const JsonRecord& record) {
  if (!record.Has("covariance")) return std::nullopt;
  const auto v = record.Numbers("covariance", 10);
  if (!v) return std::nullopt;
  Eigen::Matrix4d C;
  std::size_t next = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) C(i, j) = C(j, i) = (*v)[next++];
  }
  if (IsCovariance(C)) return C;
  record.TellAt("covariance", "is none: some direction has a negative variance",
                "write the upper triangle of that of (n, d) row by row");
  return std::nullopt;
}

RunMapPlane ReadMapPlane(const JsonRecord& record) {
  const JsonRecord expected = record.Expected(), optional = record.Optional();
  const JsonRecord extra = record.Extra();
  RunMapPlane plane;
  plane.plane_class = optional.Text("class");
  const auto pi_w = ReadPlane(record, kRunUnit);
  if (pi_w) plane.pi_w = *pi_w;
  plane.covariance = ReadCovariance(extra);
  plane.area_m2 = expected.Number("area", io::Interval("[0, 1e14)")).value_or(0.0);
  plane.observations = expected.Integer("observations", 1).value_or(0);
  const io::Interval seconds("[0, 1e11)");  // as stamps are
  const auto first_seen = expected.Number("first_seen", seconds);
  const auto last_seen = expected.Number("last_seen", seconds);
  if (first_seen && last_seen && !(*first_seen <= *last_seen)) {
    record.TellAt("first_seen", "is later than last_seen", "write times in seconds, in order",
                  Severity::kFlaw);
  }
  plane.merged_into = optional.Integer("merged_into");
  plane.split_from = extra.Integer("split_from");
  extra.Number("split_at", seconds);  // in no figure; a wrong one is told
  plane.vertices_w = ReadPointsOnPlane(record, "vertices", pi_w);
  plane.hull_w = ReadPointsOnPlane(record, "hull", pi_w);
  return plane;
}

/// Planes that name another one: [id] its id.
using Links = std::map<int, int>;

/// Whether following the links from a plane leads back to it.
bool LeadsBack(int id, const Links& links) {
  auto next = links.find(id);
  for (std::size_t steps = 0; steps <= links.size(); ++steps) {
    if (next == links.end()) return false;
    if (next->second == id) return true;
    next = links.find(next->second);
  }
  return false;
}

class MapReader {
 public:
  std::vector<RunMapPlane> Read(const JsonRecord& root) {
    for (const JsonRecord& record : root.Items("planes")) Add(record);
    // Merges lead to a plane that is left, splits to one that was there before.
    for (RunMapPlane& plane : planes_) {
      Leads(plane.id, "merged_into", merged_into_,
            "name the plane that took this one in, and keep it in the map",
            "merge into a plane that is left", Severity::kFatal);
      // The format does not know of splits: to another program the key may be anything.
      if (!Leads(plane.id, "split_from", split_from_,
                 "name the plane that this one was split from, and keep it in the map",
                 "name the plane that held both", Severity::kWarning)) {
        plane.split_from.reset();
      }
    }
    TellMissingCovariances();
    std::sort(planes_.begin(), planes_.end(),
              [](const RunMapPlane& a, const RunMapPlane& b) { return a.id < b.id; });
    return std::move(planes_);
  }

 private:
  void Add(const JsonRecord& record) {
    RunMapPlane plane = ReadMapPlane(record);
    const auto id = record.Integer("id", 0);
    if (!id) return;
    if (!records_.emplace(*id, record).second) {
      record.TellAt("id", fmt::format("{} is used a second time", *id),
                    "give every plane its own id");
      return;
    }
    plane.id = *id;
    if (plane.merged_into) merged_into_[*id] = *plane.merged_into;
    if (plane.split_from) split_from_[*id] = *plane.split_from;
    planes_.push_back(std::move(plane));
  }

  // Planes without one are left out of what is said of the others.
  void TellMissingCovariances() const {
    const auto has = [](const auto& plane) { return plane.second.Has("covariance"); };
    if (std::none_of(records_.begin(), records_.end(), has)) return;
    for (const auto& plane : records_) {
      if (has(plane)) continue;
      plane.second.TellAt("covariance", "is missing, and other planes have one",
                          "tell that of every plane, or of none", Severity::kWarning);
    }
  }

  // A link names a plane of the map; a circle of links has no first.
  bool Leads(int id, const char* key, const Links& links, const char* how_to_name,
             const char* how_to_lead, Severity severity) const {
    const auto target = links.find(id);
    if (target == links.end()) return true;
    const JsonRecord& record = records_.at(id);
    if (records_.count(target->second) == 0) {
      record.TellAt(key, fmt::format("is {}, which is no plane of the map", target->second),
                    how_to_name, severity);
    } else if (LeadsBack(id, links)) {
      record.TellAt(key, "leads back to the plane itself", how_to_lead, severity);
    } else {
      return true;
    }
    return false;
  }

  std::vector<RunMapPlane> planes_;
  std::map<int, JsonRecord> records_;
  Links merged_into_, split_from_;
};

}  // namespace

std::optional<std::vector<RunMapPlane>> ReadRunMap(Folder& folder) {
  std::optional<std::vector<RunMapPlane>> planes;
  VisitJson(folder, "map.json", [&](const JsonRecord& root) {
    const bool listed = root.Has("planes");
    std::vector<RunMapPlane> read = MapReader().Read(root);
    if (listed) planes = std::move(read);
  });
  return planes;
}

}  // namespace eval
