#include "eval/draw/legend.h"

namespace eval {
namespace {

constexpr double kBeforeText_px = 8, kBetweenItems_px = 30, kRow_px = 26, kBaseLine_px = 18;

double WidthOf(const LegendItem& item, const TextStyle& style) {
  return item.sample_px + kBeforeText_px + TextWidth(item.text, style);
}

}  // namespace

std::vector<cv::Point2d> FlowLegend(const std::vector<LegendItem>& items,
                                    const TextStyle& style, double width_px) {
  std::vector<cv::Point2d> places;
  cv::Point2d at(0, kBaseLine_px);
  for (const LegendItem& item : items) {
    const double width = WidthOf(item, style);
    if (at.x > 0 && at.x + width > width_px) at = {0, at.y + kRow_px};
    places.push_back(at);
    at.x += width + kBetweenItems_px;
  }
  return places;
}

double LegendHeight(const std::vector<LegendItem>& items, const TextStyle& style,
                    double width_px) {
  const auto places = FlowLegend(items, style, width_px);
  return places.empty() ? 0 : places.back().y - kBaseLine_px + kRow_px;
}

void PutLegend(cv::Mat& page, const std::vector<LegendItem>& items, const TextStyle& style,
               cv::Point2d corner, double width_px) {
  const auto places = FlowLegend(items, style, width_px);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const cv::Point2d at = corner + places[i];
    items[i].paint(page, at - cv::Point2d(0, style.height_px / 2));
    PutText(page, items[i].text, at + cv::Point2d(items[i].sample_px + kBeforeText_px, 0),
            style);
  }
}

}  // namespace eval
