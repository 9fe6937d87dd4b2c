#pragma once

#include <vector>

#include "eval/surfaces/sheet.h"

namespace eval {

/// Cells of one sheet that are one surface, CV_8U of the sheet's size.
using CellMask = cv::Mat1b;

/// Parts a sheet where it steps and where it was seen to be empty.
///
/// A bend of the device is smooth, the edge of a thing is not: cells that differ from one two
/// cells further by more than DepthError::OfStep_m are edges. What edges enclose belongs
/// together when its heights agree where it meets; parts with nothing but hidden or unseen cells
/// between them are one surface, parts with cells between them that rays passed through, or ended
/// on something lower, are not.
/// @param noise_per_m  of one pixel's inverse depth
/// @returns masks of at least min_area_m2
std::vector<CellMask> CutSheet(const Sheet& sheet, double min_area_m2, double noise_per_m);

}  // namespace eval
