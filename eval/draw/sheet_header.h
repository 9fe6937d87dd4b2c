#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "eval/draw/legend.h"
#include "eval/draw/run_title.h"
#include "eval/formats/run/run.h"

namespace eval {

/// What stands above the frames of a contact sheet.
struct SheetHeader {
  RunTitle title;
  std::string figures;  ///< of the run, in one line
  std::vector<LegendItem> legend;
  std::string note;  ///< how to get a picture that shows more; or empty
  double width_px = 0;
};
SheetHeader HeaderOf(const RunTitle& title, const Run& run, double width_px);
double HeightOf(const SheetHeader& header);
void PutHeader(cv::Mat& page, const SheetHeader& header, cv::Point2d corner);

/// Says that outlines stand for segments, and how to have segments.
inline constexpr const char* kNoSegmentationNote =
    "outlines only: the run saved no segmentation; `pas slam --save-segmentation` does";

}  // namespace eval
