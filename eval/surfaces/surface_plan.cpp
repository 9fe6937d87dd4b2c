#include "eval/surfaces/surface_plan.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "eval/draw/paint.h"

namespace eval {
namespace {

const Colour kPlanPaper{250, 250, 250}, kWay{60, 60, 60};
constexpr double kMargin_px = 30;

Eigen::Vector3d UpOf(const SurfaceFile& file, const DepthViews& views) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < views.size(); ++i) up -= views.PoseOf(i).R.col(1);
  up.normalize();
  // A camera that looks down at a desk holds its own y axis askew by as much.
  constexpr double kMinCosine = 0.6;  // 53 deg
  double most_m2 = 0.0;
  Eigen::Vector3d best = up;
  for (const Surface& surface : file.surfaces) {
    if (!(surface.pi_g.n.dot(up) > kMinCosine) || !(AreaOf(surface) > most_m2)) continue;
    most_m2 = AreaOf(surface);
    best = surface.pi_g.n;
  }
  return best;
}

/// From the world to the picture, all outlines in it.
class PlanView {
 public:
  PlanView(const Eigen::Vector3d& up, cv::Size size) : size_(size) {
    x_ = up.unitOrthogonal();
    y_ = up.cross(x_);
  }
  void Cover(const Eigen::Vector3d& p_g) {
    min_ = min_.cwiseMin(Flat(p_g));
    max_ = max_.cwiseMax(Flat(p_g));
  }
  double PixelsAMetre() const {
    const Eigen::Vector2d span = (max_ - min_).cwiseMax(0.1);
    return std::min((size_.width - 2 * kMargin_px) / span.x(),
                    (size_.height - 2 * kMargin_px) / span.y());
  }
  cv::Point2d operator()(const Eigen::Vector3d& p_g) const {
    const Eigen::Vector2d off = (Flat(p_g) - 0.5 * (min_ + max_)) * PixelsAMetre();
    return {0.5 * size_.width + off.x(), 0.5 * size_.height - off.y()};
  }

 private:
  Eigen::Vector2d Flat(const Eigen::Vector3d& p_g) const { return {x_.dot(p_g), y_.dot(p_g)}; }

  static constexpr double kInf = std::numeric_limits<double>::infinity();
  cv::Size size_;
  Eigen::Vector3d x_, y_;
  Eigen::Vector2d min_{kInf, kInf}, max_{-kInf, -kInf};
};

Eigen::Vector3d InWorld(const Surface& surface, const Eigen::Vector2d& uv) {
  const PlaneChart& chart = surface.chart_g;
  return chart.origin + uv.x() * chart.axis_u + uv.y() * chart.axis_v;
}

std::vector<cv::Point2d> InPlan(const PlanView& plan, const Surface& surface,
                                const Polygon2& outline) {
  std::vector<cv::Point2d> points;
  for (const Eigen::Vector2d& corner : outline)
    points.push_back(plan(InWorld(surface, corner)));
  return points;
}

const Polygon2& Largest(const std::vector<Polygon2>& outlines) {
  return *std::max_element(outlines.begin(), outlines.end(),
                           [](const auto& a, const auto& b) { return Area(a) < Area(b); });
}

}  // namespace

cv::Mat DrawPlan(const SurfaceFile& file, const DepthViews& views, cv::Size size) {
  PlanView plan(UpOf(file, views), size);
  std::vector<cv::Point2d> way;
  for (std::size_t i = 0; i < views.size(); ++i) plan.Cover(views.PoseOf(i).t);
  for (const Surface& surface : file.surfaces) {
    for (const Polygon2& outline : surface.outlines) {
      for (const Eigen::Vector2d& corner : outline) plan.Cover(InWorld(surface, corner));
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i) way.push_back(plan(views.PoseOf(i).t));

  cv::Mat picture(size, CV_8UC3, kPlanPaper);
  constexpr double kOpacity = 0.35;
  for (const Surface& surface : file.surfaces) {
    const Colour colour = ColourOfPlane(CountedAs(surface));
    for (const Polygon2& outline : surface.outlines) {
      FillArea(picture, InPlan(plan, surface, outline), colour, kOpacity);
      PutPath(picture, InPlan(plan, surface, outline), true, Darker(colour), 1);
    }
  }
  PutPath(picture, way, false, kWay, 1);
  if (!way.empty()) PutDot(picture, way.front(), 4, kWay);
  for (const Surface& surface : file.surfaces) {
    cv::Point2d sum(0, 0);
    const auto points = InPlan(plan, surface, Largest(surface.outlines));
    for (const cv::Point2d& point : points) sum += point;
    PutText(picture, std::to_string(surface.id), sum / double(points.size()),
            {12, kBlack, true, Align::kCentre});
  }
  PutLine(picture, {20, size.height - 14.0}, {20 + plan.PixelsAMetre(), size.height - 14.0},
          kBlack, 3);
  PutText(picture, "1 m, from above; the line is the camera's way", {20, size.height - 22.0},
          {9.5, kBlack, false, Align::kLeft});
  return picture;
}

}  // namespace eval
