#include "eval/check/check_detections.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/formats/sequence/box.h"
#include "eval/formats/stamps.h"

namespace eval {

void CheckDetections(Folder& folder, const std::vector<ListedImage>& rgb, cv::Size size) {
  const std::string file = "detections.jsonl";
  if (!folder.Has(file)) return;
  std::vector<double> stamps_s = StampsOf(rgb);
  std::sort(stamps_s.begin(), stamps_s.end());
  StampOrder order(folder, file);
  VisitJsonLines(folder, file, [&](const JsonRecord& record) {
    if (const auto stamp_s = record.Number("timestamp")) {
      order.Next(*stamp_s, record.line());
      if (!NearestStamp(stamps_s, *stamp_s, kSameInstant_s)) {
        record.TellAt("timestamp", fmt::format("{:.6f} is no time of rgb.txt", *stamp_s),
                      "use the time of the colour image the detections were made on");
      }
    }
    for (const JsonRecord& detection : record.Items("detections")) {
      detection.Text("class");
      detection.Number("score", io::Interval("[0, 1]"));
      ReadBox(detection, "box", size, false);
    }
  });
  order.Finish();
}

}  // namespace eval
