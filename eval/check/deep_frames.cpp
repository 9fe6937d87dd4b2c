#include "eval/check/deep_frames.h"

#include <algorithm>

#include "eval/check/check_truth_depth.h"
#include "eval/formats/sequence/images.h"
#include "eval/formats/stamped_files.h"
#include "eval/formats/stamps.h"
#include "eval/trajectory/true_pose.h"

namespace eval {

namespace {
constexpr std::size_t kMaxFrames = 24;
}

DeepFrames::DeepFrames(const Folder& folder, const SequenceTruth& truth)
    : truth_(truth), unit_m_(1 / truth.camera->depth_factor) {
  std::vector<cv::Point2d> pixels;
  for (int v = 0; v < truth.camera->height; ++v) {
    for (int u = 0; u < truth.camera->width; ++u) pixels.emplace_back(u, v);
  }
  rays_ = RaysOf(*truth.camera, pixels);
  for (const Eigen::Vector3d& ray : rays_) {
    reach2_ = std::max(reach2_, ray.head<2>().squaredNorm());
  }
  Load(folder);
}

void DeepFrames::Load(const Folder& folder) {
  const std::vector<double> stamps = StampsOf(truth_.poses);
  const StampedFiles plane_files(folder.root() / "gt/plane_id");
  const std::size_t count = truth_.rgb.size();
  const std::size_t step = std::max<std::size_t>(1, (count + kMaxFrames - 1) / kMaxFrames);
  for (std::size_t i = 0; i < count; i += step) {
    const ListedImage& image = truth_.rgb[i];
    const auto pose = NearestStamp(stamps, image.stamp_s, kSameInstant_s);
    DeepFrame frame;
    frame.name = std::filesystem::path(image.file).filename().string();
    frame.stamp_s = image.stamp_s;
    const auto ids = plane_files.Find(image.stamp_s);
    if (!pose || !ids) continue;
    frame.plane_file = "gt/plane_id/" + ids->filename().string();
    frame.pose = *pose;
    frame.ids = Read(folder, frame.plane_file);
    const auto pair =
        std::find_if(truth_.pairs.begin(), truth_.pairs.end(),
                     [&](const SequenceFrame& p) { return p.stamp_s == image.stamp_s; });
    if (frame.ids.empty()) continue;
    if (pair != truth_.pairs.end()) AddDepth(folder, *pair, frame);
    frames_.push_back(std::move(frame));
  }
}

void DeepFrames::AddDepth(const Folder& folder, const SequenceFrame& pair,
                          DeepFrame& frame) const {
  const auto T_wc = PoseAt(truth_.poses, pair.depth_stamp_s);
  if (!T_wc) return;
  frame.depth = Read(folder, pair.depth);
  frame.depth_stamp_s = pair.depth_stamp_s;
  frame.T_wc_depth = *T_wc;
  const bool same_instant = std::abs(pair.depth_stamp_s - pair.stamp_s) <= kSameInstant_s;
  frame.depth_ids = same_instant ? frame.ids : InnerIds(frame.ids);
}

cv::Mat DeepFrames::Read(const Folder& folder, const std::string& file) const {
  Folder again(folder.root(), OnFault::kCollect);  // its faults have been told
  return ReadImage(again, file,
                   {CV_16U, 1, cv::Size(truth_.camera->width, truth_.camera->height)});
}

Eigen::Vector2d DeepFrames::Pixel(const Eigen::Vector3d& x_c) const {
  const double r2 = (x_c.head<2>() / x_c.z()).squaredNorm();
  if (r2 > 1.1 * reach2_) return {-1e6, -1e6};
  return PixelOf(*truth_.camera, x_c);
}

}  // namespace eval
