#include "eval/surfaces/sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "eval/surfaces/depth_error.h"

namespace eval {
namespace {

constexpr int kNear_cells = 6;  // two cells of the fused cloud: the gap that growing may cross
// Of the pixels that are taken, one in so many each way tells of passes.
constexpr int kPassStride = 2;

/// A sheet's plane in the frame of one camera.
struct PlaneInView {
  Plane pi_c;
  Sheet* sheet = nullptr;
};

/// A pixel with depth.
struct SeenPoint {
  Eigen::Vector3d ray_c;
  double depth_m = 0.0;
  int v = 0, u = 0;
};

void AddPass(const PlaneInView& plane, double slope, const Eigen::Vector3d& ray_c,
             const Pose& T_gc) {
  const Eigen::Vector3d x_g = T_gc * (ray_c * (plane.pi_c.d / slope));
  const cv::Point cell = plane.sheet->CellOf(x_g);
  if (plane.sheet->Holds(cell)) ++plane.sheet->passes(cell);
}

/// The plane that a point lies on, and its height over it.
void AddPoint(const SeenPoint& point, const std::vector<PlaneInView>& planes, const Pose& T_gc,
              const LocalNormals& local, const DepthError& error, bool tells_passes) {
  const Eigen::Vector3d x_g = T_gc * (point.depth_m * point.ray_c);
  const PlaneInView* best = nullptr;
  double best_share = 1.0, best_height_m = 0.0;
  for (const PlaneInView& plane : planes) {
    const double slope = -plane.pi_c.n.dot(point.ray_c);
    if (!(slope > 0)) continue;  // seen from behind
    const double height_m = plane.pi_c.d - slope * point.depth_m;
    const double max_m = DepthError::kSigmas * error.OfPixel_m(point.depth_m, slope);
    if (height_m < -max_m && tells_passes) AddPass(plane, slope, point.ray_c, T_gc);
    const double share = std::abs(height_m) / max_m;
    if (!(share < best_share)) continue;
    if (SpeaksAgainst(local, point.v, point.u, point.depth_m, plane.pi_c.n,
                      error.noise_per_m)) {
      continue;
    }
    const cv::Point cell = plane.sheet->CellOf(x_g);
    if (!plane.sheet->Holds(cell) || plane.sheet->near(cell) == 0) continue;
    best = &plane;
    best_share = share;
    best_height_m = height_m;
  }
  if (best == nullptr) return;
  const cv::Point cell = best->sheet->CellOf(x_g);
  ++best->sheet->hits(cell);
  best->sheet->height_m(cell) += best_height_m;
  best->sheet->depth_m(cell) += point.depth_m;
}

}  // namespace

Sheet SheetOver(const PlanePatch& patch) {
  Sheet sheet;
  sheet.pi_g = patch.pi_g;
  sheet.chart_g = ChartOf(patch.pi_g, patch.surfels.front().p_g);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Eigen::Vector2d min(kInf, kInf), max = -min;
  for (const Surfel& surfel : patch.surfels) {
    min = min.cwiseMin(sheet.chart_g(surfel.p_g));
    max = max.cwiseMax(sheet.chart_g(surfel.p_g));
  }
  const double margin_m = (kNear_cells + 1) * Sheet::kCell_m;
  min.array() -= margin_m;
  max.array() += margin_m;
  sheet.chart_g.origin += min.x() * sheet.chart_g.axis_u + min.y() * sheet.chart_g.axis_v;
  const Eigen::Vector2d size = (max - min) / Sheet::kCell_m;
  const cv::Size cells(int(std::ceil(size.x())) + 1, int(std::ceil(size.y())) + 1);

  sheet.near = cv::Mat1b(cells, std::uint8_t(0));
  for (const Surfel& surfel : patch.surfels) {
    const cv::Point cell = sheet.CellOf(surfel.p_g);
    if (sheet.near.size().width > cell.x && sheet.near.size().height > cell.y) {
      sheet.near(cell) = 1;
    }
  }
  const int side = 2 * kNear_cells + 1;
  cv::dilate(sheet.near, sheet.near, cv::Mat::ones(side, side, CV_8U));
  sheet.hits = cv::Mat1i(cells, 0);
  sheet.passes = cv::Mat1i(cells, 0);
  sheet.height_m = cv::Mat1d(cells, 0.0);
  sheet.depth_m = cv::Mat1d(cells, 0.0);
  return sheet;
}

void AddToSheets(const DepthView& view, const cv::Mat2d& rays, const LocalNormals& local,
                 int stride, double noise_per_m, std::vector<Sheet>& sheets) {
  const Pose T_cg = Inverse(view.T_gc);
  std::vector<PlaneInView> planes;
  for (Sheet& sheet : sheets) {
    const Plane pi_c = Transform(T_cg, sheet.pi_g);
    if (pi_c.d > 0) planes.push_back({pi_c, &sheet});
  }
  const DepthError error{noise_per_m};
  for (int v = 0; v < view.depth_m.rows; v += stride) {
    for (int u = 0; u < view.depth_m.cols; u += stride) {
      const double z = view.depth_m(v, u);
      if (!(z > 0)) continue;
      const SeenPoint point{{rays(v, u)[0], rays(v, u)[1], 1.0}, z, v, u};
      const int pass_stride = stride * kPassStride;
      AddPoint(point, planes, view.T_gc, local, error,
               v % pass_stride == 0 && u % pass_stride == 0);
    }
  }
}

void MeanOverHits(Sheet& sheet) {
  for (int v = 0; v < sheet.hits.rows; ++v) {
    for (int u = 0; u < sheet.hits.cols; ++u) {
      sheet.passes(v, u) *= kPassStride * kPassStride;
      const int hits = sheet.hits(v, u);
      if (hits == 0) continue;
      sheet.height_m(v, u) /= hits;
      sheet.depth_m(v, u) /= hits;
    }
  }
}

}  // namespace eval
