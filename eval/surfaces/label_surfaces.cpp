#include "eval/surfaces/label_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_set>

#include "eval/planes/united_faces.h"
#include "eval/surfaces/depth_error.h"
#include "eval/surfaces/find_surfaces.h"
#include "eval/surfaces/local_normals.h"
#include "eval/surfaces/sheet.h"
#include "eval/surfaces/surfel_cloud.h"

namespace eval {
namespace {

constexpr int kNormalStride = 2;  // a normal speaks for the four pixels about it

/// The ids of a frame where it has depth.
cv::Mat1w TrueIds(const Sequence& sequence, const DepthView& view) {
  auto ids = ReadPlaneIds(sequence, view.stamp_s);
  if (!ids || ids->size() != view.depth_m.size()) {
    throw io::InputError((sequence.folder / "gt/plane_id").string(),
                         "has no image of the depth's size for a frame; surfaces by the truth "
                         "need one for each: write the sequence again");
  }
  ids->setTo(0, view.depth_m <= 0);
  return *ids;
}

/// Cells of the true planes that any view shows, by plane.
class SeenAreas {
 public:
  explicit SeenAreas(const SceneTruth& scene) {
    for (const TruthPlane& plane : scene.planes) {
      if (!plane.scored) continue;
      planes_[plane.id] = {plane.pi_g, ChartOf(plane.pi_g, plane.vertices_g.front()), {}};
    }
  }
  void Add(const DepthView& view, const cv::Mat2d& rays, const cv::Mat1w& ids) {
    SeenArea* area = nullptr;
    int id_of_area = 0;
    for (int v = 0; v < ids.rows; ++v) {
      for (int u = 0; u < ids.cols; ++u) {
        const int id = ids(v, u);
        if (id == 0) continue;
        if (id != id_of_area) {
          const auto found = planes_.find(id);
          area = found == planes_.end() ? nullptr : &found->second;
          id_of_area = id;
        }
        if (area == nullptr) continue;
        const Eigen::Vector3d ray_g =
            view.T_gc.R * Eigen::Vector3d(rays(v, u)[0], rays(v, u)[1], 1.0);
        const double depth_m =
            -SignedDistance(area->pi_g, view.T_gc.t) / area->pi_g.n.dot(ray_g);
        const Eigen::Vector2d uv = area->chart(view.T_gc.t + depth_m * ray_g) / Sheet::kCell_m;
        area->cells.insert(CellKey({int(std::lround(uv.x())), int(std::lround(uv.y())), 0}));
      }
    }
  }
  std::vector<int> AtLeast(double min_area_m2) const {
    std::vector<int> ids;
    for (const auto& [id, area] : planes_) {
      const double seen_m2 = double(area.cells.size()) * Sheet::kCell_m * Sheet::kCell_m;
      if (seen_m2 >= min_area_m2) ids.push_back(id);
    }
    return ids;
  }

 private:
  struct SeenArea {
    Plane pi_g;
    PlaneChart chart;
    std::unordered_set<std::uint64_t> cells;
  };
  std::map<int, SeenArea> planes_;
};

}  // namespace

SurfaceLabeller::SurfaceLabeller(const SurfaceFile& file) : noise_per_m_(file.noise_per_m) {
  for (const Surface& surface : file.surfaces) {
    surfaces_.push_back({CountedAs(surface), surface.pi_g, SurfaceArea(surface)});
  }
}

cv::Mat1w SurfaceLabeller::Label(const DepthView& view, const cv::Mat2d& rays) const {
  const LocalNormals local = FitLocalNormals(view.depth_m, rays, kNormalStride);
  const Pose T_cg = Inverse(view.T_gc);
  const DepthError error{noise_per_m_};
  std::vector<Plane> planes_c;
  for (const LabelledSurface& surface : surfaces_)
    planes_c.push_back(Transform(T_cg, surface.pi_g));

  cv::Mat1w labels(view.depth_m.size(), std::uint16_t(0));
  for (int v = 0; v < labels.rows; ++v) {
    for (int u = 0; u < labels.cols; ++u) {
      const double z = view.depth_m(v, u);
      if (!(z > 0)) continue;
      const Eigen::Vector3d ray_c(rays(v, u)[0], rays(v, u)[1], 1.0);
      const int nv = v - v % kNormalStride, nu = u - u % kNormalStride;
      double best_share = 1.0;
      for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        const double slope = -planes_c[i].n.dot(ray_c);
        if (!(slope > 0)) continue;
        const double off_m = std::abs(planes_c[i].d - slope * z);
        const double share = off_m / (DepthError::kSigmas * error.OfPixel_m(z, slope));
        if (!(share < best_share)) continue;
        if (SpeaksAgainst(local, nv, nu, z, planes_c[i].n, noise_per_m_)) continue;
        if (!surfaces_[i].area.Holds(view.T_gc * (z * ray_c))) continue;
        best_share = share;
        labels(v, u) = std::uint16_t(surfaces_[i].label);
      }
    }
  }
  return labels;
}

TrueSurfaceLabeller::TrueSurfaceLabeller(const Sequence& sequence, const DepthViews& views,
                                         double min_area_m2, TruePixels pixels)
    : sequence_(WithUnitedFaces(sequence)), pixels_(pixels), noise_per_m_(MeasureNoise(views)) {
  if (!sequence_.scene || sequence_.plane_id_files.empty()) {
    throw io::InputError(sequence.folder.string(),
                         "has no gt/scene.json or no gt/plane_id/, so there are no true planes "
                         "to count by; find surfaces with `pas surfaces`");
  }
  SeenAreas areas(*sequence_.scene);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const DepthView view = views.Read(i);
    areas.Add(view, views.rays(), TrueIds(sequence_, view));
  }
  ids_ = areas.AtLeast(min_area_m2);
}

cv::Mat1w TrueSurfaceLabeller::Label(const DepthView& view, const cv::Mat2d& rays) const {
  cv::Mat1w ids = TrueIds(sequence_, view);
  const Pose T_cg = Inverse(view.T_gc);
  std::map<int, Plane> counted_c;
  for (const int id : ids_)
    counted_c[id] = Transform(T_cg, sequence_.scene->FindPlane(id)->pi_g);
  const DepthError error{noise_per_m_};
  ids.forEach([&](std::uint16_t& id, const int* at) {
    const auto plane_c = counted_c.find(id);
    if (plane_c == counted_c.end()) {
      id = 0;
    } else if (pixels_ == TruePixels::kDepthOnPlane) {
      const double z = view.depth_m(at[0], at[1]);
      const cv::Vec2d& ray = rays(at[0], at[1]);
      const double slope = -plane_c->second.n.dot(Eigen::Vector3d(ray[0], ray[1], 1.0));
      const double max_m = DepthError::kSigmas * error.OfPixel_m(z, slope);
      if (!(std::abs(plane_c->second.d - slope * z) < max_m)) id = 0;
    }
  });
  return ids;
}

}  // namespace eval
