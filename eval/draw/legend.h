#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "eval/draw/paint.h"

namespace eval {

/// An entry of a legend: a sample and what it means.
struct LegendItem {
  double sample_px = 0;  ///< width of the sample
  std::string text;
  /// Paints the sample; `left` is its left end at half the height of the text.
  std::function<void(cv::Mat& page, cv::Point2d left)> paint;
};

/// Where the items begin (left end, base line) from (0, 0) on when they are set in rows that
/// are `width_px` wide.
std::vector<cv::Point2d> FlowLegend(const std::vector<LegendItem>& items,
                                    const TextStyle& style, double width_px);
/// Height of the rows in pixels.
double LegendHeight(const std::vector<LegendItem>& items, const TextStyle& style,
                    double width_px);
/// Paints the rows from `corner`, their upper left corner, on.
void PutLegend(cv::Mat& page, const std::vector<LegendItem>& items, const TextStyle& style,
               cv::Point2d corner, double width_px);

}  // namespace eval
