#include "sim/write/preview.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sim/base/random.h"

namespace sim {
namespace {

cv::Mat3b DepthPicture(const cv::Mat1w& depth) {
  std::vector<ushort> measured;
  std::copy_if(depth.begin(), depth.end(), std::back_inserter(measured),
               [](ushort units) { return units > 0; });
  cv::Mat3b picture(depth.size(), cv::Vec3b(0, 0, 0));
  if (measured.empty()) return picture;
  std::sort(measured.begin(), measured.end());
  const double low = measured[measured.size() / 100];
  const double high = measured[measured.size() - 1 - measured.size() / 100];
  cv::Mat1b near(depth.size());
  std::transform(depth.begin(), depth.end(), near.begin(), [&](ushort units) {
    const double part = (units - low) / std::max(high - low, 1.0);
    return cv::saturate_cast<uchar>(255 * (1 - std::clamp(part, 0.0, 1.0)));
  });
  cv::Mat coloured;
  cv::applyColorMap(near, coloured, cv::COLORMAP_TURBO);
  coloured.copyTo(picture, depth > 0);
  return picture;
}

cv::Vec3b ColourOfId(ushort id) {
  if (id == 0) return {0, 0, 0};
  Random random({0x696463, id});
  cv::Vec3b colour;
  for (int i = 0; i < 3; ++i) colour[i] = static_cast<uchar>(60 + random.Below(196));
  return colour;
}

cv::Mat3b IdPicture(const cv::Mat1w& ids) {
  cv::Mat3b picture(ids.size());
  std::transform(ids.begin(), ids.end(), picture.begin(), ColourOfId);
  return picture;
}

}  // namespace

cv::Mat3b PreviewPicture(const SimulatedFrame& frame) {
  cv::Mat above, below, picture;
  cv::hconcat(frame.colour, DepthPicture(frame.depth), above);
  cv::hconcat(IdPicture(frame.plane_id), IdPicture(frame.object_id), below);
  cv::vconcat(above, below, picture);
  return picture;
}

}  // namespace sim
