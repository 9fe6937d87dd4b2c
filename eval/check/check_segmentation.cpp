#include "eval/check/check_segmentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "eval/formats/sequence/images.h"
#include "io/number_text.h"

namespace eval {
namespace {

const std::string kFolder = "segmentation";

void CheckLabels(Folder& folder, const std::string& file, const cv::Mat& labels,
                 const RunFrame& frame) {
  std::array<long, 256> pixels{};
  for (int y = 0; y < labels.rows; ++y) {
    const unsigned char* row = labels.ptr<unsigned char>(y);
    for (int x = 0; x < labels.cols; ++x) ++pixels[row[x]];
  }
  for (const RunFramePlane& plane : frame.planes) {
    pixels[static_cast<std::size_t>(plane.index + 1)] = 0;
  }
  for (int value = 1; value < 256; ++value) {
    const long count = pixels[static_cast<std::size_t>(value)];
    if (count == 0) continue;
    folder.Tell(
        file, 0,
        fmt::format("shows the value {} in {} pixels, but the frame has no plane of index {}",
                    value, count, value - 1),
        "write index + 1 of the plane, 0 for none");
  }
}

std::vector<std::string> Names(const Folder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.root() / kFolder)) {
    if (entry.path().extension() == ".png") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

void CheckSegmentation(Folder& folder, const Run& run) {
  if (!run.has_planes || !std::filesystem::is_directory(folder.root() / kFolder)) return;
  cv::Size size;
  std::set<std::size_t> seen;
  const std::vector<double> stamps_s = StampsOf(run.frames);
  for (const std::string& name : Names(folder)) {
    const std::string file = kFolder + "/" + name;
    const auto stamp = io::ParseNumber(std::filesystem::path(name).stem().string());
    const auto frame =
        stamp ? NearestStamp(stamps_s, *stamp, kSameInstant_s) : std::optional<std::size_t>();
    if (!frame) {
      folder.Tell(file, 0, "is named by no time of frame_planes.jsonl",
                  "name the image by the time of its frame");
      continue;
    }
    seen.insert(*frame);
    const cv::Mat labels = ReadImage(folder, file, {CV_8U, 1, size});
    if (labels.empty()) continue;
    if (size.empty()) size = labels.size();
    CheckLabels(folder, file, labels, run.frames[*frame]);
  }
  for (std::size_t i = 0; i < stamps_s.size(); ++i) {
    if (seen.count(i) != 0) continue;
    folder.Tell(kFolder, 0, fmt::format("lacks the image of frame {:.6f}", stamps_s[i]),
                "write all frames or none");
  }
}

}  // namespace eval
