#include "sim/trace/prints/baked_print.h"

#include <gtest/gtest.h>

#include <thread>

namespace sim {
namespace {

constexpr double kTexel_m = 0.002;
constexpr int kMostTexels = 300;

Material Wood() {
  Material material;
  material.print = Print::kWood;
  material.seed = 5;
  return material;
}

std::array<float, 4> PrintAt(const Texture& texture, float u, float v,
                             const TextureFootprint& footprint) {
  std::array<float, Texture::kLanes> all_u, all_v;
  all_u.fill(u);
  all_v.fill(v);
  std::array<float, 4> colour;
  texture.Sample(all_u.data(), all_v.data(), 1, footprint, &colour);
  return colour;
}

/// What a thread finds right after it asked, from fine to coarse, to the very borders.
std::vector<std::array<float, 4>> Looks(BakedPrint& print) {
  const Texture& texture = print.Get(kTexel_m, kMostTexels);
  std::vector<std::array<float, 4>> looks;
  for (const float step : {0.002F, 0.013F, 0.4F}) {
    const TextureFootprint footprint = texture.Footprint({step, 0, 0, step});
    for (float v = -0.001F; v < 0.302F; v += 0.0037F) {
      for (float u = -0.001F; u < 0.502F; u += 0.0031F) {
        looks.push_back(PrintAt(texture, u, v, footprint));
        looks.back()[3] = 0;
      }
    }
  }
  return looks;
}

/// 250 x 150 texels: bands of rows do not come out even.
void Span(BakedPrint& print) {
  print.Include({0, 0});
  print.Include({0.5, 0.3});
}

TEST(BakedPrint, IsWholeForEveryThreadThatAsksAndTheSameWhateverTheirNumber) {
  BakedPrint alone(Wood());
  Span(alone);
  const auto expected = Looks(alone);
  for (int round = 0; round < 20; ++round) {
    BakedPrint shared(Wood());
    Span(shared);
    std::array<std::vector<std::array<float, 4>>, 4> found;
    std::vector<std::thread> threads;
    for (auto& looks : found) {
      threads.emplace_back([&shared, &looks] { looks = Looks(shared); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& looks : found) ASSERT_TRUE(looks == expected) << "round " << round;
  }
}

TEST(BakedPrint, TakesAPacketOfPlacesForWhatEachIsAlone) {
  BakedPrint print(Wood());
  Span(print);
  const Texture& texture = print.Get(kTexel_m, kMostTexels);
  const float u[] = {-1.0F, 0.0F, 0.1003F, 0.2501F, 0.2511F, 0.4F, 0.4999F, 2.0F};
  const float v[] = {0.1F, -3.0F, 0.2999F, 0.1F, 0.0F, 0.1507F, 0.3F, 7.0F};
  for (const float step : {0.001F, 0.005F, 0.02F}) {
    for (const float slant : {1.0F, 3.0F}) {
      const TextureFootprint footprint = texture.Footprint({step * slant, 0, 0, step});
      for (int count = 1; count <= Texture::kLanes; ++count) {
        std::array<std::array<float, 4>, Texture::kLanes> colours;
        texture.Sample(u, v, count, footprint, colours.data());
        for (int i = 0; i < count; ++i) {
          const auto k = static_cast<std::size_t>(i);
          const auto alone = PrintAt(texture, u[i], v[i], footprint);
          for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(colours[k][c], alone[c]);
        }
      }
    }
  }
}

}  // namespace
}  // namespace sim
