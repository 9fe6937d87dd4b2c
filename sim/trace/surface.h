#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sim/base/pose.h"
#include "sim/camera/camera.h"
#include "sim/shapes/mesh.h"
#include "sim/trace/prints/baked_print.h"

namespace sim {

/// A triangle as one view needs it: everything about it that is affine in the ray (x, y, 1).
struct FacetInView {
  Eigen::Vector3d inverse_depth;             ///< 1/z = inverse_depth . ray
  Eigen::Matrix<float, 2, 3> uv_over_depth;  ///< uv = z * (uv_over_depth ray), metres
  Eigen::Vector3d n_c;                       ///< unit normal, camera frame
};

/// The triangles of a scene with the exact planes they lie in and the prints they carry.
class SurfaceTable {
 public:
  /// Prints are baked as finely as an image of `camera` can show them from 0.4 m, large faces
  /// as finely as it can show them whole.
  SurfaceTable(const SceneMesh& mesh, const Camera& camera);

  /// The triangle seen from T_wc.
  FacetInView InView(int triangle, const Pose& T_wc) const;

  /// Unit normal of the triangle's plane, world frame.
  const Eigen::Vector3d& Normal(int triangle) const { return At(triangle).n_w; }
  /// Offset of the triangle's plane, metres: Normal . x + Offset = 0.
  double Offset(int triangle) const { return At(triangle).d; }
  /// InfraredOf and GlossOf its material.
  double Infrared(int triangle) const { return At(triangle).infrared; }
  double Gloss(int triangle) const { return At(triangle).gloss; }
  /// Shading normal at barycentric weights b1, b2 of corners 1 and 2.
  Eigen::Vector3d ShadingNormal(int triangle, double b1, double b2) const;
  /// The print of the triangle, baked when it is first seen. Safe to call from many threads.
  const Texture& Print(int triangle) const;

 private:
  struct Facet {
    Eigen::Vector3d n_w;
    double d = 0;                       ///< n_w . x + d = 0
    Eigen::Matrix<double, 2, 3> uv_of;  ///< uv = uv_of x_w + uv_at
    Eigen::Vector2d uv_at;
    std::array<Eigen::Vector3d, 3> normals_w;
    int material = 0;
    double infrared = 0, gloss = 0;
  };
  const Facet& At(int triangle) const { return facets_[static_cast<std::size_t>(triangle)]; }

  std::vector<Facet> facets_;
  std::vector<std::unique_ptr<BakedPrint>> prints_;
  double texel_m_;
  int max_texels_;
};

}  // namespace sim
