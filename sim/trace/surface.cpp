#include "sim/trace/surface.h"

#include <Eigen/Dense>
#include <mutex>
#include <optional>

namespace sim {
namespace {

constexpr double kClosestLook_m = 0.4;  ///< prints are baked for this viewing distance
constexpr double kTexelsAPixel = 3.2;  ///< of the longer image side, along the longer face side

}  // namespace

/// The print of one material and the part of its uv plane that triangles use.
struct SurfaceTable::Baked {
  Material material;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e9);
  std::once_flag once;
  std::optional<Texture> texture;
};

SurfaceTable::SurfaceTable(const Scene& scene, const SceneMesh& mesh, const Camera& camera)
    : texel_m_(kClosestLook_m / std::max(camera.fx, camera.fy)),
      max_texels_(std::min(
          32000, static_cast<int>(kTexelsAPixel * std::max(camera.width, camera.height)))) {
  const std::vector<ScenePlane> planes = ScenePlanes(scene);
  for (const Material& material : mesh.materials) {
    baked_.push_back(std::make_unique<Baked>());
    baked_.back()->material = material;
  }
  for (const Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners_w;
    Facet facet;
    facet.material = triangle.material;
    facet.normals_w = triangle.normals_w;
    if (triangle.plane > 0) {
      const ScenePlane& plane = planes.at(static_cast<std::size_t>(triangle.plane) - 1);
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
    Baked& baked = *baked_.at(static_cast<std::size_t>(triangle.material));
    for (const Eigen::Vector2d& uv : triangle.uv_m) {
      baked.low = baked.low.cwiseMin(uv);
      baked.high = baked.high.cwiseMax(uv);
    }
  }
}

SurfaceTable::~SurfaceTable() = default;

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
  Baked& baked = *baked_[static_cast<std::size_t>(At(triangle).material)];
  std::call_once(baked.once, [&] {
    const bool plain = baked.material.print == Print::kPlain;
    baked.texture.emplace(baked.material, baked.low, baked.high - baked.low, texel_m_,
                          plain ? 1 : max_texels_);
  });
  return *baked.texture;
}

}  // namespace sim
