#include "sim/trace/surface.h"

#include <Eigen/Dense>

#include "sim/scene/surface_light.h"

namespace sim {
namespace {

constexpr double kClosestLook_m = 0.4;  ///< prints are baked for this viewing distance
/// Per pixel of the longer image side, along the longer face side.
constexpr double kTexelsAPixel = 3.2;

}  // namespace

SurfaceTable::SurfaceTable(const SceneMesh& mesh, const Camera& camera)
    : texel_m_(kClosestLook_m / std::max(camera.fx, camera.fy)),
      max_texels_(std::min(
          32000, static_cast<int>(kTexelsAPixel * std::max(camera.width, camera.height)))) {
  for (const Material& material : mesh.materials) {
    prints_.push_back(std::make_unique<BakedPrint>(material));
  }
  for (const Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners_w;
    Facet facet;
    facet.material = triangle.material;
    facet.normals_w = triangle.normals_w;
    const Material& material = mesh.materials.at(static_cast<std::size_t>(triangle.material));
    facet.infrared = InfraredOf(material);
    facet.gloss = GlossOf(material);
    if (triangle.plane > 0) {
      const ScenePlane& plane = mesh.planes.at(static_cast<std::size_t>(triangle.plane) - 1);
      facet.n_w = plane.n_w;
      facet.d = plane.d;
    } else {
      facet.n_w = (b - a).cross(c - a).normalized();
      facet.d = -facet.n_w.dot(a);
    }
    // uv is affine on the triangle and constant along its normal.
    Eigen::Matrix3d edges;
    edges << (b - a).transpose(), (c - a).transpose(), facet.n_w.transpose();
    Eigen::Matrix<double, 3, 2> steps;
    steps << (triangle.uv_m[1] - triangle.uv_m[0]).transpose(),
        (triangle.uv_m[2] - triangle.uv_m[0]).transpose(), Eigen::RowVector2d::Zero();
    facet.uv_of = edges.partialPivLu().solve(steps).transpose();
    facet.uv_at = triangle.uv_m[0] - facet.uv_of * a;
    facets_.push_back(facet);
    BakedPrint& print = *prints_.at(static_cast<std::size_t>(triangle.material));
    for (const Eigen::Vector2d& uv : triangle.uv_m) print.Include(uv);
  }
}

FacetInView SurfaceTable::InView(int triangle, const Pose& T_wc) const {
  const Facet& facet = At(triangle);
  FacetInView seen;
  seen.n_c = T_wc.R.transpose() * facet.n_w;
  const double d_c = facet.n_w.dot(T_wc.t) + facet.d;
  seen.inverse_depth = -seen.n_c / d_c;  // n_c . (z ray) + d_c = 0
  seen.uv_over_depth = ((facet.uv_of * T_wc.t + facet.uv_at) * seen.inverse_depth.transpose() +
                        facet.uv_of * T_wc.R)
                           .cast<float>();
  return seen;
}

Eigen::Vector3d SurfaceTable::ShadingNormal(int triangle, double b1, double b2) const {
  const auto& [n0, n1, n2] = At(triangle).normals_w;
  return ((1.0 - b1 - b2) * n0 + b1 * n1 + b2 * n2).normalized();
}

const Texture& SurfaceTable::Print(int triangle) const {
  return prints_[static_cast<std::size_t>(At(triangle).material)]->Get(texel_m_, max_texels_);
}

}  // namespace sim
