// Looking texels up: a packet of places at once, so that fetching one waits for no other.
#include <emmintrin.h>

#include "sim/trace/lanes.h"
#include "sim/trace/prints/texture.h"

namespace sim {
namespace {

constexpr int kOne = 1 << 14;  ///< weight 1 in whole numbers

/// A level's texels.
struct Grid {
  __m128 size, last_x, last_y;
  __m128i row;  ///< texels a row, and 1 for what is along it
};

/// Where between four texels each of four places is.
struct Between {
  alignas(16) int texel[4];    ///< the upper left one
  alignas(16) int weights[4];  ///< right and left, halves of a word
  alignas(16) float down[4];
};

[[gnu::always_inline]] inline void Find(const Grid& grid, __m128 u, __m128 v, Between& at) {
  const __m128 half = _mm_set1_ps(0.5F), zero = _mm_setzero_ps();
  const auto inside = [&](__m128 place, __m128 last) {
    const __m128 x = _mm_sub_ps(_mm_mul_ps(place, grid.size), half);
    return _mm_min_ps(_mm_max_ps(x, zero), last);
  };
  // The whole part of a place is its upper left texel; the indices of two words are joined, so
  // that one multiplication gives the texel's number.
  const __m128 x = inside(u, grid.last_x), y = inside(v, grid.last_y);
  const __m128i x0 = _mm_cvttps_epi32(x), y0 = _mm_cvttps_epi32(y);
  const __m128i place = _mm_or_si128(y0, _mm_slli_epi32(x0, 16));
  _mm_store_si128(reinterpret_cast<__m128i*>(at.texel), _mm_madd_epi16(place, grid.row));
  // What is left of it is how the right texel weighs against the left one.
  const __m128 share = _mm_mul_ps(_mm_sub_ps(x, _mm_cvtepi32_ps(x0)), _mm_set1_ps(kOne));
  const __m128i right = _mm_cvttps_epi32(_mm_add_ps(share, half));
  const __m128i left = _mm_sub_epi32(_mm_set1_epi32(kOne), right);
  _mm_store_si128(reinterpret_cast<__m128i*>(at.weights),
                  _mm_or_si128(_mm_slli_epi32(right, 16), left));
  _mm_store_ps(at.down, _mm_sub_ps(y, _mm_cvtepi32_ps(y0)));
}

template <typename Level>
[[gnu::always_inline]] inline Grid GridOf(const Level& level, std::size_t index) {
  return {_mm_set1_ps(1.0F / static_cast<float>(1u << index)),
          _mm_set1_ps(static_cast<float>(level.width - 1)),
          _mm_set1_ps(static_cast<float>(level.height - 1)),
          _mm_set1_epi32((1 << 16) | (level.width + 1))};
}

/// Two neighbouring texels mixed, times kOne. They lie side by side in memory.
[[gnu::always_inline]] inline __m128 Mixed(const std::uint8_t* pair, __m128i weights) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pair));
  const __m128i words = _mm_unpacklo_epi8(bytes, _mm_setzero_si128());
  const __m128i pairs = _mm_unpacklo_epi16(words, _mm_srli_si128(words, 8));
  return _mm_cvtepi32_ps(_mm_madd_epi16(pairs, weights));
}

}  // namespace

