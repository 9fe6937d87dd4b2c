#pragma once

#include <cstdint>
#include <vector>

#include "sim/trace/render_world.h"

namespace sim {

/// Light that falls on a surface: from all round, a little less from below, so that unlit faces
/// still differ; and the sun's.
float LightOnNormal(const Sun& sun, const Eigen::Vector3d& to_sun_w, const Eigen::Vector3d& n_w,
                    bool sunlit);

/// What one view needs to know of a triangle.
struct SeenFacet : FacetInView {
  Eigen::Vector3d n_w;
  int triangle = 0;
  std::uint32_t surface = 0;  ///< names the plane, or the object that has none; times two
  std::uint16_t plane = 0, object = 0;
  bool flat = true;  ///< one normal all over
  bool faces_sun = false;
  bool faces_eye = false;          ///< the second eye (projector)
  float infrared = 0, gloss = 0;   ///< InfraredOf and GlossOf its material
  float unlit = 0, lit = 0;        ///< light on it, without and with the sun
  const Texture* print = nullptr;  ///< once asked for
};

/// The triangles of a view, worked out when they are first met: what nobody sees costs nothing.
class ViewFacets {
 public:
  /// Forgets the view before. `eye_w` is the second eye, where there is one.
  /// @param R_sw  from the world's frame to that of the sun
  void Start(const RenderWorld& world, const Pose& T_wc, const Eigen::Vector3d& eye_w,
             const Eigen::Matrix3d& R_sw);
  const SeenFacet& At(int triangle) {
    const auto i = static_cast<std::size_t>(triangle);
    return stamps_[i] == view_ ? facets_[i] : Meet(triangle);
  }
  const Texture& Print(const SeenFacet& facet);

 private:
  const SeenFacet& Meet(int triangle);

  const RenderWorld* world_ = nullptr;
  Pose T_wc_;
  Eigen::Vector3d eye_w_;
  Eigen::Matrix3d R_sw_;
  std::uint64_t view_ = 0;
  std::vector<std::uint64_t> stamps_;
  std::vector<SeenFacet> facets_;
};

}  // namespace sim
