#pragma once

#include <set>
#include <string>

#include "eval/check/checked_json.h"
#include "eval/check/fault.h"

namespace eval {

/// The ids of map.json.
struct CheckedMap {
  bool read = false;  ///< false: the file is missing or broken, so nothing is known of ids
  std::set<long> ids;
};

/// Checks map.json: ids, unit normals, corners and hulls on their plane, targets of merges.
CheckedMap CheckMap(FolderCheck& check);

/// Checks a unit normal and an offset. @returns n and d, or nothing after a fault
struct CheckedPlane {
  double nx, ny, nz, d;
  double Distance(const std::vector<double>& x) const {
    return nx * x[0] + ny * x[1] + nz * x[2] + d;
  }
};
std::optional<CheckedPlane> CheckPlaneParameters(const CheckedJson& plane);

/// Checks that a list of points lies on its plane, up to what an estimate may be off.
void CheckPointsOnPlane(const CheckedJson& record, const std::string& key,
                        const std::optional<CheckedPlane>& pi);

}  // namespace eval
