#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <utility>

namespace eval {

/// Shared pixels of two label images; label 0 means none and is not a region.
struct Overlap {
  std::map<int, long long> truth_pixels, machine_pixels;  ///< sizes of the regions
  std::map<int, std::map<int, long long>> shared;         ///< [truth][machine], both not 0

  long long Shared(int truth, int machine) const;
  double IoU(int truth, int machine) const;
};

/// Pixels of each pair (truth, machine) of labels, 0 among them.
using LabelPairs = std::map<std::pair<int, int>, long long>;
/// @throws std::invalid_argument if the images differ in size.
LabelPairs CountPairs(const cv::Mat1w& truth, const cv::Mat1w& machine);
Overlap OverlapOf(const LabelPairs& pairs);

/// @throws std::invalid_argument if the images differ in size.
Overlap CountOverlap(const cv::Mat1w& truth, const cv::Mat1w& machine);

}  // namespace eval