template <int kQuads>
[[gnu::always_inline]] inline void Texture::SampleQuads(const float* u_m, const float* v_m,
                                                        int count,
                                                        const TextureFootprint& footprint,
                                                        std::array<float, 4>* colours) const {
  const __m128 scale = _mm_set1_ps(1.0F / texel_m_);
  const float middle = 0.5F * static_cast<float>(footprint.taps - 1);
  // The first of the taps, which lie evenly about the middle of the footprint.
  const auto first = [&](const float* at_m, float low_m, float step, __m128* at) {
    const __m128 low = _mm_set1_ps(low_m), back = _mm_set1_ps(middle * step);
    for (int q = 0; q < kQuads; ++q) {
      const __m128 from_low = _mm_sub_ps(_mm_loadu_ps(at_m + 4 * q), low);
      at[q] = _mm_sub_ps(_mm_mul_ps(from_low, scale), back);
    }
  };
  __m128 u[kQuads], v[kQuads], root[4 * kQuads];
  first(u_m, low_m_.x(), footprint.step_u, u);
  first(v_m, low_m_.y(), footprint.step_v, v);
  const int levels = footprint.blend > 0 ? 2 : 1;
  for (int k = 0; k < levels; ++k) {
    const std::size_t index = footprint.level + static_cast<std::size_t>(k);
    const Level& level = levels_[index];
    const Grid grid = GridOf(level, index);
    __m128 sum[4 * kQuads];
    for (__m128& s : sum) s = _mm_setzero_ps();
    for (int tap = 0; tap < footprint.taps; ++tap) {
      const auto along = static_cast<float>(tap);
      const __m128 step_u = _mm_set1_ps(along * footprint.step_u);
      const __m128 step_v = _mm_set1_ps(along * footprint.step_v);
      Between at[kQuads];
      for (int q = 0; q < kQuads; ++q) {
        Find(grid, _mm_add_ps(u[q], step_u), _mm_add_ps(v[q], step_v), at[q]);
      }
      // Four texels are mixed, first along the row and then down, all channels at once.
      for (int i = 0; i < count; ++i) {
        const Between& quad = at[i / 4];
        const Texel* texel = level.texels.data() + quad.texel[i % 4];
        const __m128i weights = _mm_set1_epi32(quad.weights[i % 4]);
        const __m128 high = Mixed(texel->data(), weights);
        const __m128 low = Mixed(texel[level.width + 1].data(), weights);
        const __m128 down = _mm_set1_ps(quad.down[i % 4]);
        sum[i] = _mm_add_ps(sum[i], _mm_add_ps(high, _mm_mul_ps(_mm_sub_ps(low, high), down)));
      }
    }
    // The coarser level is mixed into the finer one (trilinear).
    const __m128 blend = _mm_set1_ps(footprint.blend);
    for (int i = 0; i < count; ++i) {
      root[i] =
          k == 0 ? sum[i] : _mm_add_ps(root[i], _mm_mul_ps(_mm_sub_ps(sum[i], root[i]), blend));
    }
  }
  // Texels hold square roots of reflectance.
  const float share = 1.0F / static_cast<float>(footprint.taps);
  const __m128 whole = _mm_set1_ps(share / (255.0F * kOne));
  for (int i = 0; i < count; ++i) {
    const __m128 mean = _mm_mul_ps(root[i], whole);
    _mm_storeu_ps(colours[i].data(), _mm_mul_ps(mean, mean));
  }
}

SIM_LANES void Texture::Sample(const float* u_m, const float* v_m, int count,
                               const TextureFootprint& footprint,
                               std::array<float, 4>* colours) const {
  if (count == kLanes) return SampleQuads<2>(u_m, v_m, kLanes, footprint, colours);
  if (count > 4) return SampleQuads<2>(u_m, v_m, count, footprint, colours);
  SampleQuads<1>(u_m, v_m, count, footprint, colours);
}

SIM_LANES void Texture::Prefetch(const float* u_m, const float* v_m, int count,
                                 const TextureFootprint& footprint) const {
  const __m128 scale = _mm_set1_ps(1.0F / texel_m_);
  const __m128 low_u = _mm_set1_ps(low_m_.x()), low_v = _mm_set1_ps(low_m_.y());
  const int levels = footprint.blend > 0 ? 2 : 1;
  for (int k = 0; k < levels; ++k) {
    const std::size_t index = footprint.level + static_cast<std::size_t>(k);
    const Level& level = levels_[index];
    const Grid grid = GridOf(level, index);
    for (int first = 0; first < count; first += 4) {
      const __m128 u = _mm_sub_ps(_mm_loadu_ps(u_m + first), low_u);
      const __m128 v = _mm_sub_ps(_mm_loadu_ps(v_m + first), low_v);
      Between at;
      Find(grid, _mm_mul_ps(u, scale), _mm_mul_ps(v, scale), at);
      for (int i = 0; i < 4; ++i) {
        const Texel* texel = level.texels.data() + at.texel[i];
        __builtin_prefetch(texel);
        __builtin_prefetch(texel + level.width + 1);
      }
    }
  }
}

}  // namespace sim
