#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <thread>

#include "sim/families/families.h"
#include "sim/trace/frame_renderer.h"
#include "tests/sim/support/sim_worlds.h"

// A picture must not tell on which processor, or on how many threads, it was made.
namespace sim {
namespace {

/// FNV-1a over the pixels' bytes.
std::uint64_t Hash(const cv::Mat& image, std::uint64_t hash = 0xcbf29ce484222325ULL) {
  for (int v = 0; v < image.rows; ++v) {
    const uchar* byte = image.ptr(v);
    const std::size_t count = image.elemSize() * static_cast<std::size_t>(image.cols);
    for (std::size_t i = 0; i < count; ++i) hash = (hash ^ byte[i]) * 0x100000001b3ULL;
  }
  return hash;
}

std::uint64_t HashOfTruth(const Rendering& rendering) {
  return Hash(rendering.object_id, Hash(rendering.plane_id, Hash(rendering.depth_m)));
}

/// Hash of each view, rendered by `threads` threads that share one renderer.
std::vector<std::uint64_t> Hashes(const FrameRenderer& renderer, const std::vector<Pose>& views,
                                  std::size_t threads) {
  std::vector<std::uint64_t> hashes(views.size());
  std::vector<std::thread> workers;
  for (std::size_t first = 0; first < threads; ++first) {
    workers.emplace_back([&, first] {
      for (std::size_t i = first; i < views.size(); i += threads) {
        hashes[i] = HashOfTruth(renderer.Render(views[i], {.colour = false}));
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
  return hashes;
}

std::vector<InstructionSet> SetsOfThisProcessor() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set :
       {InstructionSet::kSse42, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (HasInstructionSet(set)) sets.push_back(set);
  }
  return sets;
}

/// Slightly turned about the optical axis, so that edges cross pixel centres everywhere.
std::vector<Pose> Views(int count) {
  std::vector<Pose> views;
  for (int i = 0; i < count; ++i) {
    const double a = -0.5 + 0.13 * i;
    Pose T_wc = LookAt({1.1 * std::sin(a), -1.1 * std::cos(a), 1.3 + 0.02 * i}, {0, 0, 0.75});
    T_wc.R = T_wc.R * Eigen::AngleAxisd(0.03 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    views.push_back(T_wc);
  }
  return views;
}

void ExpectOneAnswer(const Scene& scene, const Camera& camera, int views) {
  const std::vector<Pose> poses = Views(views);
  const auto expected = Hashes(FrameRenderer(scene, camera), poses, 1);
  for (const InstructionSet set : SetsOfThisProcessor()) {
    const FrameRenderer renderer(scene, camera, set);
    for (const std::size_t threads : {1u, 2u, 4u}) {
      EXPECT_EQ(Hashes(renderer, poses, threads), expected)
          << "set " << static_cast<int>(set) << ", " << threads << " threads";
    }
  }
}

TEST(DepthAndIds, AreTheSameBitsOnEveryInstructionSetAndAnyNumberOfThreads) {
  ExpectOneAnswer(SmallDesk(), Resize(Camera{}, 320, 240), 8);
}

TEST(DepthAndIds, AreTheSameBitsInAFullClutteredDesk) {
  ExpectOneAnswer(MakeScene("desk", 3), Camera{}, 2);
}

TEST(DepthAndIds, AreTheSameBitsBehindALens) {
  ExpectOneAnswer(SmallDesk(),
                  WithLens(Resize(Camera{}, 320, 240), {-0.2, 0.05, 0.002, -0.001, 0.0}), 6);
}

// Edges that pass exactly through pixel centres: the ray tracer alone could go either way.
TEST(DepthAndIds, AreTheSameBitsWhereEdgesPassThroughPixelCentres) {
  Scene scene;
  const Camera camera;  // centre at 319.5, 239.5; at z = 1 m, 1/525 m a pixel
  for (int i = 0; i < 6; ++i) {
    const double edge = (10.5 + 20 * i) / 525.0;
    scene.objects.push_back(BoxObject(i + 1, "box", Role::kRegular,
                                      {edge - 0.01, 1.05 + 0.1 * i, edge / 2},
                                      {0.02, 0.1, 2 * edge}));
  }
  std::vector<Pose> views{LookAlongY()};
  const auto expected = Hashes(FrameRenderer(scene, camera), views, 1);
  for (const InstructionSet set : SetsOfThisProcessor()) {
    EXPECT_EQ(Hashes(FrameRenderer(scene, camera, set), views, 1), expected);
  }
}

TEST(DepthAndIds, DifferFromTheRayTracersOwnOnlyAtEdges) {
  const FrameRenderer renderer(SmallDesk(), Camera{});
  int differ = 0;
  for (const Pose& T_wc : Views(3)) {
    const Rendering exact = renderer.Render(T_wc, {.colour = false});
    const Rendering traced = renderer.Render(T_wc, {.colour = false, .exact_edges = false});
    for (int v = 0; v < exact.plane_id.rows; ++v) {
      for (int u = 0; u < exact.plane_id.cols; ++u) {
        if (exact.plane_id(v, u) != traced.plane_id(v, u)) {
          ++differ;
        } else if (exact.plane_id(v, u) > 0 && exact.depth_m(v, u) != traced.depth_m(v, u)) {
          FAIL() << "one plane, two depths at " << u << ", " << v;
        }
      }
    }
  }
  EXPECT_LE(differ, 30);  // 10 a frame of about 10,000 edge pixels
}

// Shadows' edges are the ray tracer's; it is pinned to what is the same with and without AVX2.
TEST(Colour, UnderLampsAndAreaLightsIsTheSameBitsWherePinnedAndOnAnyNumberOfThreads) {
  Scene scene = SmallDesk();
  Light lamp, panel;
  lamp.center_w = {0.2, -0.3, 1.3};
  panel.kind = LightKind::kArea;
  panel.center_w = {-0.4, 0.1, 2};
  scene.lights = {lamp, panel};
  const Camera camera = SmallCamera();
  const std::vector<Pose> poses = Views(4);
  const auto hashes = [&](InstructionSet set, std::size_t threads) {
    const FrameRenderer renderer(scene, camera, set);
    std::vector<std::uint64_t> found(poses.size());
    std::vector<std::thread> workers;
    for (std::size_t first = 0; first < threads; ++first) {
      workers.emplace_back([&, first] {
        for (std::size_t i = first; i < poses.size(); i += threads) {
          found[i] = Hash(renderer.Render(poses[i]).radiance);
        }
      });
    }
    for (std::thread& worker : workers) worker.join();
    return found;
  };
  const auto expected = hashes(InstructionSet::kPinned, 1);
  for (const InstructionSet set : {InstructionSet::kSse42, InstructionSet::kAvx2}) {
    if (!HasInstructionSet(set)) continue;
    for (const std::size_t threads : {1u, 2u, 4u}) {
      EXPECT_EQ(hashes(set, threads), expected)
          << "set " << static_cast<int>(set) << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace sim
