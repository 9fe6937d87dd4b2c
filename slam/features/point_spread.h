#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

namespace slam {

/// Chooses about `count` of the candidates, spread evenly over `area`: the area is quartered,
/// the fullest cells first, until there are as many occupied cells as points wanted; the
/// strongest candidate of each cell stays. Order of the result and ties depend on the input's
/// order alone.
/// @param candidates  corners with `response`, inside `area`; pixels of one octave
/// @param count  number wanted; the result has at most count + 2, fewer when candidates are few
std::vector<cv::KeyPoint> SpreadEvenly(const std::vector<cv::KeyPoint>& candidates,
                                       const cv::Rect& area, int count);

}  // namespace slam
