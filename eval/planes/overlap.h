#pragma once

#include <map>
#include <opencv2/core.hpp>

namespace eval {

/// Shared pixels of two label images; label 0 means none and is not a region.
struct Overlap {
  std::map<int, long long> truth_pixels, machine_pixels;  ///< sizes of the regions
  std::map<int, std::map<int, long long>> shared;         ///< [truth][machine], both not 0

  long long Shared(int truth, int machine) const;
  double IoU(int truth, int machine) const;
};

/// @throws std::invalid_argument if the images differ in size.
Overlap CountOverlap(const cv::Mat1w& truth, const cv::Mat1w& machine);

}  // namespace eval
