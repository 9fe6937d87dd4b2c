#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "sim/scene/scene.h"

namespace sim {

/// The steps to the next pixel right and down, metres on the face.
struct TextureSteps {
  float right_u, right_v, down_u, down_v;
};

/// What of a print a pixel covers: which copies of the image to look at, and where round uv.
struct TextureFootprint {
  std::size_t level = 0;
  float blend = 0;  ///< share of the next coarser level
  int taps = 1;
  float step_u = 0, step_v = 0;  ///< from tap to tap, finest texels
};

/// A face's print, baked once into an image with its half-sized copies, so that every later
/// look is band-limited to the pixel's footprint: no flicker when the view moves.
class Texture {
 public:
  /// Not to be looked at before all rows are baked, in any order and by any thread, and it is
  /// finished.
  /// @param low_m, extent_m  the part of the face's uv plane to bake, metres
  /// @param texel_m          finest texel, metres
  /// @param max_texels       a side, at most 32,000; a larger face gets coarser texels
  Texture(const Material& material, const Eigen::Vector2d& low_m,
          const Eigen::Vector2d& extent_m, double texel_m, int max_texels = 2048);
  int rows() const { return levels_.front().height; }
  void BakeRows(int first, int last);
  void Finish();

  /// About the parallelogram spanned by the steps.
  TextureFootprint Footprint(const TextureSteps& steps) const;
  static constexpr int kLanes = 8;
  /// Linear reflectance at the first `count` of kLanes places uv, metres, averaged over a
  /// footprint. Clamps at the border. Channels r, g, b and one without meaning. All of u and v
  /// are read.
  void Sample(const float* u, const float* v, int count, const TextureFootprint& footprint,
              std::array<float, 4>* colours) const;
  /// Asks the processor to have ready what Sample is going to look at.
  void Prefetch(const float* u, const float* v, int count,
                const TextureFootprint& footprint) const;

 private:
  using Texel = std::array<std::uint8_t, 4>;  ///< square root of the reflectance
  /// One column and one row more than the face has, copies of the last: what is right of and
  /// below a texel is always there.
  struct Level {
    int width = 1, height = 1;
    std::vector<Texel> texels;
    Texel& At(int x, int y) {
      return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width + 1) +
                    static_cast<std::size_t>(x)];
    }
    const Texel& At(int x, int y) const { return const_cast<Level*>(this)->At(x, y); }
    void Allocate();
    void CopyBorder();
  };
  template <int kQuads>
  void SampleQuads(const float* u_m, const float* v_m, int count,
                   const TextureFootprint& footprint, std::array<float, 4>* colours) const;
  static void Halve(const Level& fine, Level& coarse);

  Material material_;
  Eigen::Vector2f extent_m_;
  std::vector<Level> levels_;
  Eigen::Vector2f low_m_;
  float texel_m_;
};

}  // namespace sim
