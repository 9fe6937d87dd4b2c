#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/formats/json_record.h"
#include "eval/formats/plane.h"

namespace eval {

/// A printed unit normal is of length 1 to this much; a reader normalises it.
inline constexpr double kRunUnit = 1e-4;    // a run may be printed with few digits
inline constexpr double kTruthUnit = 1e-6;  // the truth round-trips, or has six decimals

/// Reads the normal and offset of a plane. Nothing is returned when they are at fault.
std::optional<Plane> ReadPlane(const JsonRecord& record, double unit_tolerance);

/// Reads a list of points that lie on the plane. That there is no list, or a point beside the plane,
/// is a warning: corners and outlines are in figures.
/// @param pi  nothing when it is at fault
std::vector<Eigen::Vector3d> ReadPointsOnPlane(const JsonRecord& record, const std::string& key,
                                               const std::optional<Plane>& pi);

}  // namespace eval
