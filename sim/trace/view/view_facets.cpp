#include "sim/trace/view/view_facets.h"

#include <algorithm>

namespace sim {

float LightOnNormal(const Sun& sun, const Eigen::Vector3d& to_sun_w, const Eigen::Vector3d& n_w,
                    bool sunlit) {
  double light = sun.ambient * (0.8 + 0.12 * n_w.z() + 0.08 * n_w.x());
  if (sunlit) light += sun.intensity * std::max(0.0, n_w.dot(to_sun_w));
  return static_cast<float>(light);
}

void ViewFacets::Start(const RenderWorld& world, const Pose& T_wc, const Eigen::Vector3d& eye_w,
                       const Eigen::Matrix3d& R_sw) {
  world_ = &world;
  T_wc_ = T_wc;
  eye_w_ = eye_w;
  R_sw_ = R_sw;
  ++view_;
  const std::size_t count = world.mesh.triangles.size();
  if (stamps_.size() < count) {
    stamps_.resize(count, 0);
    facets_.resize(count);
  }
}

const SeenFacet& ViewFacets::Meet(int index) {
  const auto i = static_cast<std::size_t>(index);
  const Triangle& triangle = world_->mesh.triangles[i];
  SeenFacet& facet = facets_[i];
  static_cast<FacetInView&>(facet) = world_->surfaces.InView(index, T_wc_);
  facet.n_w = world_->surfaces.Normal(index);
  facet.triangle = index;
  facet.plane = static_cast<std::uint16_t>(triangle.plane);
  facet.object = static_cast<std::uint16_t>(triangle.object);
  facet.flat = triangle.plane > 0;
  facet.surface = 2 * (facet.flat ? facet.plane : 65536u + facet.object);
  const Eigen::Vector3d n_s = R_sw_ * facet.n_w;
  facet.faces_sun = n_s.dot(world_->to_sun_w) > 0;
  facet.faces_eye =
      facet.n_w.dot(eye_w_) + world_->surfaces.Offset(index) - kLeaveSurface_m > 0;
  facet.infrared = static_cast<float>(world_->surfaces.Infrared(index));
  facet.gloss = static_cast<float>(world_->surfaces.Gloss(index));
  facet.unlit = LightOnNormal(world_->scene.sun, world_->to_sun_w, n_s, false);
  facet.lit = LightOnNormal(world_->scene.sun, world_->to_sun_w, n_s, true);
  facet.print = nullptr;
  stamps_[i] = view_;
  return facet;
}

const Texture& ViewFacets::Print(const SeenFacet& facet) {
  SeenFacet& own = facets_[static_cast<std::size_t>(facet.triangle)];
  if (own.print == nullptr) own.print = &world_->surfaces.Print(facet.triangle);
  return *own.print;
}

}  // namespace sim
