#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/scene/scene.h"

namespace sim {

/// A face's print, baked once into an image with its half-sized copies, so that every later
/// look is band-limited to the pixel's footprint: no flicker when the view moves.
class Texture {
 public:
  /// @param low_m, extent_m  the part of the face's uv plane to bake, metres
  /// @param texel_m          finest texel, metres
  /// @param max_texels       a side; a larger face gets coarser texels
  Texture(const Material& material, const Eigen::Vector2d& low_m,
          const Eigen::Vector2d& extent_m, double texel_m, int max_texels = 2048);

  /// Linear reflectance at uv_m, averaged over about the parallelogram spanned by the steps to
  /// the next pixel right and down, both metres on the face. Clamps at the border.
  Eigen::Array3f Sample(const Eigen::Vector2f& uv_m, const Eigen::Vector2f& right_m,
                        const Eigen::Vector2f& down_m) const;

 private:
  using Texel = std::array<std::uint8_t, 4>;  ///< square root of the reflectance
  struct Level {
    int width = 1, height = 1;
    std::vector<Texel> texels;
  };
  void Bake(const Material& material, const Eigen::Vector2d& extent_m);
  void Halve();
  Eigen::Array4f Bilinear(std::size_t level, const Eigen::Vector2f& texel) const;
  Eigen::Array4f Trilinear(const Eigen::Vector2f& texel, float log2_footprint) const;

  std::vector<Level> levels_;
  Eigen::Vector2f low_m_;
  float texel_m_;
};

}  // namespace sim
