#include "eval/draw/sheet_header.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/draw/plane_name.h"

namespace eval {
namespace {

const Colour kPaleText{215, 208, 202}, kWarningText{90, 110, 255}, kChipGround{28, 24, 22};
constexpr double kTitle_px = 15, kTitleLine_px = 32, kFiguresLine_px = 26, kNoteLine_px = 24;
const TextStyle kLegendStyle{10.5, kPaleText, false, Align::kLeft};

LegendItem DotItem(DecisionMark mark) {
  return {11, Meaning(mark), [mark](cv::Mat& page, cv::Point2d left) {
            PutDot(page, left + cv::Point2d(5.5, 0), 5, ColourOf(mark));
          }};
}

LegendItem ChipItem() {
  return {
      72, "plane 3 of the map, a book; its colour is the same in every picture",
      [](cv::Mat& page, cv::Point2d left) {
        const auto box = [&](double x1) {
          return std::vector<cv::Point2d>{
              left + cv::Point2d(0, -10), left + cv::Point2d(x1, -10),
              left + cv::Point2d(x1, 10), left + cv::Point2d(0, 10)};
        };
        FillArea(page, box(72), kChipGround, 1.0);
        PutPath(page, box(72), true, kPaleText);
        FillArea(page, box(5), ColourOfPlane(3), 1.0);
        PutText(page, "3 book", left + cv::Point2d(14, 5), {10, kWhite, false, Align::kLeft});
      }};
}

LegendItem VertexItem() {
  return {10, "vertex", [](cv::Mat& page, cv::Point2d left) {
            PutRingedDot(page, left + cv::Point2d(5, 0), 4.6, ColourOfPlane(3), kBlack);
            PutDot(page, left + cv::Point2d(5, 0), 1.4, kWhite);
          }};
}

LegendItem LineItem(const char* text, const Colour& colour, bool haloed, int width_px) {
  return {30, text, [=](cv::Mat& page, cv::Point2d left) {
            const std::vector<cv::Point2d> line{left, left + cv::Point2d(30, 0)};
            if (haloed) {
              PutHaloedPath(page, line, false, colour, width_px);
            } else {
              PutPath(page, line, false, colour, width_px);
            }
          }};
}

std::vector<LegendItem> LegendOf(bool segmented) {
  std::vector<LegendItem> items{ChipItem()};
  for (const DecisionMark mark :
       {DecisionMark::kMatched, DecisionMark::kNew, DecisionMark::kBad, DecisionMark::kOpen}) {
    items.push_back(DotItem(mark));
  }
  if (segmented) {
    items.push_back(LineItem("edge line", kWhite, false, 1));
    items.push_back(LineItem("face from four vertices", kWhite, true, 1));
  } else {
    items.push_back(
        LineItem("outline: face from four vertices, else all that was ever seen of the plane",
                 ColourOfPlane(3), true, 2));
  }
  items.push_back(VertexItem());
  return items;
}

}  // namespace

SheetHeader HeaderOf(const RunTitle& title, const Run& run, double width_px) {
  const auto planes = std::count_if(run.map.begin(), run.map.end(), [](const auto& plane) {
    return !plane.merged_into.has_value();
  });
  const bool segmented = !run.segmentation_files.empty();
  const bool drawn = !run.frames.empty();
  return {title, fmt::format("{}   {} map planes", title.figures, planes),
          drawn ? LegendOf(segmented) : std::vector<LegendItem>{},
          drawn && !segmented ? kNoSegmentationNote : "", width_px};
}

double HeightOf(const SheetHeader& header) {
  return kTitleLine_px + kFiguresLine_px +
         LegendHeight(header.legend, kLegendStyle, header.width_px) +
         (header.note.empty() ? 0 : kNoteLine_px);
}

void PutHeader(cv::Mat& page, const SheetHeader& header, cv::Point2d corner) {
  const TextStyle bold{kTitle_px, kWhite, true, Align::kLeft};
  const TextStyle warning{kTitle_px, kWarningText, true, Align::kLeft};
  const double warning_width =
      header.title.warning.empty() ? 0 : TextWidth(header.title.warning, warning) + 24;
  const std::string name = Fitted(header.title.run + "  on  " + header.title.sequence, bold,
                                  std::max(100.0, header.width_px - warning_width));
  cv::Point2d at = corner + cv::Point2d(0, kTitle_px + 5);
  PutText(page, name, at, bold);
  PutText(page, header.title.warning, at + cv::Point2d(TextWidth(name, bold) + 24, 0), warning);
  at.y += kFiguresLine_px;
  PutText(page, Fitted(header.figures, kLegendStyle, header.width_px), at, kLegendStyle);
  at = corner + cv::Point2d(0, kTitleLine_px + kFiguresLine_px);
  PutLegend(page, header.legend, kLegendStyle, at, header.width_px);
  at.y += LegendHeight(header.legend, kLegendStyle, header.width_px);
  PutText(page, header.note, at + cv::Point2d(0, 16),
          {10.5, Colour(110, 200, 255), false, Align::kLeft});
}

}  // namespace eval
