#include "sim/trace/box_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/shapes/faces.h"
#include "sim/trace/pixel_rows.h"

namespace sim {

BoxOutline::BoxOutline(const Object& box, const Pose& T_wc) {
  std::array<FaceRectangle, 6> faces;
  std::array<bool, 6> front{};
  for (std::size_t i = 0; i < 6; ++i) {
    faces[i] = RectangleOf(box, kFaces[i]);
    front[i] = faces[i].n_w.dot(T_wc.t - faces[i].center_w) > 0;
  }
  // An edge belongs to the outline when one of its faces is seen from the front and the other
  // is not. Two faces share the corners that lie in both.
  const Pose T_cw = Inverse(T_wc);
  const Eigen::Vector3d center_c = T_cw * box.center_w;
  const double near = 1e-9 * (box.size.norm() + box.center_w.norm());
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      if (!front[i] || front[j] || i / 2 == j / 2) continue;
      std::vector<Eigen::Vector3d> shared;
      for (const Eigen::Vector3d& corner : faces[i].corners_w) {
        for (const Eigen::Vector3d& other : faces[j].corners_w) {
          if ((corner - other).norm() <= near) shared.push_back(T_cw * corner);
        }
      }
      if (shared.size() != 2) continue;  // a box without thickness
      Eigen::Vector3d side = shared[0].cross(shared[1]);
      if (side.dot(center_c) < 0) side = -side;
      sides_c_.push_back(side);
    }
  }
}

bool BoxOutline::Meets(const Eigen::Vector3d& ray) const {
  return std::all_of(sides_c_.begin(), sides_c_.end(),
                     [&](const Eigen::Vector3d& side) { return side.dot(ray) >= 0; });
}

/// Without a lens the box covers one stretch of a row.
cv::Range BoxOutline::InStraightRow(const Camera& camera, const ImageRays& rays,
                                    const cv::Rect& area, int v) const {
  double from = area.x, to = area.x + area.width - 1;  // pixels, as good as the division
  const double y = rays.At(area.x, v).y();
  // Each side of the outline leaves a half of the row; what all leave is the stretch.
  for (const Eigen::Vector3d& side : sides_c_) {
    const double rest = side.y() * y + side.z();
    if (side.x() == 0) {
      if (rest < 0) return {};
      continue;
    }
    const double u = camera.cx - camera.fx * rest / side.x();
    if (side.x() > 0) from = std::max(from, u);
    if (side.x() < 0) to = std::min(to, u);
  }
  if (!(from <= to + 2)) return {};
  // Who is in at the ends, the planes decide.
  int first = static_cast<int>(std::ceil(from)), last = static_cast<int>(std::floor(to));
  const auto meets = [&](int u) {
    return u >= area.x && u < area.x + area.width && Meets(rays.At(u, v));
  };
  first = std::max(first - 1, area.x);
  last = std::min(last + 1, area.x + area.width - 1);
  while (first <= last && !meets(first)) ++first;
  while (last >= first && !meets(last)) --last;
  return {first, last + 1};
}

/// Behind a lens rows are bent: each pixel is asked, all sides of the outline by rows.
int BoxOutline::InBentRows(const ImageRays& rays, const cv::Rect& area,
                           cv::Mat1b* covered) const {
  const auto width = static_cast<std::size_t>(area.width);
  std::vector<double> x(width), y(width), innermost(width);
  int count = 0;
  for (int v = area.y; v < area.y + area.height; ++v) {
    rays.Stretch(v, area.x, area.x + area.width, x.data(), y.data());
    // Of the heights over the sides the least tells; no side, no limit.
    std::fill(innermost.begin(), innermost.end(), 0.0);
    for (const Eigen::Vector3d& side : sides_c_) {
      LowerToPlane(side, x.data(), y.data(), area.width, innermost.data());
    }
    const auto inside = [](double height) { return height >= 0; };
    count += static_cast<int>(std::count_if(innermost.begin(), innermost.end(), inside));
    for (std::size_t i = 0; covered != nullptr && i < width; ++i) {
      if (inside(innermost[i])) (*covered)(v, area.x + static_cast<int>(i)) = 255;
    }
  }
  return count;
}

int BoxOutline::PixelsInside(const Camera& camera, const ImageRays& rays, const cv::Rect& area,
                             cv::Mat1b* covered) const {
  if (area.empty()) return 0;
  if (!camera.lens.IsNone()) return InBentRows(rays, area, covered);
  int count = 0;
  for (int v = area.y; v < area.y + area.height; ++v) {
    const cv::Range inside = InStraightRow(camera, rays, area, v);
    if (inside.empty()) continue;
    count += inside.size();
    if (covered != nullptr) covered->row(v).colRange(inside).setTo(255);
  }
  return count;
}

}  // namespace sim
