#include "eval/check/deep_frames.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "eval/check/check_truth_depth.h"
#include "eval/check/checked_text.h"

namespace eval {

namespace {
constexpr std::size_t kFrames = 24;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

DeepFrames::DeepFrames(const FolderCheck& check, const SequenceTruth& truth)
    : truth_(truth), unit_m_(1 / truth.camera->depth_factor) {
  std::vector<cv::Point2d> pixels;
  for (int v = 0; v < truth.camera->height; ++v) {
    for (int u = 0; u < truth.camera->width; ++u) pixels.emplace_back(u, v);
  }
  rays_ = RaysOf(*truth.camera, pixels);
  for (const Eigen::Vector3d& ray : rays_) {
    reach2_ = std::max(reach2_, ray.head<2>().squaredNorm());
  }
  Load(check);
}

void DeepFrames::Load(const FolderCheck& check) {
  std::vector<double> stamps;
  for (const CheckedPose& pose : truth_.poses) stamps.push_back(pose.stamp_s);
  const std::size_t count = truth_.rgb.size();
  const std::size_t step = std::max<std::size_t>(1, (count + kFrames - 1) / kFrames);
  for (std::size_t i = 0; i < count; i += step) {
    const ListedImage& image = truth_.rgb[i];
    const auto pose = NearestStamp(stamps, image.stamp_s, kSameInstant_s);
    DeepFrame frame;
    frame.name = std::filesystem::path(image.file).filename().string();
    frame.plane_file = "gt/plane_id/" + frame.name;
    frame.stamp_s = image.stamp_s;
    if (!pose || !check.Has(frame.plane_file)) continue;
    frame.pose = *pose;
    frame.ids = Read(check, frame.plane_file);
    const auto pair =
        std::find_if(truth_.pairs.begin(), truth_.pairs.end(), [&](const ListedPair& p) {
          return p.rgb.stamp_s == image.stamp_s &&
                 std::abs(p.depth.stamp_s - image.stamp_s) <= kSameInstant_s;
        });
    if (pair != truth_.pairs.end()) frame.depth = Read(check, pair->depth.file);
    if (!frame.ids.empty()) frames_.push_back(std::move(frame));
  }
}

cv::Mat DeepFrames::Read(const FolderCheck& check, const std::string& file) const {
  const cv::Mat image = cv::imread((check.root / file).string(), cv::IMREAD_UNCHANGED);
  const cv::Size size(truth_.camera->width, truth_.camera->height);
  return image.type() == CV_16UC1 && image.size() == size ? image : cv::Mat();
}

// Brown's model as OpenCV documents it.
Eigen::Vector2d DeepFrames::Pixel(const Eigen::Vector3d& x_c) const {
  const CheckedCamera& camera = *truth_.camera;
  const double x = x_c.x() / x_c.z(), y = x_c.y() / x_c.z(), r2 = x * x + y * y;
  if (r2 > 1.1 * reach2_) return {-1e6, -1e6};
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {camera.fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + camera.cx,
          camera.fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + camera.cy};
}

}  // namespace eval
