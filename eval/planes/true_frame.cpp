#include "eval/planes/true_frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "eval/check/check_truth_depth.h"
#include "io/input_error.h"

namespace eval {
namespace {

constexpr double kReferenceArea_px = 640.0 * 480.0;
constexpr double kCornerSearch_px = 3.0;  // at a width of 640

struct VisiblePatch {
  int pixels = 0;
  Eigen::Vector2d sum_px = Eigen::Vector2d::Zero();
};

std::map<int, VisiblePatch> PatchesOf(const cv::Mat1w& ids) {
  std::map<int, VisiblePatch> patches;
  for (int y = 0; y < ids.rows; ++y) {
    for (int x = 0; x < ids.cols;) {
      int end = x + 1;
      while (end < ids.cols && ids(y, end) == ids(y, x)) ++end;
      if (ids(y, x) != 0) {
        VisiblePatch& patch = patches[ids(y, x)];
        const int run = end - x;
        patch.pixels += run;
        patch.sum_px += Eigen::Vector2d(0.5 * (x + end - 1) * run, double(y) * run);
      }
      x = end;
    }
  }
  return patches;
}

std::map<int, VisiblePatch> PatchesOf(const Sequence& sequence, double stamp_s) {
  std::map<int, VisiblePatch> patches;
  const auto rising = [](const FrameTruth& frame, double s) { return frame.stamp_s < s; };
  const auto frame = std::lower_bound(sequence.frame_truth.begin(), sequence.frame_truth.end(),
                                      stamp_s - kSameStamp_s, rising);
  if (frame == sequence.frame_truth.end() || !(frame->stamp_s <= stamp_s + kSameStamp_s)) {
    return patches;
  }
  for (const VisiblePlane& plane : frame->planes) patches[plane.id].pixels = plane.pixels;
  return patches;
}

/// Whether a pixel looks at the point: far outside the image the lens's model folds back into it.
bool LooksAt(const Camera& camera, const Eigen::Vector2d& pixel, const Eigen::Vector3d& x_c) {
  constexpr double kSameWay = 0.01;  // of a depth: 6 px, more than undistorting leaves
  const Eigen::Vector3d ray_c = RaysOf(camera, {{pixel.x(), pixel.y()}}).front();
  return (ray_c - x_c / x_c.z()).norm() < kSameWay;
}

bool CornerInView(const Camera& camera, const Eigen::Vector3d& corner_c, int id,
                  const std::optional<cv::Mat1w>& ids) {
  if (!(corner_c.z() > 0.0)) return false;
  const Eigen::Vector2d pixel = PixelOf(camera, corner_c);
  if (!(pixel.x() >= 0.0 && pixel.x() <= camera.width - 1.0) ||
      !(pixel.y() >= 0.0 && pixel.y() <= camera.height - 1.0) ||
      !LooksAt(camera, pixel, corner_c)) {
    return false;
  }
  if (!ids) return true;
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  const int radius = std::max(1, int(std::lround(kCornerSearch_px * camera.width / 640.0)));
  for (int v = std::max(0, y - radius); v <= std::min(ids->rows - 1, y + radius); ++v) {
    for (int u = std::max(0, x - radius); u <= std::min(ids->cols - 1, x + radius); ++u) {
      if ((*ids)(v, u) == id) return true;
    }
  }
  return false;
}

/// Direction of the line of sight to the middle of what is seen of the plane.
Eigen::Vector3d SightTo(const SeenPlane& seen, const VisiblePatch& patch, const Camera& camera,
                        bool has_image) {
  if (has_image) {
    const Eigen::Vector2d middle = patch.sum_px / patch.pixels;
    return RaysOf(camera, {{middle.x(), middle.y()}}).front().normalized();
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner_c : seen.corners_c) sum += corner_c;
  return sum.normalized();
}

}  // namespace

const SeenPlane* TrueFrame::Find(int id) const {
  const auto found = std::find_if(planes.begin(), planes.end(),
                                  [&](const SeenPlane& p) { return p.plane->id == id; });
  return found == planes.end() ? nullptr : &*found;
}

TrueFrame ReadTrueFrame(const Sequence& sequence, double stamp_s, const Pose& T_gc) {
  if (!sequence.true_camera) {
    throw io::InputError((sequence.folder / "camera.yaml").string(),
                         "is missing; it is needed to know what the camera could see");
  }
  const Camera& camera = *sequence.true_camera;
  const double image_px = double(camera.width) * camera.height;
  TrueFrame frame{stamp_s, T_gc, image_px, {}, ReadPlaneIds(sequence, stamp_s)};
  if (!frame.plane_ids && sequence.frame_truth.empty()) {
    throw io::InputError(
        (sequence.folder / "gt").string(),
        "has neither plane_id/ images nor frames.jsonl; one of them must say which "
        "planes a frame shows");
  }
  if (!frame.plane_ids && !sequence.plane_id_files.empty()) {
    throw io::InputError((sequence.folder / "gt/plane_id").string(),
                         "has no image of the frame at " + std::to_string(stamp_s) +
                             " s; write the id image of every frame");
  }
  const auto patches =
      frame.plane_ids ? PatchesOf(*frame.plane_ids) : PatchesOf(sequence, stamp_s);
  const double min_pixels = kMinPixels * image_px / kReferenceArea_px;
  const Pose T_cg = Inverse(T_gc);
  for (const auto& [id, patch] : patches) {
    const TruthPlane* plane = sequence.scene->FindPlane(id);
    if (plane == nullptr || !plane->scored || patch.pixels <= 0) continue;
    SeenPlane seen;
    seen.plane = plane;
    seen.object = sequence.scene->FindObject(plane->object);
    seen.pi_c = Transform(T_cg, plane->pi_g);
    for (const Eigen::Vector3d& corner_g : plane->vertices_g) {
      seen.corners_c.push_back(T_cg * corner_g);
      seen.corner_in_view.push_back(
          CornerInView(camera, seen.corners_c.back(), id, frame.plane_ids));
    }
    seen.pixels = patch.pixels;
    const Eigen::Vector3d sight = SightTo(seen, patch, camera, frame.plane_ids.has_value());
    seen.incidence_deg = Angle(seen.pi_c.n, -sight) * 180.0 / std::numbers::pi;
    seen.counted = patch.pixels >= min_pixels && seen.incidence_deg <= kMaxIncidence_deg;
    frame.planes.push_back(std::move(seen));
  }
  return frame;
}

}  // namespace eval
