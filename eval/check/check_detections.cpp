#include "eval/check/check_detections.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/check/checked_text.h"

namespace eval {
namespace {

void CheckDetection(const CheckedJson& detection, cv::Size size) {
  detection.Text("class");
  const auto score = detection.Number("score");
  if (score && !(*score >= 0 && *score <= 1)) {
    detection.ReportAt("score", fmt::format("is {}; expected 0 to 1", *score),
                       "write it as a probability");
  }
  CheckBox(detection, "box", size, false);
}

}  // namespace

bool CheckBox(const CheckedJson& record, const std::string& key, cv::Size size,
              bool may_be_thin) {
  const auto box = record.Numbers(key, 4);
  if (!box) return false;
  const double x0 = (*box)[0], y0 = (*box)[1], x1 = (*box)[2], y1 = (*box)[3];
  const bool ordered = may_be_thin ? x0 <= x1 && y0 <= y1 : x0 < x1 && y0 < y1;
  if (!ordered) {
    record.ReportAt(
        key,
        fmt::format("[{}, {}, {}, {}] is not [x0, y0, x1, y1] with x0 < x1, y0 < y1", x0, y0,
                    x1, y1),
        "write the upper left corner first, not a width and height");
    return false;
  }
  // Pixel centres are whole, so the image reaches from -0.5 to size - 0.5; a box may as well be
  // given by pixel edges, 0 to size.
  const bool inside =
      size.empty() || (x0 >= -0.5 && y0 >= -0.5 && x1 <= size.width && y1 <= size.height);
  if (inside) return true;
  record.ReportAt(key,
                  fmt::format("[{}, {}, {}, {}] leaves the image of {} x {} pixels", x0, y0, x1,
                              y1, size.width, size.height),
                  "clip the box to the image");
  return false;
}

void CheckDetections(FolderCheck& check, const std::vector<ListedImage>& rgb, cv::Size size) {
  const std::string file = "detections.jsonl";
  if (!check.Has(file)) return;
  std::vector<double> stamps;
  for (const ListedImage& image : rgb) stamps.push_back(image.stamp_s);
  std::sort(stamps.begin(), stamps.end());
  StampOrder order(check, file);
  VisitJsonLines(check, file, [&](const CheckedJson& record, int line) {
    if (const auto stamp = record.Number("timestamp")) {
      order.Next(*stamp, line);
      if (!NearestStamp(stamps, *stamp, kSameInstant_s)) {
        record.ReportAt("timestamp", fmt::format("{:.6f} is no time of rgb.txt", *stamp),
                        "use the time of the colour image the detections were made on");
      }
    }
    for (const CheckedJson& detection : record.Items("detections")) {
      CheckDetection(detection, size);
    }
  });
  order.Finish();
}

}  // namespace eval
